// One frame: the tree of visible worlds drawn by stencil (Kilgard 1999), one set of draws to a world.
//
// The window of a mirror counts the stencil up where its parent shows it; there depth and colour are
// cleared, and the room is drawn as the mirror's eye sees it, in front of the mirror alone and with
// fronts the other way round. Then the window takes the depth of the mirror again, multiplies
// what is there by R(cos), adds what the surface shows itself, and counts the stencil down.
// A pane lets what is behind it show as well, so what it mirrors is drawn aside, in a picture of its
// own, and then added: L = T L_behind + R L_mirrored.
"use strict";

function makePainter(gl, data, room, textures) {
  const roomProgram = makeProgram(gl, roomVertex, roomFragment(room.needs)), skyProgram = makeProgram(gl, wholeVertex, skyFragment);
  const screenProgram = makeProgram(gl, wholeVertex, screenFragment);
  const { array, light, buffers } = makeRoomArrays(gl, data, room.tables, room.lamps.irradiance()), looks = gl.createTexture();
  const nothing = gl.createVertexArray(), scale = makeScale(gl, data.falseColours), targets = [];
  const { probes } = room; // its own, when another room is shown
  const black = gl.createTexture(), blackCube = gl.createTexture();
  for (const [kind, texture] of [[gl.TEXTURE_2D, black], [gl.TEXTURE_CUBE_MAP, blackCube]]) {
    gl.bindTexture(kind, texture);
    const faces = kind === gl.TEXTURE_2D ? [kind] : [0, 1, 2, 3, 4, 5].map(k => gl.TEXTURE_CUBE_MAP_POSITIVE_X + k);
    for (const face of faces) gl.texImage2D(face, 0, gl.RGBA8, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    setFilters(gl, gl.NEAREST, gl.NEAREST, kind);
  }
  const probeExposed = 2 ** data.cameras[0].exposure;
  let lines = null, instead = null, options, draws, drawn, at = roomProgram.at, state = -1;

  const bind = (unit, texture, kind = gl.TEXTURE_2D) => { gl.activeTexture(gl.TEXTURE0 + unit); gl.bindTexture(kind, texture); };
  const scissor = (rectangle, { width, height }) => {
    const [left, bottom] = [Math.floor(rectangle[0] * width), Math.floor(rectangle[1] * height)];
    gl.scissor(left, bottom, Math.ceil(rectangle[2] * width) - left, Math.ceil(rectangle[3] * height) - bottom);
  };
  const stencil = (level, whenSeen) => { gl.stencilFunc(gl.EQUAL, level, 255); gl.stencilOp(gl.KEEP, gl.KEEP, whenSeen); };
  const blend = (source, destination) => {
    if (source === undefined) return gl.disable(gl.BLEND);
    gl.enable(gl.BLEND);
    gl.blendFunc(source, destination);
  };

  function useWorld(world) {
    const { camera, mirror } = world;
    drawn = world;
    gl.useProgram(roomProgram.program);
    gl.bindVertexArray(array);
    gl.uniformMatrix4fv(at.viewProjection, false, viewProjection(camera));
    gl.uniform3fv(at.eye, camera.eye);
    gl.uniform4fv(at.clip, mirror ? [...mirror.normal, mirror.offset + 2e-6 * room.size] : [0, 0, 0, -1]);
    gl.frontFace(world.depth % 2 ? gl.CW : gl.CCW);
  }
  /// Parts of a run that the world can show, those in a row together: a draw costs more than a few
  /// triangles between them.
  function drawParts(run) {
    const fewTriangles = 4096;
    let first = 0, count = 0;
    for (const part of run.parts) {
      if (!mayShow(drawn, part)) continue;
      if (count && part.first > first + count + fewTriangles) { draw(first, count); count = 0; }
      if (!count) first = part.first;
      count = part.first + part.count - first;
    }
    if (count) draw(first, count);
  }
  function draw(first, count) {
    gl.drawElements(gl.TRIANGLES, 3 * count, gl.UNSIGNED_INT, 12 * first);
    ++draws;
  }
  function drawRuns(runs, what) {
    gl.uniform1i(at.shows, what);
    for (const run of runs) {
      gl.uniform1i(at.hasColour, run.colour >= 0);
      gl.uniform1i(at.hasEmission, run.emission >= 0);
      bind(1, run.colour >= 0 ? textures[run.colour] : black);
      bind(2, run.emission >= 0 ? textures[run.emission] : black);
      // Probes see one another as if for the first time, whatever they showed under other lamps.
      const isOf = run.probe && run.probe.state === room.lamps.state, probe = run.probe && (isOf || !options.without) && run.probe.texture;
      gl.uniform1i(at.hasProbe, probe ? 1 : 0);
      if (probe) {
        bind(5, probe, gl.TEXTURE_CUBE_MAP);
        gl.uniform3fv(at.probeScale, times(isOf ? [1, 1, 1] : ratioOf(run.probe, room.ambient), 2 ** options.exposure / probeExposed));
        gl.uniform3fv(at.probePlace, run.probe.place);
        gl.uniform1f(at.thickness, run.probe.thickness);
      }
      drawParts(run);
    }
  }
  function drawSky(camera, place) {
    const sky = skyProgram.at;
    gl.useProgram(skyProgram.program);
    gl.bindVertexArray(nothing);
    gl.uniform3fv(sky.right, times(camera.right, camera.half * camera.aspect));
    gl.uniform3fv(sky.up, times(camera.up, camera.half));
    gl.uniform3fv(sky.forward, camera.forward);
    gl.uniform1f(sky.depth, 1);
    gl.uniform1f(sky.alpha, place > 0 ? 6e4 : 1);
    gl.frontFace(gl.CCW);
    gl.depthFunc(gl.ALWAYS);
    gl.depthMask(true);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.depthFunc(gl.LEQUAL);
    ++draws;
  }

  /// What all mirrors in it are drawn onto.
  function drawOpaque(world) {
    if (world.depth > 0 && room.backs > 0) {
      gl.cullFace(gl.FRONT);
      gl.enable(gl.POLYGON_OFFSET_FILL);
      gl.polygonOffset(2, 2);
      gl.uniform1i(at.shows, shown.black);
      gl.uniform1i(at.hasColour, false);
      draw(0, room.backs);
      gl.cullFace(gl.BACK);
      gl.disable(gl.POLYGON_OFFSET_FILL);
    }
    drawRuns(options.without ? room.opaque.filter(run => !options.without.has(run)) : room.opaque, shown.own);
    if (options.lines) drawLines();
    if (instead) drawInsteadLines();
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

  function drawMirror(world, child, level, place) {
    const target = targets[place], { mirror } = child;
    useWorld(world);
    scissor(child.rectangle, target);
    blend();
    stencil(level, gl.INCR);
    gl.colorMask(false, false, false, false);
    gl.depthMask(false);
    drawRuns(mirror.runs, shown.weight);
    gl.colorMask(true, true, true, true);
    stencil(level + 1, gl.KEEP);
    drawSky(child.camera, place);
    drawWorld(child, level + 1, place);

    useWorld(world);
    scissor(child.rectangle, target);
    stencil(level + 1, gl.DECR);
    gl.depthFunc(gl.ALWAYS);
    gl.depthMask(true);
    blend(gl.ZERO, gl.SRC_COLOR);
    drawRuns(mirror.runs, shown.weight);
    stencil(level, gl.KEEP);
    gl.depthFunc(gl.EQUAL);
    blend(gl.ONE, gl.ONE);
    if (mirror.shines) drawRuns(mirror.runs, shown.besideMirror);
    blend();
    gl.depthFunc(gl.LEQUAL);
  }

  /// A surface that blurs what it mirrors.
  function drawRough(world, child, level, place) {
    const mirrored = drawAside(child, place);
    useWorld(world);
    scissor(world.rectangle, targets[place]);
    stencil(level, gl.KEEP);
    gl.depthFunc(gl.EQUAL);
    bind(3, mirrored);
    gl.generateMipmap(gl.TEXTURE_2D);
    setFilters(gl, gl.LINEAR_MIPMAP_LINEAR, gl.LINEAR);
    gl.uniformMatrix4fv(at.asideProjection, false, viewProjection(child.camera));
    gl.uniform3fv(at.asideEye, child.camera.eye);
    drawRuns(child.mirror.runs, shown.rough);
    bind(3, mirrored); // runs bind textures of their own
    setFilters(gl, gl.NEAREST, gl.NEAREST);
    bind(3, black);
    gl.depthFunc(gl.LEQUAL);
  }

  /// Returns the texture with what a pane, or a rough surface, mirrors.
  function drawAside(child, place) {
    const target = bindTarget(place + 1);
    scissor(child.rectangle, target);
    blend();
    gl.clear(gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    stencil(0, gl.KEEP);
    drawSky(child.camera, place + 1);
    drawWorld(child, 0, place + 1);
    scissor(child.rectangle, target);
    takeMean(target);
    bindTarget(place);
    return target.texture;
  }
  function drawPanes(world, level, place) {
    const eye = world.camera.eye, distance = run => lengthOf(minus(run.middle, eye));
    const faces = run => !run.plane || dot(run.plane.normal, eye) > run.plane.offset;
    for (const run of room.panes.filter(r => faces(r) && mayShow(world, r.parts[0])).sort((a, b) => distance(b) - distance(a))) {
      const child = world.children.find(c => c.mirror.number === run.mirror);
      const mirrored = child ? drawAside(child, place) : black;
      useWorld(world);
      scissor(world.rectangle, targets[place]);
      stencil(level, gl.KEEP);
      gl.depthMask(false);
      blend(gl.ZERO, gl.SRC_COLOR);
      drawRuns([run], shown.passed);
      blend(gl.ONE, gl.ONE);
      bind(3, mirrored);
      drawRuns([run], shown.pane);
      bind(3, black);
      blend();
      gl.depthMask(true);
    }
  }

  function drawWorld(world, level, place) {
    useWorld(world);
    scissor(world.rectangle, targets[place]);
    blend();
    stencil(level, gl.KEEP);
    gl.depthFunc(gl.LEQUAL);
    gl.depthMask(true);
    drawOpaque(world);
    for (const child of world.children)
      if (child.mirror.rough && !options.falseColours) drawRough(world, child, level, place);
      else if (child.mirror.kind !== "pane") drawMirror(world, child, level, place);
    if (!options.falseColours) drawPanes(world, level, place);
  }

  function bindTarget(place) {
    const { width, height } = options;
    if (targets[place] && (targets[place].width !== width || targets[place].height !== height)) {
      freeTarget(gl, targets[place]);
      targets[place] = null;
    }
    targets[place] = targets[place] || makeTarget(gl, width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, targets[place].drawn);
    gl.useProgram(roomProgram.program);
    gl.uniform1i(at.aside, place > 0 ? 1 : 0);
    return targets[place];
  }
  function takeMean({ drawn, mean, width, height }) {
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, drawn);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, mean);
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
  }

  function setConstants() {
    const exposed = 2 ** options.exposure;
    gl.useProgram(skyProgram.program);
    gl.uniform3fv(skyProgram.at.background, room.lamps.of(data.skyLamp).map((s, k) => s * data.background[k]));
    gl.uniform1i(skyProgram.at.hasSky, textures.sky ? 1 : 0);
    gl.uniform1i(skyProgram.at.falseColours, options.falseColours);
    gl.uniform1f(skyProgram.at.exposed, exposed);
    gl.uniform1f(skyProgram.at.skyScale, data.sky ? data.sky.brightness : 1);
    gl.uniform1i(skyProgram.at.sky, 6);
    gl.uniform2fv(skyProgram.at.turned, data.sky ? data.sky.turned : [1, 0]);
    bind(6, textures.sky ? textures.sky.texture : black);
    gl.useProgram(roomProgram.program);
    ["looks", "colourTexture", "emissionTexture", "behindPane", "falseScale", "probe"].forEach((name, unit) =>
      gl.uniform1i(at[name], unit));
    bind(0, looks);
    bind(3, black);
    bind(4, scale);
    bind(5, blackCube, gl.TEXTURE_CUBE_MAP);
    gl.uniform1i(at.falseColours, options.falseColours);
    gl.uniform1i(at.facets, options.facets || 8);
    gl.uniform1f(at.lightScale, room.instead ? 1 : data.light);
    gl.uniform1f(at.exposed, exposed);
    gl.uniform1f(at.topIrradiance, room.instead ? room.instead.top : data.top);
    gl.uniform3fv(at.ambient, room.ambient);
    gl.uniform3fv(at.lowest, room.low);
    gl.uniform3fv(at.highest, room.high);
    gl.uniform2f(at.pictureSize, options.width, options.height);
  }

  function showOnScreen(block) {
    scissor([0, 0, 1, 1], targets[0]);
    takeMean(targets[0]);
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
    gl.uniform1i(screenProgram.at.transform,
      options.falseColours ? 0 : ["srgb", "neutral", "agx"].indexOf(data.transform));
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
    gl.vertexAttribI4ui(5, 0, 0, 0, 0); // what the shader wants of a line besides is a whole number
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
  function begin(target) {
    gl.viewport(0, 0, options.width, options.height);
    for (const test of [gl.DEPTH_TEST, gl.STENCIL_TEST, gl.SCISSOR_TEST, gl.CULL_FACE]) gl.enable(test);
    setConstants();
    scissor([0, 0, 1, 1], target);
    gl.clear(gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    stencil(0, gl.KEEP);
  }
  /// The room alone, for a probe.
  function paintFace(camera, without) {
    const place = 4;
    options = { width: probeSize, height: probeSize, exposure: data.cameras[0].exposure, falseColours: false, lines: false, without };
    const target = bindTarget(place);
    begin(target);
    drawSky(camera, place);
    drawWorld(rootWorld(camera), 0, place);
    scissor([0, 0, 1, 1], target);
    takeMean(target);
    return target.mean;
  }
  /// What a body sees changes with the lamps alone: asked for when a first picture is there. Returns whether there was one left.
  /// Each is tried once: a graphics card that has dropped the page gives no texture, ever.
  function fillNextProbe() {
    relight();
    const probe = room.probes.find(p => p.state !== room.lamps.state);
    if (probe) fillProbe(gl, room, probe, paintFace);
    return probe !== undefined;
  }

  /// `wanted`: width and height in pixels of the screen, block, exposure, lines, falseColours, mirrors,
  /// and how many worlds at most. Returns figures of the frame.
  function paint(camera, wanted) {
    options = { ...wanted, width: wanted.width * wanted.block, height: wanted.height * wanted.block, falseColours: wanted.falseColours || Boolean(room.instead) };
    draws = 0;
    const follows = (mirror, world) => options.mirrors && (mirror.kind === "mirror" || !options.falseColours)
      && (!(mirror.kind === "pane" || mirror.rough) || world.asides < 2);
    const worlds = visibleWorlds(room, camera, options.most, follows);
    relight();
    begin(bindTarget(0));
    drawSky(camera, 0);
    drawWorld(worlds.root, 0, 0);
    showOnScreen(options.block);
    return { worlds: worlds.count, cut: worlds.cut, depth: worlds.depth, draws };
  }
  /// What the graphics card keeps for this room; programs stay for the next.
  function free() {
    targets.forEach(target => target && freeTarget(gl, target));
    buffers.forEach(buffer => gl.deleteBuffer(buffer));
    if (lines) gl.deleteBuffer(lines.ends);
    if (instead) freeInstead();
    [...textures, ...(textures.sky ? [textures.sky.texture] : []), ...probes.map(probe => probe.texture || null), looks, scale, black, blackCube]
      .forEach(texture => gl.deleteTexture(texture));
    [array, nothing].forEach(made => gl.deleteVertexArray(made));
  }
  return { paint, fillNextProbe, free };
}
