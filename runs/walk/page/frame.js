// One frame: the tree of visible worlds, the deepest first, one draw to a world.
//
// The worlds by way of so many mirrors are drawn onto one picture, each where its windows are on the screen; then those by one
// mirror less, whose mirrors show that picture at their own pixels: L = L_own + R(cos) L_mirrored. So the surface of a mirror
// does by itself all that its look has, and hides and is hidden as any other.
// A draw begins with the world's windows, as backs of triangles: these alone mark the stencil, where fronts are drawn
// (stencil operations for the two faces, Kilgard 1999). What some windows hide of others is drawn before.
// What a pane mirrors is drawn aside, since what is behind it shows as well: L = T L_behind + R L_mirrored; what a rough
// surface blurs too, since it takes from beside its window.
"use strict";

/// The shaders of a page with such a room.
const programsFor = (needs, transform) => [[roomVertex(needs), roomFragment(needs)], [wholeVertex, screenFragment(transform)]];

/// A frame of a room of two triangles, which is not kept: what is behind the eye, in a mirror before it. Software that draws
/// compiles programs when they first draw, in threads of its own: it goes on with that while the room is read. Nothing is
/// asked that would have to wait for them.
function paintNothing(gl, data) {
  const mirror = [[-1, -1, -1], [1, -1, -1], [0, 1, -1]], back = [[1, -1, 1], [-1, -1, 1], [0, 1, 1]];
  const bare = { ...data, step: 1, batches: [[sections.single, -1, -1, 0, -1, 0, 1], [sections.single, -1, -1, -1, -1, 1, 1]],
    mirrors: data.mirrors.length ? [{ kind: "mirror", normal: [0, 0, 1], offset: -1, reflectance: 1, windows: [mirror] }] : [],
    looks: [{ ...data.looks[0], kind: kinds.plain, roughness: 0, lamp: -1 }], lamps: [], skyLamp: -1, sky: null };
  const tables = { position: Int32Array.from([mirror, back].flat(2)), irradiance: new Uint16Array(18), look: new Int32Array(6), triangles: Int32Array.of(0, 1, 2, 3, 4, 5), elementEnds: [1, 2] };
  for (const name of ["place", "colour"]) if (data.tables.some(table => table.name === name)) tables[name] = new Int32Array(24);
  const room = Object.assign(readRoom(bare, tables), { needs: needsOf(data) }), worlds = 2, painter = makePainter(gl, bare, room, [], worlds);
  painter.paint({ eye: [0, 0, 0], right: [1, 0, 0], up: [0, 1, 0], forward: [0, 0, -1], half: 2, aspect: 1, near: 1e-3 * room.size, far: 2 * room.size },
    { mirrors: true, falseColours: false, lines: false, width: 8, height: 8, block: 1, samples: coarseWay(room.needs).samples, most: worlds, exposure: 0 });
  gl.clear(gl.COLOR_BUFFER_BIT);
  gl.flush();
  painter.free();
}

/// Frames have at most `maxWorlds` worlds.
function makePainter(gl, data, room, textures, maxWorlds) {
  const [roomProgram, screenProgram] = makePrograms(gl, programsFor(room.needs, data.transform));
  const { array, light, stream, buffers } = makeRoomArrays(gl, room, maxWorlds), looks = gl.createTexture();
  const nothing = gl.createVertexArray(), scale = makeScale(gl, data.falseColours), targets = [];
  const { probes, groups } = room, probePictures = makeProbes(gl, probes.length); // its own, when another room is shown
  const black = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, black);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  setFilters(gl, gl.NEAREST, gl.NEAREST);
  const probeExposed = 2 ** data.cameras[0].exposure, firstSheet = 5;
  let lines = null, instead = null, options, draws, at = roomProgram.at, state = -1;

  const bind = (unit, texture, kind = gl.TEXTURE_2D) => { gl.activeTexture(gl.TEXTURE0 + unit); gl.bindTexture(kind, texture); };
  /// A rectangle of the picture, and the pixels that it touches.
  const scissor = (rectangle, { width, height }) => {
    const [left, bottom] = [Math.floor(rectangle[0] * width) - 1, Math.floor(rectangle[1] * height) - 1];
    gl.scissor(left, bottom, Math.ceil(rectangle[2] * width) + 1 - left, Math.ceil(rectangle[3] * height) + 1 - bottom);
  };
  const blend = (source, destination) => {
    if (source === undefined) return gl.disable(gl.BLEND);
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(source, destination, gl.ZERO, gl.ONE);
  };

  /// What the frame draws, in the stream of triangles; before anything is drawn.
  function plan(worlds) {
    stream.begin();
    worlds.forEach((world, w) => {
      const runs = room.opaque.filter(run => !options.without || run.node !== options.without.node);
      world.draws = groups.map((group, g) => {
        if (g === 0) stream.window(world, options, worlds.length - 1 - w);
        runs.filter(run => run.group === group).forEach(run => addRun(world, run));
        if (g === 0 && world.depth > 0 && room.backs.count > 0)
          for (const run of room.opaque.filter(r => r.section === sections.single)) addRun(world, run, stream.backs);
        if (g === 0) stream.sky();
        return { group, ...stream.segment() };
      });
      for (const child of world.children.filter(c => c.isBlurred)) {
        child.mirror.runs.forEach(run => addRun(world, run));
        child.surface = { group: child.mirror.runs[0].group, ...stream.segment() };
      }
      world.panes = options.falseColours ? [] : panesOf(world);
    });
    stream.end();
  }
  function addRun(world, run, add = stream.add) {
    for (const part of run.parts) if (mayShow(world, part)) add(part.first, part.count);
  }
  /// Panes from far to near, those together that cover nothing of one another on the screen.
  function panesOf(world) {
    const { camera } = world, distance = run => lengthOf(minus(run.middle, camera.eye)), sets = [];
    const faces = run => !run.plane || dot(run.plane.normal, camera.eye) > run.plane.offset;
    const apart = (a, b) => a[0] > b[2] || b[0] > a[2] || a[1] > b[3] || b[1] > a[3];
    for (const run of room.panes.filter(r => faces(r) && mayShow(world, r.parts[0])).sort((a, b) => distance(b) - distance(a))) {
      const rectangle = boxOnScreen(camera, run.parts[0]), last = sets[sets.length - 1];
      const set = last && last.group === run.group && last.rectangles.every(other => apart(rectangle, other)) ? last
        : { group: run.group, runs: [], rectangles: [], children: [], isGrey: true };
      if (set !== last) sets.push(set);
      set.runs.push(run);
      set.isGrey = set.isGrey && run.isGrey;
      set.rectangles.push(rectangle);
      set.children.push(...world.children.filter(c => c.mirror.number === run.mirror && !set.children.includes(c)));
    }
    return sets.map(set => {
      set.runs.forEach(run => addRun(world, run));
      return { ...set, ...stream.segment() };
    });
  }

  /// Onto a place's picture: the world's mark in the stencil, and what alpha tells.
  function useWorld(world, { place, mark, tells }) {
    const { camera, mirror } = world, target = bindTarget(place);
    gl.bindVertexArray(array);
    gl.uniform1i(at.tells, tells);
    gl.uniformMatrix4fv(at.viewProjection, false, viewProjection(camera));
    gl.uniform3fv(at.eye, camera.eye);
    gl.uniform3fv(at.pixelRight, times(camera.right, 2 * camera.half * camera.aspect / options.width));
    gl.uniform3fv(at.pixelUp, times(camera.up, 2 * camera.half / options.height));
    gl.uniform1f(at.depthFactor, 2 * camera.far * camera.near / (camera.far - camera.near));
    gl.uniform4fv(at.clip, mirror ? [...mirror.normal, mirror.offset + 2e-6 * room.size] : [0, 0, 0, -1]);
    scissor(world.rectangle, target);
    gl.stencilFuncSeparate(gl.FRONT, gl.EQUAL, mark, 255);
    gl.stencilFuncSeparate(gl.BACK, gl.ALWAYS, mark, 255);
    gl.depthFunc(gl.LEQUAL);
    gl.depthMask(true);
    gl.enable(gl.CULL_FACE);
    blend();
    const followed = new Uint32Array(maxMirrors / 32);
    for (const child of world.children) if (!child.isBlurred) followed[child.mirror.number >> 5] |= 1 << child.mirror.number % 32;
    gl.uniform4uiv(at["followed[0]"], followed);
    return target;
  }
  function draw({ group, first, count }, what, mirrored) {
    if (!count) return;
    gl.uniform1i(at.shows, what);
    group.units.forEach((texture, k) => bind(firstSheet + k, textures[texture]));
    bind(3, mirrored);
    gl.drawElements(gl.TRIANGLES, 3 * count, gl.UNSIGNED_INT, 12 * first);
    ++draws;
  }
  const isMirrored = child => !child.isBlurred && child.mirror.kind !== "pane";

  /// Worlds that hide nothing of one another, with what they mirror, onto the picture of a place.
  function drawTrees(roots, place) {
    const levels = [roots];
    for (let level = roots; level.length; levels.push(level))
      level = level.flatMap(world => farthestFirst(world.children.filter(isMirrored)));
    for (const level of levels.reverse()) {
      if (!level.length) continue;
      const own = place === 0 ? alphas.straight : roots[0].windows ? alphas.covered : alphas.distance;
      const whole = level.map(world => world.rectangle).reduce((a, b) => a.map((x, k) => k < 2 ? Math.min(x, b[k]) : Math.max(x, b[k])));
      level.forEach((world, k) => {
        if (k % 255 === 0) {
          scissor(whole, bindTarget(place));
          gl.clear(gl.STENCIL_BUFFER_BIT | (k ? 0 : gl.COLOR_BUFFER_BIT));
        }
        drawWorld(world, { place, mark: 1 + k % 255, tells: level === roots ? own : alphas.covered });
      });
      const target = bindTarget(place);
      scissor(whole, target);
      takeMean(target);
    }
    return targets[place].texture;
  }
  function drawWorld(world, onto) {
    const target = useWorld(world, onto);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.disable(gl.CULL_FACE);
    for (const part of world.draws) draw(part, shown.own, target.texture);
    gl.enable(gl.CULL_FACE);
    if (options.lines) drawLines();
    if (instead) drawInsteadLines();
    for (const child of world.children) if (child.isBlurred) drawRough(world, child, onto);
    for (const set of world.panes) drawPanes(world, set, onto);
  }
  /// Of what is shown in place of light.
  function drawInsteadLines() {
    if (instead !== room.instead) return;
    gl.bindVertexArray(instead.array);
    gl.uniform1i(at.shows, shown.lines);
    gl.uniform4f(at.lineColour, 0.6, 1, 1, 0.7);
    blend(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.drawArrays(gl.LINES, 0, instead.count);
    blend();
    gl.bindVertexArray(array);
    ++draws;
  }
  function drawLines() {
    if (!lines) {
      const ends = elementEdges(room.tables), triangles = gl.getParameter(gl.ELEMENT_ARRAY_BUFFER_BINDING);
      lines = { count: ends.length, triangles, ends: makeBuffer(gl, gl.ELEMENT_ARRAY_BUFFER, ends) };
    }
    gl.uniform1i(at.shows, shown.lines);
    gl.uniform4f(at.lineColour, 0, 0, 0, 0.45);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, lines.ends);
    blend(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.drawElements(gl.LINES, lines.count, gl.UNSIGNED_INT, 0);
    blend();
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, lines.triangles);
    ++draws;
  }

  /// A surface that blurs what it mirrors.
  function drawRough(world, child, onto) {
    const mirrored = drawTrees([child], onto.place + 1);
    useWorld(world, onto);
    gl.depthFunc(gl.EQUAL);
    bind(3, mirrored);
    gl.generateMipmap(gl.TEXTURE_2D);
    setFilters(gl, gl.LINEAR_MIPMAP_LINEAR, gl.LINEAR);
    gl.uniformMatrix4fv(at.asideProjection, false, viewProjection(child.camera));
    gl.uniform3fv(at.asideEye, child.camera.eye);
    draw(child.surface, shown.rough, mirrored);
    bind(3, mirrored);
    setFilters(gl, gl.NEAREST, gl.NEAREST);
  }
  /// Where what is passed is grey, one draw does it: T is a number by which what is there is multiplied.
  function drawPanes(world, set, onto) {
    const mirrored = set.children.length ? drawTrees(set.children, onto.place + 1) : black;
    useWorld(world, onto);
    gl.depthMask(false);
    if (!set.isGrey) {
      blend(gl.ZERO, gl.SRC_COLOR);
      draw(set, shown.passed, black);
    }
    blend(gl.ONE, set.isGrey ? gl.SRC_ALPHA : gl.ONE);
    draw(set, shown.pane, mirrored);
    blend();
    gl.depthMask(true);
  }

  function bindTarget(place) {
    const { width, height, samples } = options, is = targets[place];
    if (is && (is.width !== width || is.height !== height || is.asked !== samples)) {
      freeTarget(gl, targets[place]);
      targets[place] = null;
    }
    targets[place] = targets[place] || makeTarget(gl, width, height, samples);
    gl.bindFramebuffer(gl.FRAMEBUFFER, targets[place].drawn);
    gl.useProgram(roomProgram.program);
    return targets[place];
  }
  function takeMean({ drawn, mean, width, height }) {
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, drawn);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, mean);
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
  }

  function setConstants() {
    const exposed = 2 ** options.exposure;
    gl.useProgram(roomProgram.program);
    gl.uniform3fv(at.background, room.lamps.of(data.skyLamp).map((s, k) => s * data.background[k]));
    gl.uniform1f(at.skyScale, data.sky ? data.sky.brightness : 1);
    gl.uniform2fv(at.turned, data.sky ? data.sky.turned : [1, 0]);
    ["looks", "sky", "probes", "mirrored", "falseScale"].forEach((name, unit) => gl.uniform1i(at[name], unit));
    if (at["sheets[0]"]) gl.uniform1iv(at["sheets[0]"], Array.from({ length: maxSheets }, (_, k) => firstSheet + k));
    bind(0, looks);
    bind(1, textures.sky ? textures.sky.texture : black);
    bind(2, probePictures, gl.TEXTURE_2D_ARRAY);
    bind(4, scale);
    if (room.needs.bodies) gl.uniform4fv(at["bodies[0]"], bodyNumbers());
    gl.uniform1i(at.falseColours, options.falseColours);
    const { facets = 8, block = 1 } = options; // of 48 facets a quarter: more would reach below the horizon
    gl.uniform1i(at.facets, facets);
    gl.uniform1f(at.between, 0.25 * Math.sqrt(48 / facets / block));
    gl.uniform1f(at.lightScale, room.instead ? 1 : data.light);
    gl.uniform1f(at.exposed, exposed);
    gl.uniform1f(at.topIrradiance, room.instead ? room.instead.top : data.top);
    gl.uniform3fv(at.ambient, room.ambient);
    gl.uniform3fv(at.lowest, room.low);
    gl.uniform3fv(at.highest, room.high);
    gl.uniform2f(at.pictureSize, options.width, options.height);
  }

  /// Bodies see one another as if for the first time, whatever they showed under other lamps.
  function bodyNumbers() {
    const numbers = new Float32Array(8 * maxProbes), exposed = 2 ** options.exposure / probeExposed;
    probes.forEach((probe, k) => {
      const isOf = probe.state === room.lamps.state, has = probe.state !== undefined && (isOf || !options.without);
      const factor = has ? times(isOf ? [1, 1, 1] : ratioOf(probe, room.ambient), exposed) : [0, 0, 0];
      numbers.set([...probe.place, probe.thickness, ...factor, has ? 1 : 0], 8 * k);
    });
    return numbers;
  }

  function showOnScreen(block) {
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.STENCIL_TEST);
    gl.disable(gl.SCISSOR_TEST);
    gl.disable(gl.CULL_FACE);
    gl.viewport(0, 0, options.width / block, options.height / block);
    gl.useProgram(screenProgram.program);
    gl.bindVertexArray(nothing);
    bind(0, targets[0].texture);
    gl.uniform1i(screenProgram.at.picture, 0);
    gl.uniform1i(screenProgram.at.block, block);
    gl.uniform1i(screenProgram.at.asItIs, options.falseColours);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  function takeInsteadLines() {
    if (instead) freeInstead();
    if (!room.instead || !room.instead.lines.length) return;
    instead = Object.assign(room.instead, { array: gl.createVertexArray(), count: room.instead.lines.length });
    gl.bindVertexArray(instead.array);
    instead.buffer = makeBuffer(gl, gl.ARRAY_BUFFER, Float32Array.from(instead.lines.flat()));
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    gl.bindVertexArray(null);
    for (const place of [5, 6]) gl.vertexAttribI4ui(place, 0, 0, 0, 0); // what the shader wants of a line besides are whole numbers
  }
  function freeInstead() {
    gl.deleteVertexArray(instead.array);
    gl.deleteBuffer(instead.buffer);
    instead = null;
  }
  /// The room under its lamps as they are now, or what is shown in place of that.
  function relight() {
    if (state === room.lamps.state) return;
    state = room.lamps.state;
    const irradiance = room.lamps.irradiance();
    setValues(gl, light, room.instead ? room.instead.values : irradiance);
    takeInsteadLines();
    gl.activeTexture(gl.TEXTURE0);
    setLooks(gl, looks, room.lamps.looks());
    if (textures.sky) setSky(gl, textures.sky, room.lamps.of(data.skyLamp), room.lamps.of(data.sunLamp));
    if (room.needs.bodies || room.needs.rough) room.ambient = meanRadiance(data, room.tables, irradiance);
  }
  function begin() {
    gl.viewport(0, 0, options.width, options.height);
    for (const test of [gl.DEPTH_TEST, gl.STENCIL_TEST, gl.SCISSOR_TEST, gl.CULL_FACE]) gl.enable(test);
    gl.stencilOpSeparate(gl.FRONT, gl.KEEP, gl.KEEP, gl.KEEP);
    gl.stencilOpSeparate(gl.BACK, gl.KEEP, gl.KEEP, gl.REPLACE);
    setConstants();
  }
  /// The room alone, for a probe.
  function paintFace(camera, without) {
    const place = 4, root = rootWorld(camera);
    options = { width: probeSize, height: probeSize, samples: maxSamples, exposure: data.cameras[0].exposure, falseColours: false, lines: false, without };
    plan([root]);
    begin();
    drawTrees([root], place);
    return targets[place].mean;
  }
  /// What a body sees changes with the lamps alone: asked for when a first picture is there. Returns whether there was one left.
  /// Each is tried once: a graphics card that has dropped the page gives no texture, ever.
  function fillNextProbe() {
    relight();
    const probe = room.probes.find(p => p.state !== room.lamps.state);
    if (probe) fillProbe(gl, room, probe, probePictures, paintFace);
    return probe !== undefined;
  }

  /// `wanted`: width and height in pixels of the screen, block (pixels drawn along each side of one), samples of each, exposure, lines, falseColours, mirrors,
  /// and how many worlds at most. Returns figures of the frame.
  function paint(camera, wanted) {
    options = { ...wanted, width: wanted.width * wanted.block, height: wanted.height * wanted.block, falseColours: wanted.falseColours || Boolean(room.instead) };
    draws = 0;
    const blurs = mirror => mirror.rough && !options.falseColours;
    const follows = (mirror, world) => options.mirrors && (mirror.kind === "mirror" || !options.falseColours)
      && (!(mirror.kind === "pane" || blurs(mirror)) || world.asides < 2);
    const worlds = visibleWorlds(room, camera, options.most, follows, blurs);
    relight();
    plan(worlds.all);
    begin();
    drawTrees([worlds.root], 0);
    showOnScreen(options.block);
    return { worlds: worlds.count, cut: worlds.cut, depth: worlds.depth, draws };
  }
  /// What the graphics card keeps for this room; programs stay for the next.
  function free() {
    targets.forEach(target => target && freeTarget(gl, target));
    buffers.forEach(buffer => gl.deleteBuffer(buffer));
    if (lines) gl.deleteBuffer(lines.ends);
    if (instead) freeInstead();
    stream.free();
    [...textures, ...(textures.sky ? [textures.sky.texture] : []), probePictures, looks, scale, black]
      .forEach(texture => gl.deleteTexture(texture));
    [array, nothing].forEach(made => gl.deleteVertexArray(made));
  }
  /// After a frame: throws where the browser cannot draw into such pictures.
  function check() { targets.forEach(target => target && !target.isChecked && checkTarget(gl, target)); }
  return { paint, check, fillNextProbe, free };
}
