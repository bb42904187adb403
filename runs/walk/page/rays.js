// Rays against the room's triangles, for what a click meets and where a walker may go: a tree of
// boxes, halved along the longest axis; Moeller and Trumbore 1997.
"use strict";

function makeRays(room) {
  const { points, triangles } = room.tables, count = triangles.length / 3;
  const order = Uint32Array.from({ length: count }, (_, k) => k), nodes = [];
  const corner = (t, k) => { const v = 3 * triangles[3 * t + k]; return [points[v], points[v + 1], points[v + 2]]; };
  const centres = new Float32Array(3 * count);
  for (let t = 0; t < count; ++t)
    for (let axis = 0; axis < 3; ++axis)
      centres[3 * t + axis] = (corner(t, 0)[axis] + corner(t, 1)[axis] + corner(t, 2)[axis]) / 3;

  function build(first, last) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let k = first; k < last; ++k)
      for (let c = 0; c < 3; ++c)
        corner(order[k], c).forEach((x, axis) => { low[axis] = Math.min(low[axis], x); high[axis] = Math.max(high[axis], x); });
    const node = { low, high, first, last, next: null };
    nodes.push(node);
    if (last - first > 8) {
      const size = minus(high, low), axis = size.indexOf(Math.max(...size)), middle = (first + last) >> 1;
      order.subarray(first, last).sort((a, b) => centres[3 * a + axis] - centres[3 * b + axis]);
      node.next = [build(first, middle), build(middle, last)];
    }
    return node;
  }
  const root = count ? build(0, count) : null;

  function meetsBox(node, origin, direction, most) {
    let near = 0, far = most;
    for (let axis = 0; axis < 3; ++axis) {
      const inverse = 1 / direction[axis];
      let a = (node.low[axis] - origin[axis]) * inverse, b = (node.high[axis] - origin[axis]) * inverse;
      if (a > b) [a, b] = [b, a];
      near = a > near ? a : near;
      far = b < far ? b : far;
    }
    return near <= far * 1.000001 + 1e-9;
  }
  function meet(triangle, origin, direction) {
    const a = corner(triangle, 0), e1 = minus(corner(triangle, 1), a), e2 = minus(corner(triangle, 2), a);
    const p = cross(direction, e2), determinant = dot(e1, p);
    if (!(determinant > 0)) return null; // a back
    const s = minus(origin, a), u = dot(s, p) / determinant, q = cross(s, e1), v = dot(direction, q) / determinant;
    if (u < 0 || v < 0 || u + v > 1) return null;
    const distance = dot(e2, q) / determinant;
    return distance > 0 ? { triangle, distance, u, v, normal: unit(cross(e1, e2)) } : null;
  }
  /// The nearest front that the ray meets, or null.
  return function nearest(origin, direction, most = Infinity) {
    let best = null;
    const stack = root ? [root] : [];
    while (stack.length) {
      const node = stack.pop();
      if (!meetsBox(node, origin, direction, best ? best.distance : most)) continue;
      if (node.next) { stack.push(...node.next); continue; }
      for (let k = node.first; k < node.last; ++k) {
        const hit = meet(order[k], origin, direction);
        if (hit && hit.distance < (best ? best.distance : most)) best = hit;
      }
    }
    return best;
  };
}

/// The same, its tree built when it is asked for the first ray into these triangles.
function raysWhenAsked(room) {
  let rays = null, of = null;
  return (...ray) => {
    if (of !== room.tables) [rays, of] = [makeRays(room), room.tables];
    return rays(...ray);
  };
}

/// The way of a ray by mirrors: its points, and the hit on what is none, with its part of the room; null where it leaves.
function followRay(room, rays, origin, direction) {
  const points = [origin];
  for (let mirrors = 0;; ++mirrors) {
    const hit = rays(origin, direction);
    if (!hit) return { points, hit: null };
    const part = partOf(room, hit.triangle), at = plus(origin, direction, hit.distance);
    points.push(at);
    if (mirrors === 31 || !room.mirrors.some(m => m.number === part.mirror && m.kind === "mirror")) return { points, hit, part };
    direction = reflected(direction, hit.normal, 0);
    origin = plus(at, hit.normal, 1e-5 * room.size);
  }
}

/// What a ray meets, by way of mirrors: the part of the room, its light there, and how many mirrors.
function lightMet(room, rays, origin, direction) {
  const { points, hit, part } = followRay(room, rays, origin, direction);
  if (!hit) return null;
  const weights = [1 - hit.u - hit.v, hit.u, hit.v], irradiance = [0, 0, 0];
  weights.forEach((w, k) => {
    const v = room.tables.triangles[3 * hit.triangle + k];
    for (let band = 0; band < 3; ++band)
      irradiance[band] += w * room.lamps.irradiance()[3 * v + band] * room.data.light;
  });
  return { ...part, at: points[points.length - 1], irradiance, mirrors: points.length - 2 };
}
