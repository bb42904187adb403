// Pass two's picture of what is looked at while the camera rests: made by the server, first coarse, faded in over the
// page's own, gone with the next move.
"use strict";

/// More pixels along a side are not asked for.
const longestSide = 2048;

/// `page` is that of main.js, `middle()` what to add to its points to have those of the scene, `ask` fetches below the address.
/// Returns { rested, moved, save, shown }.
function makeResting(page, middle, ask) {
  const viewer = Math.random().toString(36).slice(2), layers = [0, 1].map(() => madeElement("img", { className: "resting", alt: "" }));
  page.canvas.after(...layers);
  let number = 0, saves = 0, asking = null, top = 0, isThere = false;

  /// What the server is asked for: a camera of the file as it is, or where somebody has gone.
  function viewNow() {
    const { camera, eye, yaw, pitch, half, exposure } = page.motion.state, { clientWidth, clientHeight } = page.canvas;
    const scale = Math.min(1, longestSide / Math.max(clientWidth, clientHeight));
    const query = new URLSearchParams({ viewer, number, exposure: Number(exposure.toFixed(2)),
      size: [clientWidth, clientHeight].map(x => Math.max(1, Math.round(scale * x))).join("x") });
    if (camera) query.set("camera", camera.name);
    else {
      const at = plus(eye, middle()), forward = [Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch), -Math.cos(yaw) * Math.cos(pitch)];
      const rounded = x => Number(x.toPrecision(9));
      query.set("eye", at.map(rounded).join(","));
      query.set("target", plus(at.map(rounded), forward).map(rounded).join(","));
      query.set("angle", rounded(360 / Math.PI * Math.atan(half)));
    }
    return query;
  }
  function hide() {
    for (const layer of layers) layer.classList.remove("shown");
    isThere = false;
    delete document.body.dataset.resting;
  }
  /// The layer on top of the other, whose picture stays below it until it is seen.
  async function show(blob, step, isWanted) {
    const layer = layers[top = 1 - top], before = layer.src;
    layer.classList.remove("shown");
    layer.src = URL.createObjectURL(blob);
    if (before) URL.revokeObjectURL(before);
    await layer.decode();
    if (!isWanted()) return;
    layers[0].style.zIndex = top === 0 ? 1 : 0;
    layers[1].style.zIndex = top === 1 ? 1 : 0;
    layer.classList.add("shown");
    isThere = true;
    document.body.dataset.resting = step;
  }
  const isPlain = () => !page.shows.falseColours && !page.shows.lines && page.shows.mirrors && !page.shows.constant && !page.room.instead;

  async function rested() {
    moved();
    if (!isPlain()) return;
    const control = asking = new AbortController(), query = viewNow();
    try {
      for (const step of ["coarse", "whole"]) {
        const reply = await ask(`picture?${query}&step=${step}`, { signal: control.signal });
        if (reply.status !== 200) return;
        const blob = await reply.blob();
        if (asking !== control) return;
        await show(blob, step, () => asking === control);
        if (asking !== control) return;
      }
    } catch (problem) { if (problem.name !== "AbortError") throw problem; }
  }
  /// The server ends what it is at.
  function moved() {
    if (asking) {
      asking.abort();
      ask(`moved?viewer=${viewer}&number=${number + 1}`, { method: "POST" }).catch(() => {});
      asking = null;
    }
    ++number;
    if (isThere) hide();
  }

  /// EXR and PNG into the browser's downloads, both or neither; returns the command that makes them again. It goes on
  /// while the camera moves. Throws a sentence where there are none.
  async function save(name) {
    const query = viewNow();
    query.set("viewer", `${viewer}-save`);
    query.set("number", ++saves);
    const command = await (await askFor(`command?${query}&name=${encodeURIComponent(name)}`)).text(), files = [];
    for (const kind of ["exr", "png"]) files.push([kind, await (await askFor(`save.${kind}?${query}`)).blob()]);
    for (const [kind, blob] of files) {
      const link = madeElement("a", { href: URL.createObjectURL(blob), download: `${name}.${kind}` });
      document.body.append(link);
      link.click();
      link.remove();
      setTimeout(() => URL.revokeObjectURL(link.href), 60000);
    }
    return command;
  }
  // A request that outlives its page; sendBeacon would not say its origin.
  addEventListener("pagehide", () => {
    for (const [who, last] of [[viewer, number], [`${viewer}-save`, saves]])
      ask(`moved?viewer=${who}&number=${last + 1}`, { method: "POST", keepalive: true }).catch(() => {});
    [number, saves] = [number + 1, saves + 1];
  });
  return { rested, moved, save };
}
