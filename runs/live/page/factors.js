// Form factors of the element under the cursor in false colours, F_ij / A_j per m^2, so that elements of any
// size can be compared; and some rays of its hemisphere, by mirrors too.
"use strict";

const shownRays = 64;

/// Rays of a cosine-distributed hemisphere from the middle of an element (Malley's method over Hammersley's points), as
/// pairs of points; those alone that meet a mirror where `byMirrors`.
function raysFrom(room, rays, { middle, normal }, byMirrors) {
  const across = unit(cross(normal, Math.abs(normal[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0])), along = cross(normal, across);
  const origin = plus(middle, normal, 1e-5 * room.size), ends = [];
  for (let k = 0; k < shownRays; ++k) {
    let fraction = 0;
    for (let bits = k, half = 0.5; bits; bits >>= 1, half /= 2) fraction += half * (bits & 1);
    const radius = Math.sqrt((k + 0.5) / shownRays), angle = 2 * Math.PI * fraction;
    const direction = plus(plus(times(normal, Math.sqrt(1 - radius * radius)), across, radius * Math.cos(angle)), along, radius * Math.sin(angle));
    const { points } = followRay(room, rays, origin, direction);
    for (let j = 1; j < points.length && !(byMirrors && points.length < 3); ++j) ends.push(points[j - 1], points[j]);
  }
  return ends;
}

/// Halves of F by element of the page, in two columns (runs/live/factor_rows.h).
async function readFactors(buffer) {
  const head = await readMessage(buffer), factors = [];
  for (let column = 0; column < 2; ++column)
    factors.push(Float64Array.from({ length: head.rows }, (_, k) => halfNumbers[head.values[2 * k + column] & 0x7fff] * head.scale));
  return { ...head, direct: factors[0], mirrored: factors[1], sums: [head.direct, head.mirrored] };
}

/// `page` is that of main.js, its elements apart; `given` asks the server and throws a sentence, `say` shows one.
/// Returns { press, hide, shown }.
function makeFactors(page, given, say) {
  const parts = ["all", "mirrored"];
  let row = null, part = 0, asked = 0;

  function hide() {
    ++asked;
    if (!row) return;
    row = null;
    page.showInstead(null);
    delete document.body.dataset.factors;
    say("");
  }
  function show() {
    const { tables } = page.room, areas = areasOfElements(tables), all = parts[part] === "all";
    const density = areas.map((area, k) => area > 0 ? ((all ? row.direct[k] : 0) + row.mirrored[k]) / area : 0);
    const sorted = density.filter(x => x > 0).sort(), top = sorted.length ? sorted[Math.floor(0.98 * (sorted.length - 1))] : 1;
    const values = new Float32Array(3 * tables.elementOf.length);
    tables.elementOf.forEach((element, v) => values.fill(density[element], 3 * v, 3 * v + 3));
    const shape = shapeOfElement(tables, row.element);
    page.showInstead({ values, top, title: all ? "form factors F/A from the outlined element, 1/m²" : "those by way of mirrors, F/A, 1/m²",
      lines: [...shape.edges.flat().map(point => plus(point, shape.normal, 2e-4 * page.room.size)), ...raysFrom(page.room, page.rays, shape, !all)] });
    const [direct, mirrored] = row.sums, lost = [["leave the room", row.escaped], ["mirrors keep", row.absorbed], ["black backs", row.black]].filter(([, x]) => x > 5e-4);
    say(`ΣF ${(direct + mirrored).toFixed(3)}: ${direct.toFixed(3)} directly, ${mirrored.toFixed(3)} by way of mirrors` + lost.map(([what, x]) => `; ${what} ${x.toFixed(3)}`).join(""));
    document.body.dataset.factors = JSON.stringify({ element: row.element, part: parts[part], direct, mirrored, area: shape.area });
  }
  /// All of the element that is seen under the cursor, those by mirrors, and none again.
  async function press(room) {
    const triangle = page.triangleAtCursor();
    if (triangle === null) { hide(); return; }
    const element = elementOfTriangle(page.room.tables, triangle);
    if (row && row.room === room && row.element === element) {
      if (++part === parts.length) hide(); else show();
      return;
    }
    const mine = ++asked, reply = await given(`factors?room=${room}&element=${element}`);
    const fresh = await readFactors(await reply.arrayBuffer());
    if (mine !== asked) return;
    [row, part] = [fresh, 0];
    show();
  }
  return { press, hide };
}
