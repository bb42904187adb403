// The page of `view`: the room from the server that serves this page, its light as it changes, and how far the work is.
//
// The server tells what is newest (runs/live/live_board.h); the page asks for that when it has drawn what it had, and so
// misses what came between.
"use strict";

const liveStyle = `
#live { left: 50%; top: 10px; transform: translateX(-50%); max-width: max(24rem, calc(100% - 36rem)); font-variant-numeric: tabular-nums; z-index: 2; }
#live progress { width: 9rem; height: .6rem; vertical-align: middle; accent-color: var(--accent); } #live code { user-select: all; overflow-wrap: anywhere; font-size: .85em; }
#live p { margin: .2rem 0 0; } #live .wrong { color: var(--accent); }
#live .teach { margin-left: .4rem; }
.resting { position: fixed; inset: 0; width: 100%; height: 100%; opacity: 0; pointer-events: none; }
.resting.shown { opacity: 1; transition: opacity .35s; }
.card, #cards { z-index: 2; }
@media (prefers-reduced-motion: reduce) { .resting.shown { transition: none; } }`;

/// Below the address of this page.
const noAnswer = "The program does not answer: it has ended, or is busy.";
async function askServer(path, options = {}) {
  try { return await fetch(location.pathname + path, { cache: "no-store", ...options }); } catch (problem) {
    throw problem.name === "AbortError" ? problem : Object.assign(new Error(noAnswer), { name: "NoAnswer" });
  }
}
const tellServer = path => askServer(path, { method: "POST" }).catch(() => {});

/// What the server sends of numbers (live_board.h): what it says of them, and `values`.
async function readMessage(buffer) {
  const length = new DataView(buffer).getUint32(0, true), bytes = new Uint8Array(buffer);
  const head = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  return { ...head, values: readTable(await inflated(bytes.subarray(4 + length)), 0, head) };
}

/// Bits of halves. `before`: those of the state they differ from.
async function readLight(buffer, before) {
  const { values: bits, ...head } = await readMessage(buffer);
  if (head.base) for (let k = 0; k < bits.length; ++k) bits[k] += before[k];
  return { ...head, bits };
}

/// What the server has for a request; throws a sentence where that is nothing.
async function askFor(path) {
  const reply = await askServer(path);
  if (reply.status === 200) return reply;
  if (reply.status === 204) throw new Error("Another picture was asked for before this one was there.");
  const said = reply.status === 400 || reply.status === 503 ? (await reply.text()).trim() : "";
  throw new Error(said || `The program could not answer (${reply.status}).`);
}

/// Numbers for the page, with the ambient term or without.
function lightOf({ bits, scale, ambient, top }, withAmbient) {
  const irradiance = Float32Array.from(bits, x => halfNumbers[x & 0x7fff]), more = ambient.map(x => withAmbient ? x / scale : 0);
  for (let k = 0; k < irradiance.length; ++k) irradiance[k] += more[k % 3];
  return { irradiance, scale, top };
}

const shares = x => x === null ? "-" : x >= 0.0095 ? `${Number((100 * x).toPrecision(2))} %` : x.toExponential(1);

/// The card with the status; `actions` are what its buttons do. Returns { show, say }.
function makeStatusCard(actions) {
  document.head.append(madeElement("style", {}, liveStyle));
  const card = madeElement("div", { id: "live", className: "card" }), text = madeElement("span", { id: "live-status" });
  const bar = madeElement("progress", { max: 1 }), problem = madeElement("p", { className: "wrong", hidden: true }), said = madeElement("p", { id: "said", hidden: true });
  problem.setAttribute("role", "alert");
  text.setAttribute("role", "status");
  card.append(bar, " ", text);
  for (const [id, label, key, title] of [["pause", "pause", "P", "stop after the next shot"], ["step", "one shot", "N", "the next shot, and then stop"],
    ["ambient", "ambient", "T", "light still to be shot, spread evenly"],
    ["solver", "shooting", "V", "shooting or gathering, from the beginning"], ["constant", "constant", "I", "elements as constant, or interpolated"],
    ["factors", "factors", "G", "form factors of the element under the cursor; again: those by mirrors"], ["save", "save", "Ctrl+S", "the picture of this view as EXR and PNG"]]) {
    const button = madeElement("button", { id: "live-" + id, type: "button", title, className: "teach" }, label + " ");
    button.append(madeElement("kbd", {}, key));
    button.addEventListener("click", () => actions[id]());
    card.append(button);
  }
  card.append(problem, said);
  document.body.append(card);
  return {
    show(status, { withAmbient, constant }) {
      const left = status.secondsLeft === null || status.solved ? "" : `, ${Math.ceil(status.secondsLeft)} s left`;
      const parts = [status.stage + (!status.paused ? left : ["shots", "sweeps", "dark"].includes(status.stage) ? ", stopped" : ", stops at the next step"), `${status.elements} elements`];
      if (!status.solved && status.shots) parts.push(`${status.shots} ${status.gathers ? "sweeps" : "shots"}`);
      if (status.unshot !== null) parts.push(`${status.gathers ? "last change" : "unshot"} ${shares(status.unshot)}`);
      if (status.error !== null) parts.push(`error below ${shares(status.error)}`);
      parts.push(`${status.seconds.toFixed(1)} s`);
      text.textContent = parts.join("; ");
      bar.hidden = status.solved;
      bar.value = status.done;
      problem.hidden = !status.problem;
      problem.textContent = status.problem;
      const shoots = !status.solved;
      for (const id of ["pause", "step", "ambient", "solver"]) element("live-" + id).hidden = !shoots;
      element("live-save").hidden = !status.solved;
      element("live-pause").firstChild.textContent = status.paused ? "go on " : "pause ";
      element("live-step").firstChild.textContent = status.gathers ? "one sweep " : "one shot ";
      element("live-solver").firstChild.textContent = status.gathers ? "gathering " : "shooting ";
      element("live-ambient").setAttribute("aria-pressed", withAmbient);
      element("live-constant").setAttribute("aria-pressed", constant);
      document.body.dataset.status = JSON.stringify(status);
    },
    say(line, code) {
      said.hidden = !line;
      said.replaceChildren(line, ...(code ? [madeElement("code", {}, code)] : []));
    }
  };
}

async function openLive() {
  let status = null, page = null, resting = null, room = 0, failed = 0, light = null, middle = [0, 0, 0], busy = false, factors = null, apart = false, name = "view";
  const shows = { withAmbient: true, constant: false };
  const shoots = () => status && !status.solved, say = problem => problem.name === "NoAnswer" ? card.say(problem.message) : showProblem(problem);
  const actions = { pause: () => { if (shoots()) tellServer(status.paused ? "go-on" : "pause"); }, step: () => { if (shoots()) tellServer("step"); },
    ambient: () => { shows.withAmbient = !shows.withAmbient; showLight(); },
    solver: () => { if (shoots()) tellServer(status.gathers ? "shoot" : "gather"); },
    constant: () => { shows.constant = !shows.constant; withElementsApart().then(showLight).catch(say); },
    factors: () => withElementsApart().then(() => factors.press(room)).catch(problem => card.say(problem.message)),
    save: async () => {
      if (!resting || !status.solved) { card.say("The room is not solved yet."); return; }
      card.say("making the picture ...");
      try { card.say("saved; again by ", await resting.save(name)); } catch (problem) { card.say(problem.message); }
    } };
  const card = makeStatusCard(actions);
  function showLight() {
    if (!page || !light) return;
    const { tables } = page.room, numbers = lightOf(light, shows.withAmbient);
    if (tables.from) document.body.dataset.apart = "yes";
    if (tables.from) numbers.irradiance = atOwnVertices(tables, numbers.irradiance, 3);
    page.shows.constant = shows.constant;
    if (shows.constant && tables.from) numbers.irradiance = meansOfElements(tables, numbers.irradiance);
    if (resting) resting.moved();
    page.takeLight(numbers);
    card.show(status, shows);
  }
  /// From now on; the room that is there is fetched again for it.
  async function withElementsApart() {
    if (apart) return;
    apart = true;
    room = 0;
    await follow();
    for (let k = 0; k < 400 && !(page && page.room.tables.from); ++k) await new Promise(resolve => setTimeout(resolve, 25)); // where it followed already
  }
  const told = { tables: tables => { if (apart) splitElements(tables); }, moved: () => { if (resting) resting.moved(); }, rested: () => { if (resting && status.solved) resting.rested().catch(say); } };

  async function takeRoom() {
    const reply = await askServer("room");
    if (reply.status !== 200) return;
    const fresh = await reply.json(), shift = minus(middle, fresh.middle);
    if (resting) resting.moved();
    if (page) await page.takeRoom(fresh.data, shift);
    else {
      page = await openPage(fresh.data, told);
      const { step, pause, ambient, solver, constant } = actions, escape = page.keys.escape;
      Object.assign(page.keys, { n: step, p: pause, t: ambient, v: solver, i: constant, g: actions.factors, escape: () => { escape(); factors.hide(); } });
      factors = makeFactors(page, askFor, card.say);
      resting = makeResting(page, () => middle, askServer);
    }
    [room, middle] = [fresh.room, fresh.middle];
    name = fresh.data.title.replace(/\.[^.]*$/, "") || "view";
    factors.hide();
    light = { bits: Int32Array.from(page.room.tables.bits || page.room.tables.irradiance), scale: fresh.data.light, ambient: fresh.ambient, top: fresh.data.top, state: fresh.state };
    showLight();
  }
  async function takeLight() {
    const reply = await askServer(`light?base=${light.state}`);
    if (reply.status !== 200) return;
    const fresh = await readLight(await reply.arrayBuffer(), light.bits);
    if (fresh.room !== room) return;
    light = fresh;
    showLight();
  }
  /// One thing after another, the newest alone.
  async function follow() {
    if (busy || !status || status.room === failed) return;
    busy = true;
    let wanted = 0;
    try {
      while (status.room && (status.room !== room || (status.state > light.state))) {
        const asked = status, before = light;
        wanted = status.room;
        if (status.room !== room) await takeRoom(); else await takeLight();
        if (light) document.body.dataset.state = light.state;
        if (light === before && status === asked) break; // it comes with the next event
        await new Promise(resolve => setTimeout(resolve, 0));
      }
    } catch (problem) {
      // That room is not asked for again and again.
      if (problem.name !== "NoAnswer") failed = wanted;
      say(problem);
    } finally { busy = false; }
  }
  addEventListener("keydown", event => {
    if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "s") return;
    event.preventDefault();
    actions.save().catch(showProblem);
  });
  const events = new EventSource(location.pathname + "events");
  events.addEventListener("message", event => {
    const before = status;
    status = JSON.parse(event.data);
    card.show(status, shows);
    if (before && before.solved && !status.solved && resting) resting.moved();
    if (before && status.solved && !before.solved && page) page.redraw();
    follow();
  });
  events.addEventListener("error", () => card.say(noAnswer));
  events.addEventListener("open", () => { failed = 0; card.say(""); });
}
openLive().catch(showProblem);
