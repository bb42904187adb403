// Vectors as arrays of three numbers, planes as [n, d] for n.x = d, cameras by their frame.
//
// A camera is { eye, right, up, forward, half, aspect, near, far }, half the tangent of half the
// vertical angle. Its image in a mirror is the frame reflected, with right and left exchanged: its picture
// is what is seen by way of the mirror, the other way round, and fronts turn as they do in the room.
"use strict";

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const plus = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
const minus = (a, b) => plus(a, b, -1);
const times = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const lengthOf = a => Math.hypot(a[0], a[1], a[2]);
const unit = a => times(a, 1 / (lengthOf(a) || 1));
const clamped = (x, low, high) => Math.min(Math.max(x, low), high);

/// x' = x - 2 (n.x - d) n, and the same of directions, d = 0.
const reflected = (x, n, d) => plus(x, n, -2 * (dot(n, x) - d));

function cameraBehind(camera, mirror) {
  const turned = v => reflected(v, mirror.normal, 0);
  return { ...camera, eye: reflected(camera.eye, mirror.normal, mirror.offset),
    right: times(turned(camera.right), -1), up: turned(camera.up), forward: turned(camera.forward) };
}

/// From the room to clip space, by columns.
function viewProjection({ eye, right, up, forward, half, aspect, near, far }) {
  const x = times(right, 1 / (half * aspect)), y = times(up, 1 / half);
  const a = (far + near) / (far - near), b = -2 * far * near / (far - near);
  const row = (v, w) => [v[0], v[1], v[2], w];
  const rows = [row(x, -dot(x, eye)), row(y, -dot(y, eye)),
    row(times(forward, a), b - a * dot(forward, eye)), row(forward, -dot(forward, eye))];
  const matrix = new Float32Array(16);
  for (let c = 0; c < 4; ++c)
    for (let r = 0; r < 4; ++r) matrix[4 * c + r] = rows[r][c];
  return matrix;
}

/// Where a point is in the picture, -1 to 1 right and up; it is in front of the camera.
function projected(camera, x) {
  const v = minus(x, camera.eye), z = dot(v, camera.forward);
  return [dot(v, camera.right) / (z * camera.half * camera.aspect), dot(v, camera.up) / (z * camera.half)];
}

/// The part of a convex polygon where n.x >= d (Sutherland and Hodgman 1974).
function clipped(polygon, n, d) {
  const kept = [];
  for (let k = 0; k < polygon.length; ++k) {
    const a = polygon[k], b = polygon[(k + 1) % polygon.length];
    const at = dot(n, a) - d, next = dot(n, b) - d;
    if (at >= 0) kept.push(a);
    if ((at > 0 && next < 0) || (at < 0 && next > 0)) kept.push(plus(a, minus(b, a), at / (at - next)));
  }
  return kept.length < 3 ? [] : kept;
}

/// The planes through the eye and the edges of a window, their normals inwards: its cone.
function conePlanes(eye, window) {
  const middle = times(window.reduce((sum, x) => plus(sum, x), [0, 0, 0]), 1 / window.length), planes = [];
  for (let k = 0; k < window.length; ++k) {
    const n = cross(minus(window[k], eye), minus(window[(k + 1) % window.length], eye));
    if (dot(n, n) === 0) continue;
    const inwards = times(unit(n), dot(n, minus(middle, eye)) < 0 ? -1 : 1);
    planes.push([inwards, dot(inwards, eye)]);
  }
  return planes;
}

function clippedToCone(polygon, planes) {
  for (const [n, d] of planes) polygon = polygon.length ? clipped(polygon, n, d) : polygon;
  return polygon;
}

/// Whether a box is all behind a plane.
function isBehind({ low, high }, [n, d]) {
  return n[0] * (n[0] > 0 ? high : low)[0] + n[1] * (n[1] > 0 ? high : low)[1] + n[2] * (n[2] > 0 ? high : low)[2] < d;
}
