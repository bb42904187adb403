// The elements of the room apart: each with vertices of its own, so that it can be shown as constant, and by a
// number of its own.
"use strict";

const vertexTables = { position: 3, irradiance: 3, normal: 2, place: 4, colour: 4, look: 1 };

/// In place: vertices of several elements become one to each. `from` and `elementOf` are, by vertex, that
/// which it was and its element; `bits` is the light as it came.
function splitElements(tables) {
  const { triangles, elementEnds } = tables, own = new Int32Array(tables.look.length), lastOf = new Int32Array(tables.look.length).fill(-1);
  const from = [], elementOf = [], fresh = new Int32Array(triangles.length);
  let first = 0;
  elementEnds.forEach((end, element) => {
    for (let k = 3 * first; k < 3 * end; ++k) {
      const v = triangles[k];
      if (lastOf[v] !== element) {
        [lastOf[v], own[v]] = [element, from.length];
        from.push(v);
        elementOf.push(element);
      }
      fresh[k] = own[v];
    }
    first = end;
  });
  Object.assign(tables, { bits: tables.irradiance, triangles: fresh, from: Uint32Array.from(from), elementOf: Uint32Array.from(elementOf) });
  for (const [name, columns] of Object.entries(vertexTables)) if (tables[name]) tables[name] = atOwnVertices(tables, tables[name], columns);
}

/// Numbers by vertex as they came, by the vertices of the elements apart.
function atOwnVertices({ from }, values, columns) {
  const spread = new values.constructor(columns * from.length);
  for (let k = 0; k < from.length; ++k)
    for (let c = 0; c < columns; ++c) spread[columns * k + c] = values[columns * from[k] + c];
  return spread;
}

/// The same everywhere on an element: the mean of its vertices.
function meansOfElements({ elementOf, elementEnds }, values) {
  const sums = new Float64Array(3 * elementEnds.length), counts = new Float64Array(elementEnds.length);
  elementOf.forEach((element, v) => {
    ++counts[element];
    for (let c = 0; c < 3; ++c) sums[3 * element + c] += values[3 * v + c];
  });
  return values.map((_, k) => { const element = elementOf[Math.floor(k / 3)]; return sums[3 * element + k % 3] / counts[element]; });
}

/// That of a triangle.
function elementOfTriangle({ elementEnds }, triangle) {
  let low = 0, high = elementEnds.length - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (triangle < elementEnds[middle]) high = middle; else low = middle + 1;
  }
  return low;
}

/// Its middle, normal and area, and the edges around it as pairs of points.
function shapeOfElement({ points, triangles, elementEnds }, element) {
  const corner = k => { const v = 3 * triangles[k]; return [points[v], points[v + 1], points[v + 2]]; };
  let area = [0, 0, 0], middle = [0, 0, 0];
  const edges = new Map();
  for (let t = element ? elementEnds[element - 1] : 0; t < elementEnds[element]; ++t) {
    const p = [0, 1, 2].map(k => corner(3 * t + k)), own = times(cross(minus(p[1], p[0]), minus(p[2], p[0])), 0.5);
    area = plus(area, own);
    middle = plus(middle, times(plus(plus(p[0], p[1]), p[2]), 1 / 3), lengthOf(own));
    for (let k = 0; k < 3; ++k) {
      const [a, b] = [triangles[3 * t + k], triangles[3 * t + (k + 1) % 3]];
      if (!edges.delete(b + "," + a)) edges.set(a + "," + b, [p[k], p[(k + 1) % 3]]);
    }
  }
  const size = lengthOf(area);
  return { area: size, normal: unit(area), middle: times(middle, 1 / (size || 1)), edges: [...edges.values()] };
}

/// By element, m^2.
function areasOfElements({ points, triangles, elementEnds }) {
  const areas = new Float64Array(elementEnds.length), corner = k => { const v = 3 * triangles[k]; return [points[v], points[v + 1], points[v + 2]]; };
  let t = 0;
  elementEnds.forEach((end, element) => {
    for (; t < end; ++t) {
      const a = corner(3 * t);
      areas[element] += 0.5 * lengthOf(cross(minus(corner(3 * t + 1), a), minus(corner(3 * t + 2), a)));
    }
  });
  return areas;
}
