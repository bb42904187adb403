// What is written beside the picture: cameras, switches with their keys, a legend, what a click met.
"use strict";

const element = id => document.getElementById(id);

/// Three figures, or a power of ten.
function figure(x) {
  if (!Number.isFinite(x)) return "-";
  return x === 0 ? "0" : Math.abs(x) >= 1e5 || Math.abs(x) < 1e-3 ? x.toExponential(2) : String(Number(x.toPrecision(3)));
}
const luminance = c => 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];

function makePanel(data, actions) {
  const efficacy = data.luminousEfficacy, cameras = element("cameras");
  function showRoom() {
    document.title = data.title + " - Meninas";
    element("title").textContent = data.title;
    cameras.replaceChildren(...data.cameras.map((camera, k) => new Option(`${camera.name}${k < 9 ? ` (${k + 1})` : ""}`, k)));
    showScale();
  }
  const whatScale = element("legend").firstElementChild, irradianceTitle = whatScale.textContent;
  function showScale(instead = null) {
    const top = instead ? instead.top : data.top;
    element("scale-top").textContent = figure(top);
    element("scale-middle").textContent = figure(top / 2);
    whatScale.textContent = instead ? instead.title : irradianceTitle;
  }
  cameras.addEventListener("change", () => { actions.camera(Number(cameras.value)); element("view").focus(); });
  const switches = [["mode", "o"], ["mirrors", "m"], ["falseColours", "f"], ["elements", "e"], ["lamps-button", "l"]];
  for (const [name, key] of switches) element(name).addEventListener("click", () => actions.key(key));
  element("brighter").addEventListener("click", () => actions.key("+"));
  element("darker").addEventListener("click", () => actions.key("-"));
  element("help-button").addEventListener("click", () => actions.key("?"));
  addEventListener("keydown", event => {
    if (event.ctrlKey || event.metaKey || event.altKey || ["SELECT", "INPUT"].includes(event.target.tagName)) return;
    if (event.key === "Enter" && event.target.tagName === "BUTTON") return; // presses it
    actions.key(event.key.toLowerCase());
  });
  const colours = data.falseColours, stops = [];
  for (let k = 0; k < 256; k += 15) stops.push(`rgb(${colours.slice(3 * k, 3 * k + 3).join(",")}) ${k / 2.55}%`);
  element("scale").style.background = `linear-gradient(to right, ${stops.join(",")})`;
  showRoom();

  return {
    room: showRoom,
    scale: showScale,
    show({ camera, mode, mirrors, falseColours, instead, lines, exposure }) {
      cameras.value = camera;
      element("mode").textContent = mode === "walk" ? "walk" : "orbit";
      for (const [id, on] of [["mirrors", mirrors], ["falseColours", falseColours], ["elements", lines]])
        element(id).setAttribute("aria-pressed", on);
      element("legend").hidden = !falseColours && !instead;
      element("exposure").textContent = `${exposure >= 0 ? "+" : ""}${exposure.toFixed(1)} EV`;
    },
    figures({ worlds, cut, depth, draws, milliseconds }) {
      const left = cut ? `; ${cut} more are left out to keep the pace` : "";
      element("figures").textContent = `${worlds - 1} mirror worlds, ${depth} deep, ${draws} draws, ${milliseconds.toFixed(0)} ms${left}`;
    },
    met(light) {
      element("met").hidden = !light;
      if (!light) return;
      const rho = [0, 1, 2].map(k => Math.min(1, light.look.rest[k] + light.look.albedo[k]));
      const radiosity = rho.map((r, k) => r * light.irradiance[k] + Math.PI * light.look.emission[k]);
      const rows = [["surface", light.node || "-"], ["material", light.look.name || "-"],
        ["seen", light.mirrors ? `by way of ${light.mirrors} mirror${light.mirrors > 1 ? "s" : ""}` : "directly"],
        ["irradiance H", `${figure(luminance(light.irradiance))} W/m² (${light.irradiance.map(figure).join(", ")})`],
        ["illuminance", `${figure(efficacy * luminance(light.irradiance))} lx, at ${efficacy} lm/W`],
        [light.textured ? "radiosity B, at most" : "radiosity B", `${figure(luminance(radiosity))} W/m² (${radiosity.map(figure).join(", ")})`],
        ["reflectance", rho.map(figure).join(", ") + (light.textured ? ", times its texture" : "")]];
      element("met").replaceChildren(...rows.flatMap(([name, value]) => {
        const [dt, dd] = [document.createElement("dt"), document.createElement("dd")];
        dt.textContent = name;
        dd.textContent = value;
        return [dt, dd];
      }));
    },
    help() { element("help").hidden = !element("help").hidden; }
  };
}

function showProblem(problem) {
  element("problem").hidden = false;
  element("problem").textContent = problem.message || String(problem);
  document.body.dataset.problem = element("problem").textContent;
}

/// What the address asks for after #: camera or at, size, exposure, mirrors, lamp=NAME=FACTOR, shot.
function readAddress() {
  const asked = new URLSearchParams(location.hash.slice(1)), numbers = name => (asked.get(name) || "").split(/[x,]/).map(Number);
  const size = asked.has("size") ? numbers("size") : null;
  return { camera: asked.get("camera"), at: asked.has("at") ? numbers("at") : null,
    size: size && size.length === 2 && size.every(x => x >= 1 && x <= 4096) ? size : null,
    exposure: asked.has("exposure") && Number.isFinite(Number(asked.get("exposure"))) ? Number(asked.get("exposure")) : null,
    mirrors: asked.get("mirrors") !== "off", falseColours: asked.has("irradiance"), lines: asked.has("elements"), shot: asked.has("shot"),
    lamps: asked.getAll("lamp") };
}
