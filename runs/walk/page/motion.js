// Ways to move: walking at eye height over the floor, and turning around a point. What is seen is a
// frame (vectors.js); a camera of the file is kept as it is until someone moves.
"use strict";

/// Vertical tangent of a camera for a picture of that aspect (scenes/camera.cpp).
function halfOf(camera, aspect) {
  const { half } = camera;
  if (camera.fit === 0 || !(camera.aspect > 0)) return half;
  const width = half * camera.aspect;
  return camera.fit === 1 ? width / aspect : Math.max(width, half) / Math.max(aspect, 1);
}

function makeMotion(room, rays) {
  const up = [0, 1, 0], girthOf = () => Math.min(0.25, 0.05 * room.size);
  const eyeHeightOf = () => { const tall = room.high[1] - room.low[1]; return tall > 2 ? 1.6 : 0.6 * tall; };
  const state = { mode: "walk", eye: [0, 0, 0], yaw: 0, pitch: 0, focus: [0, 0, 0], camera: null, half: 0.5, exposure: 0 };

  const forwardOf = () => [Math.sin(state.yaw) * Math.cos(state.pitch), Math.sin(state.pitch), -Math.cos(state.yaw) * Math.cos(state.pitch)];
  function takeFrame(forward) {
    state.pitch = Math.asin(clamped(forward[1], -1, 1));
    state.yaw = Math.atan2(forward[0], -forward[2]);
  }

  function goTo(camera) {
    state.camera = camera;
    state.eye = camera.position;
    state.exposure = camera.exposure;
    takeFrame(camera.forward);
    state.focus = plus(state.eye, camera.forward, 0.5 * room.size);
    if (!camera.orthographic) state.half = camera.half;
  }
  /// From now on the frame is upright.
  function leave() { state.camera = null; }

  /// The frame for a picture of that aspect. What is parallel is seen from very far.
  function view(aspect) {
    const camera = state.camera, far = 3 * room.size + lengthOf(state.eye);
    const shared = { aspect, near: Math.max(1e-4 * room.size, camera ? camera.section : 0), far };
    if (!camera) {
      const forward = forwardOf(), right = unit(cross(forward, up));
      return { ...shared, eye: state.eye, forward, right, up: cross(right, forward), half: state.half };
    }
    const { forward } = camera, right = cross(forward, camera.up), half = halfOf(camera, aspect);
    if (!camera.orthographic) return { ...shared, eye: camera.position, forward, right, up: camera.up, half };
    const away = 400 * room.size, toMiddle = away - dot(forward, camera.position);
    return { aspect, eye: plus(camera.position, forward, -away), forward, right, up: camera.up, half: half / toMiddle,
      near: away + Math.max(0, camera.section), far: away + far };
  }

  /// How far along a direction nothing stands in the way, at two heights.
  function blockedBy(direction, length) {
    for (const height of [0, 0.7 * eyeHeightOf()]) {
      const hit = rays(plus(state.eye, up, -height), direction, length + girthOf());
      if (hit && Math.abs(hit.normal[1]) < 0.7) return hit;
    }
    return null;
  }
  function walk(step) {
    let length = lengthOf(step);
    for (let tries = 0; tries < 3 && length > 1e-9; ++tries) {
      const hit = blockedBy(times(step, 1 / length), length);
      if (!hit) break;
      const normal = unit([hit.normal[0], 0, hit.normal[2]]);
      step = minus(step, times(normal, dot(step, normal)));
      length = lengthOf(step);
      if (tries === 2) return;
    }
    state.eye = plus(state.eye, step);
    const floor = rays(state.eye, [0, -1, 0]);
    if (floor && Math.abs(floor.normal[1]) > 0.5) state.eye = plus(state.eye, up, eyeHeightOf() - floor.distance);
  }

  function turn(yaw, pitch) {
    leave();
    state.yaw += yaw;
    state.pitch = clamped(state.pitch + pitch, -1.5, 1.5);
    if (state.mode === "orbit") state.eye = plus(state.focus, forwardOf(), -lengthOf(minus(state.focus, state.eye)));
  }
  /// Metres ahead and to the right.
  function go(ahead, aside) {
    leave();
    const level = [Math.sin(state.yaw), 0, -Math.cos(state.yaw)], right = [Math.cos(state.yaw), 0, Math.sin(state.yaw)];
    if (state.mode === "walk") return walk(plus(times(level, ahead), right, aside));
    const distance = lengthOf(minus(state.focus, state.eye));
    const nearer = clamped(distance - ahead, 0.02 * room.size, 4 * room.size);
    state.eye = plus(state.focus, forwardOf(), -nearer);
    if (aside) turn(-aside / nearer, 0);
  }
  function setMode(mode) {
    leave();
    state.mode = mode;
    const hit = rays(state.eye, forwardOf());
    state.focus = plus(state.eye, forwardOf(), hit ? hit.distance : 0.5 * room.size);
  }
  return { state, goTo, view, turn, go, setMode, takeFrame, leave };
}

/// Keys, pointer and touch on the canvas; `moved` is called when the view has changed, `clicked` with
/// the place of a press that did not move, and step() by every frame with its seconds.
function listen(canvas, motion, room, moved, clicked) {
  const pressed = new Set(), pointers = new Map(), speedOf = () => clamped(0.15 * room.size, 0.02, 2.5);
  let travelled = 0, spread = 0;
  const moves = { w: [1, 0, 0], s: [-1, 0, 0], a: [0, -1, 0], d: [0, 1, 0], arrowup: [1, 0, 0], arrowdown: [-1, 0, 0],
    arrowleft: [0, 0, -1], arrowright: [0, 0, 1], pageup: [0, 0, 0, 1], pagedown: [0, 0, 0, -1] };
  const move = (key, seconds) => {
    const [ahead, aside, yaw = 0, pitch = 0] = moves[key];
    if (ahead || aside) motion.go(ahead * speedOf() * seconds, aside * speedOf() * seconds);
    if (yaw || pitch) motion.turn(1.4 * yaw * seconds, pitch * seconds);
  };
  const isText = target => ["INPUT", "SELECT", "TEXTAREA"].includes(target.tagName);
  addEventListener("keydown", event => {
    const key = event.key.toLowerCase();
    if (!(key in moves) || event.ctrlKey || event.metaKey || event.altKey || isText(event.target)) return;
    if (!pressed.has(key)) move(key, 0.03); // a tap between two frames counts, too
    pressed.add(key);
    event.preventDefault();
    moved();
  });
  addEventListener("keyup", event => pressed.delete(event.key.toLowerCase()));
  addEventListener("blur", () => pressed.clear());
  const distanceOfTwo = () => { const [a, b] = [...pointers.values()]; return Math.hypot(a.x - b.x, a.y - b.y); };
  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (pointers.size === 1) travelled = 0;
    if (pointers.size === 2) spread = distanceOfTwo();
  });
  canvas.addEventListener("pointermove", event => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const x = event.clientX - last.x, y = event.clientY - last.y;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    travelled += Math.abs(x) + Math.abs(y);
    if (travelled < 4) return;
    if (pointers.size === 2) {
      const now = distanceOfTwo();
      motion.go(0.004 * speedOf() * (now - spread), 0);
      spread = now;
      travelled += 100;
    } else motion.turn(-0.004 * x, 0.004 * y);
    moved();
  });
  const release = event => {
    if (!pointers.delete(event.pointerId) || pointers.size) return;
    if (event.type === "pointerup" && travelled < 4) clicked(event.offsetX, event.offsetY);
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    motion.go(-Math.sign(event.deltaY) * 0.15 * speedOf(), 0);
    moved();
  }, { passive: false });
  /// Returns whether keys are still down.
  return function step(seconds) {
    for (const key of pressed) move(key, seconds);
    return pressed.size > 0;
  };
}
