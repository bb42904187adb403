// The triangles of a frame, in the order in which they are drawn: of each world its window on the screen, then what it
// may show, then the sky around its eye. One draw needs one row of triangles, so those that are seen are copied behind
// one another by the graphics card.
"use strict";

/// Points of windows in a frame of so many worlds: each has the windows of one mirror. Where they do not fit beside what the
/// worlds to come need, a world's windows are as one.
const maxWindowPoints = 32768, pointsOfOne = 16;
const windowPointsOf = ({ mirrors }, worlds) => Math.min(maxWindowPoints, pointsOfOne * (mirrors.length ? worlds : 1) * Math.max(1, ...mirrors.map(mirror => mirror.windows.length)));

/// Where what is not in the tables is: vertices and triangles of black backs, the sky, and windows.
function placesBeside(room, worlds) {
  const { tables, backs } = room, vertices = tables.points.length / 3, triangles = tables.triangles.length / 3;
  const sky = vertices + backs.of.length, window = sky + 8;
  const points = windowPointsOf(room, worlds);
  return { back: vertices, sky, window, windowPoints: points, all: window + points, backTriangle: triangles, skyTriangle: triangles + backs.count,
    windowTriangle: triangles + backs.count + 12 };
}

/// The eight corners of a cube, and its squares as two triangles each, their fronts inwards.
const cubeCorners = Array.from({ length: 8 }, (_, k) => [k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1]);
const cubeTriangles = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
  .flatMap(([a, b, c, d]) => [a, b, c, a, c, d]);

/// The smallest convex polygon around points of the plane, counter-clockwise (Andrew 1979).
function hullOf(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]), turn = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const half = row => {
    const hull = [];
    for (const x of row) {
      while (hull.length > 1 && turn(hull[hull.length - 2], hull[hull.length - 1], x) <= 0) hull.pop();
      hull.push(x);
    }
    return hull.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

/// Windows on the screen, -1 to 1, a little larger: rounded they may not miss a sample that the mirror itself covers.
function windowsOnScreen({ camera, windows }, { width, height }) {
  if (!windows) return [[[-1, -1], [1, -1], [1, 1], [-1, 1]]];
  const pixels = 0.01, around = ([x, y]) => [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([i, j]) => [x + 2 * pixels * i / width, y + 2 * pixels * j / height]);
  return windows.map(window => hullOf(window.flatMap(x => around(projected(camera, x)))));
}

/// `positions` is the buffer of the vertices at their `places`. `drawn` is what the vertex array draws from.
function makeStream(gl, { tables, backs }, places, positions) {
  const all = gl.createBuffer(), drawn = gl.createBuffer();
  const fixed = new Uint32Array(3 * places.windowTriangle);
  fixed.set(tables.triangles);
  for (let k = 0; k < backs.corners.length; ++k) fixed[3 * places.backTriangle + k] = places.back + backs.corners[k];
  cubeTriangles.forEach((corner, k) => { fixed[3 * places.skyTriangle + k] = places.sky + corner; });
  for (const buffer of [drawn, all]) gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer); // what they are for is told by this
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, 4 * (fixed.length + 3 * places.windowPoints), gl.STATIC_DRAW);
  gl.bufferSubData(gl.ELEMENT_ARRAY_BUFFER, 0, fixed);
  let ranges, count, from, points, fans, capacity = 0;

  function begin() { [ranges, count, from, points, fans] = [[], 0, 0, [], []]; }
  function add(first, number) {
    const last = ranges[ranges.length - 1];
    if (last && last.first + last.number === first) last.number += number;
    else ranges.push({ first, number });
    count += number;
  }
  /// What is seen of a world, of so many still to come: backs of triangles there, so that they mark the stencil.
  function window(world, size, toCome) {
    let polygons = windowsOnScreen(world, size);
    const left = places.windowPoints - points.length / 3 - pointsOfOne * toCome;
    if (polygons.reduce((sum, p) => sum + p.length, 0) > left) polygons = [hullOf(polygons.flat())];
    if (polygons[0].length > left) polygons = windowsOnScreen({ windows: null }, size);
    for (const polygon of polygons) {
      const base = places.window + points.length / 3, first = fans.length / 3;
      for (const [x, y] of polygon) points.push(x, y, 1);
      for (let k = 2; k < polygon.length; ++k) fans.push(base, base + k, base + k - 1);
      add(places.windowTriangle + first, fans.length / 3 - first);
    }
  }
  /// What has been added since the last one.
  function segment() {
    const part = { first: from, count: count - from };
    from = count;
    return part;
  }
  function end() {
    gl.bindBuffer(gl.ARRAY_BUFFER, positions);
    gl.bufferSubData(gl.ARRAY_BUFFER, 12 * places.window, Float32Array.from(points));
    gl.bindBuffer(gl.COPY_READ_BUFFER, all);
    gl.bufferSubData(gl.COPY_READ_BUFFER, 12 * places.windowTriangle, Uint32Array.from(fans));
    gl.bindBuffer(gl.COPY_WRITE_BUFFER, drawn);
    if (count > capacity) gl.bufferData(gl.COPY_WRITE_BUFFER, 12 * (capacity = Math.ceil(1.25 * count)), gl.DYNAMIC_COPY);
    let to = 0;
    for (const { first, number } of ranges) {
      gl.copyBufferSubData(gl.COPY_READ_BUFFER, gl.COPY_WRITE_BUFFER, 12 * first, 12 * to, 12 * number);
      to += number;
    }
  }
  return { begin, window, add, segment, end, drawn, backs: (first, number) => add(places.backTriangle + first, number),
    sky: () => add(places.skyTriangle, 12), free: () => [all, drawn].forEach(buffer => gl.deleteBuffer(buffer)) };
}
