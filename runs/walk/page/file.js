// The page as a file: its data are in it.
"use strict";

openPage(JSON.parse(element("data").textContent)).catch(showProblem);
