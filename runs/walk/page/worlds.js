// The mirror worlds that the eye sees: a tree, found anew for every frame by the test of pass one
// (mirror/worlds.h), with the eye in place of the room.
//
// A world is the room as seen by way of a chain of mirrors. In the room's own space its eye is the
// image of the eye, and what it shows is within the cone from that eye through its windows, which lie
// in the plane of its mirror and so are the same before and behind it, and on the front of that mirror.
// A mirror has a world there if a part of its window is in that cone and its front is towards the eye,
// and if its light is worth it: the product of reflectances is at least the page's least throughput.
"use strict";

/// The picture's four corners, at distance one.
function cornersOf(camera) {
  const x = times(camera.right, camera.half * camera.aspect), y = times(camera.up, camera.half);
  const at = plus(camera.eye, camera.forward);
  return [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([i, j]) => plus(plus(at, x, i), y, j));
}

function windowsSeen(mirror, world) {
  const seen = [];
  for (const window of mirror.windows) {
    let front = world.mirror ? clipped(window, world.mirror.normal, world.mirror.offset) : window;
    const { forward, eye } = world.camera;
    if (!world.mirror) front = clipped(front, forward, dot(forward, eye) + 0.5 * world.camera.near);
    for (const cone of world.cones) {
      const part = clippedToCone(front, cone);
      if (part.length) seen.push(part);
    }
  }
  return seen;
}

/// Whether a world can show something in a box.
function mayShow(world, box) {
  if (world.mirror && isBehind(box, [world.mirror.normal, world.mirror.offset])) return false;
  return world.cones.some(cone => !cone.some(plane => isBehind(box, plane)));
}

/// The largest part of light that is reflected towards the eye, from anywhere on the windows.
function reflectanceSeen(mirror, eye, windows) {
  if (mirror.kind === "mirror") return mirror.reflectance;
  let least = 1;
  for (const x of windows.flat()) least = Math.min(least, Math.abs(dot(mirror.normal, unit(minus(x, eye)))));
  return Math.max(mirror.reflectance, 0.04 + 0.96 * (1 - least) ** 5);
}

/// The smallest rectangle of a camera's picture around the windows: left, bottom, right, top, 0 to 1.
function rectangleOf(camera, windows) {
  const rectangle = [1, 1, 0, 0];
  for (const x of windows.flat())
    projected(camera, x).forEach((at, k) => {
      const share = clamped(0.5 + 0.5 * at, 0, 1);
      rectangle[k] = Math.min(rectangle[k], share);
      rectangle[k + 2] = Math.max(rectangle[k + 2], share);
    });
  return rectangle;
}

/// The same around a box, a little larger; the whole picture where a part of it is behind the eye.
function boxOnScreen(camera, { low, high }) {
  const points = cubeCorners.map(corner => corner.map((side, axis) => (side < 0 ? low : high)[axis]));
  if (points.some(x => dot(camera.forward, minus(x, camera.eye)) <= camera.near)) return [0, 0, 1, 1];
  const margin = 0.005;
  return rectangleOf(camera, [points]).map((x, k) => k < 2 ? x - margin : x + margin);
}

/// The camera behind a mirror: it sees from the nearest corner of the windows to beyond the room.
function behind(camera, mirror, windows, room, isBlurred) {
  const image = cameraBehind(camera, mirror), depths = windows.flat().map(x => dot(image.forward, minus(x, image.eye)));
  // What is blurred takes from beside the picture, too.
  if (isBlurred) image.half += Math.min(1, 2 * mirror.alpha * (1 + image.half ** 2));
  return { ...image, near: Math.max(camera.near, 0.9 * Math.min(...depths)), far: lengthOf(image.eye) + room.size };
}

/// The room itself.
function rootWorld(camera) {
  return { camera, mirror: null, windows: null, cones: [conePlanes(camera.eye, cornersOf(camera))], throughput: 1, depth: 0, asides: 0,
    rectangle: [0, 0, 1, 1], children: [] };
}

/// Whether mirror a may hide a part of mirror b from the eye, which is before both: a ray meets a first where
/// a part of a is before b's plane, and of b behind a's.
function mayHide(a, b) {
  const [left, bottom, right, top] = a.rectangle, other = b.rectangle, least = 1e-6 * a.camera.far;
  if (left > other[2] || other[0] > right || bottom > other[3] || other[1] > top) return false;
  const isSome = (one, { mirror }, side) => one.windows.flat().some(x => side * (dot(mirror.normal, x) - mirror.offset) > least);
  const hides = (one, two) => isSome(one, two, 1) && isSome(two, one, -1);
  return hides(a, b) && !(hides(b, a) && nearest(b) < nearest(a)); // of mirrors that cross, the nearer one
}
const nearest = ({ camera, windows }) => Math.min(...windows.flat().map(x => lengthOf(minus(x, camera.eye))));

/// Worlds of one parent, those first that others may hide.
function farthestFirst(worlds) {
  const left = [...worlds], order = [];
  while (left.length) order.push(...left.splice(Math.max(0, left.findIndex(b => !left.some(a => a !== b && mayHide(b, a)))), 1));
  return order;
}

/// At most `most` worlds, first those with fewer mirrors. `followed` says of which mirrors, `blurs` which of them are
/// pictures of their own that are blurred.
function visibleWorlds(room, camera, most, followed, blurs) {
  const root = rootWorld(camera), worlds = [root];
  let cut = 0;
  for (let next = 0; next < worlds.length; ++next) {
    const world = worlds[next];
    for (const mirror of room.mirrors) {
      if (mirror === world.mirror || !followed(mirror, world)) continue;
      if (dot(mirror.normal, world.camera.eye) - mirror.offset <= 1e-6 * room.size) continue;
      const windows = windowsSeen(mirror, world);
      if (!windows.length) continue;
      const throughput = world.throughput * reflectanceSeen(mirror, world.camera.eye, windows);
      if (throughput < room.data.minThroughput || world.depth >= 254) continue;
      if (worlds.length >= most || windows.length > 64) { ++cut; continue; }
      const isBlurred = blurs(mirror), image = behind(world.camera, mirror, windows, room, isBlurred);
      // What is blurred takes from beyond the window, too.
      const seen = isBlurred ? [cornersOf(image)] : windows;
      const child = { camera: image, mirror, isBlurred, windows: isBlurred ? null : windows, cones: seen.map(w => conePlanes(image.eye, w)),
        throughput, depth: world.depth + 1, asides: world.asides + (mirror.kind === "pane" || isBlurred ? 1 : 0),
        rectangle: isBlurred ? [0, 0, 1, 1] : rectangleOf(image, windows), children: [] };
      world.children.push(child);
      worlds.push(child);
    }
  }
  return { all: worlds, root, count: worlds.length, cut, depth: Math.max(...worlds.map(world => world.depth)) };
}
