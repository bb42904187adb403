// The page: shows its data, draws when something has changed, and does what keys ask for.
"use strict";

/// How each pixel of the screen is drawn: by so many along each side, and so many samples of each of those; and how many rays a
/// rough surface follows for one. Coarse pictures, the first of all, are of four pixels in place of four samples: as smooth, and
/// software that draws compiles less for them; but where the shader of a room is long, four pixels take longer.
const ways = { coarse: { block: 2, samples: 1, facets: 12 }, plain: { block: 1, samples: maxSamples, facets: 12 },
  fine: { block: 2, samples: maxSamples, facets: 24 }, shot: { block: 4, samples: maxSamples, facets: 96 } };

const coarseWay = ({ bodies, rough }) => bodies || rough ? ways.plain : ways.coarse;
/// The first picture of all has a quarter of the pixels, so that it is there sooner.
const firstWay = needs => ({ ...coarseWay(needs), block: 1 });

/// More worlds than that make no frame slow on a plain graphics card; slow ones have fewer.
const maxWorlds = 128, maxWorldsOfShot = 1024, slowFrame = 80, maxPixels = 1 << 24;

/// The room of some data, and its images for the graphics card. `change` gets its tables first, and `meanwhile` is done before.
async function readShown(gl, data, change, meanwhile) {
  const tables = await readTables(data, meanwhile);
  if (change) change(tables);
  const room = readRoom(data, tables), images = await Promise.all(data.images.map(readImage));
  const textures = data.textures.map(use => makeTexture(gl, images[use.image], use));
  if (data.sky) textures.sky = await makeSky(gl, data.sky);
  return { room, textures };
}

/// How many pixels the picture has: one to a pixel of the screen, at most two along each side; of coarse ones a third.
function sizeOfPicture(canvas, coarse) {
  const ratio = Math.min(devicePixelRatio || 1, 2) / (coarse ? 3 : 1);
  return [Math.max(1, Math.round(canvas.clientWidth * ratio)), Math.max(1, Math.round(canvas.clientHeight * ratio))];
}

/// Opens the page on its data. `told` may have moved() and rested(), of the camera. Returns what others do with the page:
///   keys           by name, what they do; others may be added
///   takeRoom(data, shift)  shows another room, or another mesh of it, from where the eye is; its points are those before plus `shift`
///   takeLight({ irradiance, scale, top })  shows the room under other light: numbers by vertex, times scale W/m^2
///   showInstead({ values, top, title, lines })  numbers by vertex in false colours in place of the light, 0 to `top`, and points of lines in pairs; null: the light
///   triangleAtCursor()  what is seen there, by mirrors too; null where that is nothing
///   redraw()       after a change of something beside the camera
/// `told.tables` may change the tables of a room before it is shown.
async function openPage(data, told = {}) {
  const canvas = element("view"), asked = readAddress();
  const setSize = coarse => {
    const [width, height] = asked.size || sizeOfPicture(canvas, coarse);
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
  };
  setSize(!asked.shot); // a context that changes its size waits for all that it has been asked for
  const gl = openGpu(canvas);
  beginPrograms(gl, programsFor(needsOf(data), data.transform));
  const { room, textures } = await readShown(gl, data, told.tables, () => paintNothing(gl, data));
  const maxOfFrame = asked.shot ? maxWorldsOfShot : maxWorlds;
  let painter = makePainter(gl, data, room, textures, maxOfFrame);
  const rays = raysWhenAsked(room), motion = makeMotion(room, rays);
  const maxWide = gl.getParameter(gl.MAX_RENDERBUFFER_SIZE);
  const shows = { mirrors: asked.mirrors, falseColours: asked.falseColours, lines: asked.lines, camera: 0,
    most: Math.ceil(clamped(8e5 / room.tables.triangles.length, 1, 8)), coarse: true, slow: true };
  let waiting = true, moving = true, last = 0, rest = 0;

  function goToCamera(number) {
    shows.camera = number;
    motion.goTo(data.cameras[number]);
    if (asked.exposure !== null) motion.state.exposure = asked.exposure;
    moved();
  }
  function followAddress() {
    room.lamps.reset();
    room.lamps.take(asked.lamps);
    const named = data.cameras.findIndex(camera => camera.name === asked.camera);
    goToCamera(Math.max(0, named));
    if (asked.at && asked.at.length === 5 && asked.at.every(Number.isFinite)) {
      motion.leave();
      [motion.state.eye, motion.state.yaw, motion.state.pitch] = [asked.at.slice(0, 3), asked.at[3], asked.at[4]];
    }
  }
  function saveAddress() {
    const { camera, eye, yaw, pitch } = motion.state;
    const place = camera ? "camera=" + encodeURIComponent(camera.name) : "at=" + [...eye, yaw, pitch].map(x => Number(x.toPrecision(6))).join(",");
    const switches = (shows.mirrors ? "" : "&mirrors=off") + (shows.falseColours ? "&irradiance" : "") + (shows.lines ? "&elements" : "");
    const lamps = room.lamps.lamps.filter(({ factor, start }) => factorText(factor) !== factorText(start))
      .map(({ name, factor }) => `&lamp=${encodeURIComponent(name)}=${factorText(factor)}`).join("");
    try { history.replaceState(null, "", `#${place}&exposure=${motion.state.exposure.toFixed(2)}${switches}${lamps}`); } catch { /* a page that may not has no links */ }
  }

  function paintNow(way, most, coarse = false) {
    const before = performance.now();
    let { block } = way;
    setSize(coarse);
    const { width, height } = canvas;
    while (block > 1 && (Math.max(width, height) * block > maxWide || width * height * block * block > maxPixels)) block /= 2;
    const figures = painter.paint(motion.view(width / height), { ...shows, ...way, width, height, block, most, exposure: motion.state.exposure });
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits for the picture
    return { ...figures, milliseconds: performance.now() - before };
  }
  function frame(now) {
    waiting = false;
    const goesOn = step(Math.min(0.1, (now - last) / 1000 || 0.016));
    last = now;
    const isFirst = !document.body.classList.contains("shown"), coarse = isFirst ? firstWay(room.needs) : coarseWay(room.needs);
    const figures = moving ? paintNow(shows.coarse ? coarse : ways.plain, shows.most, shows.coarse)
      : paintNow(shows.slow ? ways.plain : ways.fine, Math.min(maxWorlds, 4 * shows.most));
    if (moving) keepPace(figures);
    else shows.slow = figures.milliseconds > 4 * slowFrame;
    // At rest there is time for more worlds.
    if (!moving && figures.cut && !shows.slow && shows.most < maxWorlds) {
      shows.most = Math.min(maxWorlds, 2 * shows.most);
      setTimeout(() => askForFrame(false), 0);
    }
    // Then for what curved and rough bodies show.
    if (!moving && painter.fillNextProbe()) setTimeout(() => askForFrame(false), 0);
    document.body.classList.add("shown");
    painter.check();
    panel.figures(figures);
    dimmers.show();
    panel.show({ ...shows, instead: Boolean(room.instead), mode: motion.state.mode, exposure: motion.state.exposure });
    clearTimeout(rest);
    if (goesOn) moved();
    else if (moving) rest = setTimeout(() => { saveAddress(); askForFrame(false); if (told.rested) told.rested(); }, 250);
  }
  /// While someone moves, slow frames have fewer pixels, and then fewer worlds, those by the most
  /// mirrors first. At rest there are more of both.
  function keepPace({ milliseconds, worlds, cut }) {
    if (milliseconds > slowFrame) {
      if (shows.coarse && worlds > 2) shows.most = Math.max(2, Math.ceil(worlds * 0.7));
      shows.coarse = true;
    } else if (milliseconds < 0.3 * slowFrame) {
      if (cut) shows.most = Math.min(maxWorlds, shows.most + 4);
      else if (milliseconds < 0.1 * slowFrame) shows.coarse = false;
    }
  }
  function drawFrame(now) { try { frame(now); } catch (problem) { showProblem(problem); } }
  function askForFrame(isMoving) {
    moving = moving && waiting ? true : isMoving;
    if (waiting || asked.shot) return;
    waiting = true;
    requestAnimationFrame(drawFrame);
  }
  function redraw() { askForFrame(true); }
  function moved() {
    if (told.moved) told.moved();
    redraw();
  }
  const keys = {
    o: () => motion.setMode(motion.state.mode === "walk" ? "orbit" : "walk"),
    m: () => { shows.mirrors = !shows.mirrors; }, f: () => { shows.falseColours = !shows.falseColours; },
    e: () => { shows.lines = !shows.lines; }, c: () => goToCamera((shows.camera + 1) % data.cameras.length),
    "+": () => { motion.state.exposure += 0.25; }, "=": () => { motion.state.exposure += 0.25; },
    "-": () => { motion.state.exposure -= 0.25; }, "?": () => panel.help(), h: () => panel.help(), l: () => dimmers.toggle()
  };
  const panel = makePanel(data, { camera: goToCamera, key: key => {
    if (key >= "1" && key <= "9" && Number(key) <= data.cameras.length) goToCamera(Number(key) - 1);
    else if (key in keys) keys[key]();
    else return;
    moved();
  } });
  let met = null; // the ray of a click
  const tellMet = () => panel.met(met && lightMet(room, rays, ...met));
  const rayAt = (x, y) => {
    const camera = motion.view(canvas.clientWidth / canvas.clientHeight);
    const [i, j] = [2 * x / canvas.clientWidth - 1, 1 - 2 * y / canvas.clientHeight];
    const direction = unit(plus(plus(camera.forward, camera.right, i * camera.half * camera.aspect), camera.up, j * camera.half));
    // What the section plane cuts away is not met.
    const past = camera.near / Math.max(1e-6, dot(direction, camera.forward));
    return [plus(camera.eye, direction, past), direction];
  };
  const meet = (x, y) => {
    met = rayAt(x, y);
    tellMet();
  };
  let cursor = null;
  canvas.addEventListener("pointermove", event => { cursor = [event.offsetX, event.offsetY]; });
  canvas.addEventListener("pointerleave", () => { cursor = null; });
  function triangleAtCursor() {
    const { hit } = followRay(room, rays, ...rayAt(...(cursor || [canvas.clientWidth / 2, canvas.clientHeight / 2])));
    return hit && hit.triangle;
  }
  keys.enter = () => meet(canvas.clientWidth / 2, canvas.clientHeight / 2);
  keys.escape = () => { met = null; tellMet(); };
  const dimmers = makeDimmers(room.lamps, () => { room.lamps.looks(); tellMet(); moved(); });
  const step = listen(canvas, motion, room, moved, meet);
  addEventListener("resize", moved);
  addEventListener("hashchange", () => {
    Object.assign(asked, readAddress());
    Object.assign(shows, { mirrors: asked.mirrors, falseColours: asked.falseColours, lines: asked.lines });
    followAddress();
    room.lamps.looks();
    tellMet();
  });
  canvas.addEventListener("webglcontextlost", () => showProblem(new Error("The graphics card has dropped this page: load it again.")));

  async function takeRoom(other, shift) {
    const next = await readShown(gl, other, told.tables), { camera, exposure } = motion.state;
    const before = painter, [dataBefore, roomBefore] = [{ ...data }, { ...room }];
    const become = (itsData, itsRoom) => {
      for (const [one, its] of [[data, itsData], [room, itsRoom]]) {
        for (const name of Object.keys(one)) delete one[name];
        Object.assign(one, its);
      }
      room.data = data;
    };
    become(other, next.room);
    try { painter = makePainter(gl, data, room, next.textures, maxOfFrame); } catch (problem) {
      become(dataBefore, roomBefore);
      throw problem;
    }
    before.free();
    panel.room();
    const same = data.cameras.findIndex(one => camera && one.name === camera.name);
    if (same >= 0) {
      shows.camera = same;
      motion.goTo(data.cameras[same]);
      if (exposure !== camera.exposure) motion.state.exposure = exposure;
    } else {
      motion.leave();
      for (const place of ["eye", "focus"]) motion.state[place] = plus(motion.state[place], shift);
    }
    tellMet();
    redraw();
  }
  function takeLight({ irradiance, scale, top }) {
    [data.light, data.top] = [scale, top];
    room.lamps.receive(irradiance);
    panel.scale(room.instead);
    tellMet();
    redraw();
  }

  function showInstead(instead) {
    room.instead = instead;
    ++room.lamps.state;
    panel.scale(instead);
    moved(); // a picture of the light would lie over it
  }

  followAddress();
  const page = { keys, showInstead, triangleAtCursor, takeRoom, takeLight, redraw, motion, shows, canvas, room, rays };
  if (!asked.shot) {
    drawFrame(performance.now());
    return page;
  }
  canvas.style.width = canvas.style.height = "auto";
  for (let k = 0; k < maxProbes && painter.fillNextProbe();) ++k;
  const figures = paintNow(ways.shot, maxWorldsOfShot);
  painter.check();
  document.body.dataset.figures = JSON.stringify(figures);
  document.body.dataset.shot = canvas.toDataURL("image/png");
  return page;
}
