// The room as the page draws it: runs of triangles by section and textures, mirrors with theirs.
"use strict";

const sections = { single: 0, both: 1, pane: 2 };

/// Runs that follow one another and are drawn alike are one.
/// Bodies that show what their middle sees are by themselves, with the number of their node.
function joinedRuns(data, tables, batches) {
  const runs = [];
  for (const batch of batches) {
    const [section, colour, emission, mirror, node, first, count] = batch, last = runs[runs.length - 1];
    const body = isBody(lookOf(data, tables, batch)) ? node : -1;
    if (last && section !== sections.pane && last.section === section && last.colour === colour
      && last.emission === emission && last.node === body && last.first + last.count === first) {
      last.count += count;
      last.parts.push(...batch.parts);
    } else runs.push({ section, group: batch.group, colour, emission, first, count, node: body, parts: [...batch.parts],
      mirror: section === sections.pane ? mirror : -1 });
  }
  return runs;
}

/// Whether it shows what its middle sees: of rough mirrors beside what their world's picture has.
const minRough = 0.03;
const isBody = look => look.kind >= kinds.curved || (look.kind === kinds.mirror && look.roughness > minRough);

/// Textures by as many as one draw can show. Gives every batch the group that has both of its textures.
const maxSheets = 8;
function groupSheets(batches) {
  const groups = [];
  for (const batch of batches) {
    const needed = [...new Set([batch[1], batch[2]])].filter(texture => texture >= 0);
    const joined = ({ units }) => [...new Set([...units, ...needed])];
    batch.group = groups.find(group => joined(group).length <= maxSheets);
    if (!batch.group) groups.push(batch.group = { units: [] });
    batch.group.units = joined(batch.group);
  }
  return groups;
}

/// The units of textures by what they are for.
function sheetsOf(data) {
  const units = (which, has) => [...new Set(data.batches.filter(has).map(batch => batch.group.units.indexOf(batch[which])))].filter(unit => unit >= 0);
  return { colours: units(1, () => true), emissions: units(2, () => true), holes: units(1, batch => batch[0] !== sections.single && data.looks.some(look => look.cutoff >= 0)) };
}

/// Triangles that are next to one another in the file are next to one another in the room: so many of a batch are left out
/// together where their box is not seen. A pane is one part: it is drawn in its turn.
const minOfPart = 512, maxParts = 1024;
function partsOf(tables, [section, , , , , first, count]) {
  const step = section === sections.pane ? count : Math.max(minOfPart, Math.ceil(tables.triangles.length / 3 / maxParts)), parts = [];
  for (let from = first; from < first + count; from += step) {
    const part = { first: from, count: Math.min(step, first + count - from) };
    parts.push({ ...part, ...boxOf(tables, part) });
  }
  return parts;
}

/// What a page's shader has to have: only that is compiled. It is known before the tables are read.
function needsOf(data) {
  const { looks, batches } = data, groups = groupSheets(batches), has = name => data.tables.some(table => table.name === name);
  return { groups, bodies: looks.some(isBody), rough: looks.some(({ kind, roughness }) => (kind === kinds.mirror || kind === kinds.coat) && roughness > minRough),
    panes: batches.some(batch => batch[0] === sections.pane), sky: Boolean(data.sky), colours: has("colour"), sheets: sheetsOf(data) };
}

function lookOf(data, tables, batch) { return data.looks[tables.look[tables.triangles[3 * batch[5]]]]; }

/// The box around triangles.
function boxOf({ points, triangles }, { first, count }) {
  let [a, b, c] = [Infinity, Infinity, Infinity], [d, e, f] = [-Infinity, -Infinity, -Infinity];
  for (let k = 3 * first; k < 3 * (first + count); ++k) {
    const v = 3 * triangles[k], x = points[v], y = points[v + 1], z = points[v + 2];
    if (x < a) a = x;
    if (y < b) b = y;
    if (z < c) c = z;
    if (x > d) d = x;
    if (y > e) e = y;
    if (z > f) f = z;
  }
  return { low: [a, b, c], high: [d, e, f] };
}

/// The box around all parts, which themselves become larger by a hundred thousandth of it: rounding leaves none of them out.
function boxOfParts(parts) {
  const most = (which, end) => [0, 1, 2].map(axis => parts.reduce((x, part) => which(x, part[end][axis]), which()));
  const low = most(Math.min, "low"), high = most(Math.max, "high"), margin = 1e-5 * lengthOf(minus(high, low));
  for (const part of parts) [part.low, part.high] = [part.low.map(x => x - margin), part.high.map(x => x + margin)];
  return { low, high };
}

function middleOf(tables, run) {
  let sum = [0, 0, 0];
  for (let t = run.first; t < run.first + run.count; ++t)
    for (let k = 0; k < 3; ++k) {
      const v = tables.triangles[3 * t + k];
      sum = plus(sum, [tables.points[3 * v], tables.points[3 * v + 1], tables.points[3 * v + 2]]);
    }
  return times(sum, 1 / (3 * run.count));
}

/// Mean radiance of the vertices under their irradiance, for what a curved mirror shows at the least.
function meanRadiance(data, tables, irradiance) {
  const sum = [0, 0, 0], count = tables.look.length, reflectances = data.looks.map(look => plus(look.albedo, look.rest));
  for (let v = 0; v < count; ++v) {
    const rho = reflectances[tables.look[v]];
    for (let k = 0; k < 3; ++k) sum[k] += irradiance[3 * v + k] * rho[k];
  }
  return times(sum, data.light / Math.PI / Math.max(1, count));
}

/// The first so many triangles the other way round. Their vertices, `of` which of the room, have the normal of their
/// plane, whose slope the shader needs: facets that share one of the room have one each. `corners` three to a triangle.
function makeBacks({ points, triangles }, count) {
  const newest = new Int32Array(points.length / 3).fill(-1), earlier = new Int32Array(3 * count), corners = new Uint32Array(3 * count);
  const of = new Uint32Array(3 * count), normals = new Float32Array(6 * count), tolerance = 1e-3; // less than a tenth of a degree
  let made = 0;
  for (let k = 0; k < 3 * count; k += 3) {
    const a = 3 * triangles[k], b = 3 * triangles[k + 1], c = 3 * triangles[k + 2];
    const ux = points[b] - points[a], uy = points[b + 1] - points[a + 1], uz = points[b + 2] - points[a + 2];
    const vx = points[c] - points[a], vy = points[c + 1] - points[a + 1], vz = points[c + 2] - points[a + 2];
    // On the octahedron; of what has no area any will do.
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx, sum = Math.abs(nx) + Math.abs(ny) + Math.abs(nz) || 1;
    let x = nx / sum, y = ny / sum;
    if (nz < 0) {
      const before = x;
      x = (1 - Math.abs(y)) * (x < 0 ? -1 : 1);
      y = (1 - Math.abs(before)) * (y < 0 ? -1 : 1);
    }
    for (let corner = 0; corner < 3; ++corner) {
      const v = triangles[k + 2 - corner];
      let own = newest[v];
      while (own >= 0 && Math.max(Math.abs(normals[2 * own] - x), Math.abs(normals[2 * own + 1] - y)) > tolerance) own = earlier[own];
      if (own < 0) {
        own = made++;
        of[own] = v;
        normals[2 * own] = x;
        normals[2 * own + 1] = y;
        earlier[own] = newest[v];
        newest[v] = own;
      }
      corners[k + corner] = own;
    }
  }
  return { count, of: of.subarray(0, made), normals: normals.subarray(0, 2 * made), corners };
}

function readRoom(data, tables) {
  tables.points = inUnits(tables.position, data.step);
  data.batches.forEach(batch => { batch.parts = partsOf(tables, batch); });
  const { low, high } = boxOfParts(data.batches.flatMap(batch => batch.parts));
  const needs = needsOf(data), runs = joinedRuns(data, tables, data.batches);
  const room = { needs, groups: needs.groups, data, tables, low, high, size: lengthOf(minus(high, low)), lamps: makeLamps(data, tables), ambient: [0, 0, 0] };
  room.opaque = runs.filter(run => run.section !== sections.pane);
  room.panes = runs.filter(run => run.section === sections.pane);
  room.panes.forEach(run => {
    const { kind, f0, tint } = data.looks[tables.look[tables.triangles[3 * run.first]]], isEven = ([r, g, b]) => Math.max(r, g, b) - Math.min(r, g, b) < 1e-6;
    // Whether what it passes of light is one number.
    Object.assign(run, { middle: middleOf(tables, run), plane: data.mirrors[run.mirror], isGrey: kind !== kinds.pane || (isEven(f0) && isEven(tint)) });
  });
  room.probes = findProbes(room);
  room.mirrors = data.mirrors.map((mirror, number) => ({ ...mirror, number, ...roughnessOf(data, tables, mirror, number),
    runs: joinedRuns(data, tables, data.batches.filter(b => b[3] === number)) }))
    .filter(mirror => mirror.runs.length && mirror.number < maxMirrors);
  // Only mirrors show what is black from behind.
  room.backs = makeBacks(tables, room.mirrors.length ? data.batches.filter(b => b[0] === sections.single).reduce((sum, b) => sum + b[6], 0) : 0);
  return room;
}

/// Whether what it mirrors is blurred: it is drawn aside, as what panes mirror, and by how much, alpha.
function roughnessOf(data, tables, mirror, number) {
  const batch = data.batches.find(b => b[3] === number);
  const roughness = mirror.kind === "pane" || !batch ? 0 : lookOf(data, tables, batch).roughness;
  return { rough: roughness > minRough, alpha: roughness ** 2 };
}

/// The node and the look of a triangle.
function partOf(room, triangle) {
  const batch = room.data.batches.find(b => triangle >= b[5] && triangle < b[5] + b[6]);
  return { node: batch[4] < 0 ? "" : room.data.nodes[batch[4]], mirror: batch[3],
    textured: batch[1] >= 0, look: room.data.looks[room.tables.look[room.tables.triangles[3 * triangle]]] };
}

/// The ends of the edges of elements: those that one triangle alone of an element has.
function elementEdges({ triangles, elementEnds }) {
  const ends = [];
  let first = 0;
  for (const end of elementEnds) {
    const edges = new Map();
    for (let t = first; t < end; ++t)
      for (let k = 0; k < 3; ++k) {
        const a = triangles[3 * t + k], b = triangles[3 * t + (k + 1) % 3], key = a < b ? a + "," + b : b + "," + a;
        if (!edges.delete(key)) edges.set(key, [a, b]);
      }
    for (const edge of edges.values()) ends.push(edge[0], edge[1]);
    first = end;
  }
  return Uint32Array.from(ends);
}
