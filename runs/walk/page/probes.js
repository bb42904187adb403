// What curved mirrors and solids of glass show: the room as the middle of their body sees it, once, in
// six squares of a cube without that body and without mirrors. Right for a small ball, near enough
// elsewhere; never a hole.
"use strict";

/// Bodies beyond so many show the mean light of the room.
const maxProbes = 12, probeSize = 128;

/// Right, up and forward of the squares of a cube, as cube maps have them, +X, -X, +Y, -Y, +Z, -Z.
const cubeFrames = [[[0, 0, -1], [0, -1, 0], [1, 0, 0]], [[0, 0, 1], [0, -1, 0], [-1, 0, 0]], [[1, 0, 0], [0, 0, 1], [0, 1, 0]],
  [[1, 0, 0], [0, 0, -1], [0, -1, 0]], [[1, 0, 0], [0, -1, 0], [0, 0, 1]], [[-1, 0, 0], [0, -1, 0], [0, 0, -1]]];

/// Gives every run of such a body its probe; largest bodies first.
function findProbes(room) {
  const bodies = new Map();
  for (const run of room.opaque.filter(r => r.node >= 0)) {
    const body = bodies.get(run.node) || { node: run.node, runs: [], count: 0 };
    body.runs.push(run);
    body.count += run.count;
    bodies.set(run.node, body);
  }
  const probes = [...bodies.values()].sort((a, b) => b.count - a.count).slice(0, maxProbes);
  for (const probe of probes) {
    const boxes = probe.runs.map(run => boxOf(room.tables, run)), outermost = (most, end) => [0, 1, 2].map(axis => most(...boxes.map(box => box[end][axis])));
    const low = outermost(Math.min, "low"), high = outermost(Math.max, "high");
    probe.place = times(plus(low, high), 0.5);
    probe.thickness = Math.min(...minus(high, low));
  }
  return probes;
}

/// The light of a probe, in that of its picture, until it is filled anew: by the mean of the room's.
const ratioOf = (probe, ambient) => ambient.map((x, k) => probe.ambient[k] > 0 ? x / probe.ambient[k] : 1);

/// The pictures of all bodies.
function makeProbes(gl, count) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D_ARRAY, texture);
  gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 8, gl.RGBA16F, probeSize, probeSize, 6 * Math.max(1, count));
  setFilters(gl, gl.LINEAR_MIPMAP_LINEAR, gl.LINEAR, gl.TEXTURE_2D_ARRAY);
  return texture;
}

/// `paintFace` draws the room without a body onto a square picture, and returns its framebuffer.
function fillProbe(gl, room, probe, texture, paintFace) {
  const part = gl.createFramebuffer();
  cubeFrames.forEach(([right, up, forward], face) => {
    const camera = { eye: probe.place, right, up, forward, half: 1, aspect: 1, near: 1e-3 * room.size, far: 2 * room.size };
    const drawn = paintFace(camera, probe);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, drawn);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, part);
    gl.framebufferTextureLayer(gl.DRAW_FRAMEBUFFER, gl.COLOR_ATTACHMENT0, texture, 0, 6 * room.probes.indexOf(probe) + face);
    gl.blitFramebuffer(0, 0, probeSize, probeSize, 0, 0, probeSize, probeSize, gl.COLOR_BUFFER_BIT, gl.NEAREST);
  });
  gl.bindTexture(gl.TEXTURE_2D_ARRAY, texture);
  gl.generateMipmap(gl.TEXTURE_2D_ARRAY);
  gl.deleteFramebuffer(part);
  [probe.state, probe.ambient] = [room.lamps.state, room.ambient];
}
