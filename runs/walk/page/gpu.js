// What WebGL 2 is asked for: programs, tables as vertex arrays, textures, and pictures to draw into.
"use strict";

/// Of a pixel.
const maxSamples = 4;

/// Throws a sentence for the user where the browser cannot do it.
function openGpu(canvas) {
  const gl = canvas.getContext("webgl2", { alpha: false, antialias: false, depth: false, stencil: false });
  if (!gl) throw new Error("This page needs WebGL 2, which this browser does not offer or has turned off.");
  if (!gl.getExtension("EXT_color_buffer_float") && !gl.getExtension("EXT_color_buffer_half_float"))
    throw new Error("This page needs pictures of 16-bit floats, which this browser's WebGL 2 cannot draw into.");
  gl.anisotropy = gl.getExtension("EXT_texture_filter_anisotropic");
  return gl;
}

/// Compiled once: it takes as long as drawing many frames where software draws. All are begun before one is asked for.
function beginPrograms(gl, texts) {
  const known = gl.programs = gl.programs || new Map();
  for (const text of texts) if (!known.has(text.join(""))) known.set(text.join(""), beginProgram(gl, text));
  gl.flush();
  return texts.map(text => known.get(text.join("")));
}
function makePrograms(gl, texts) {
  const programs = beginPrograms(gl, texts);
  for (const made of programs) made.at = made.at || placesOfUniforms(gl, made);
  return programs;
}
function beginProgram(gl, [vertex, fragment]) {
  const program = gl.createProgram(), shaders = [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]].map(([kind, source]) => {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    return shader;
  });
  gl.linkProgram(program);
  return { program, shaders, at: null };
}
function placesOfUniforms(gl, { program, shaders }) {
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error("A shader of this page was refused: " + [...shaders.map(shader => gl.getShaderInfoLog(shader)), gl.getProgramInfoLog(program)].join(" "));
  const at = {};
  for (let k = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); k-- > 0;) {
    const { name } = gl.getActiveUniform(program, k);
    at[name] = gl.getUniformLocation(program, name);
  }
  return at;
}

function makeBuffer(gl, target, values) {
  const buffer = gl.createBuffer();
  gl.bindBuffer(target, buffer);
  gl.bufferData(target, values, gl.STATIC_DRAW);
  return buffer;
}

/// Numbers by vertex that batches have, from 1 in the page's order, 0 of none: mirror, body, and the units of both textures.
function numbersOf({ data, tables, probes, mirrors }) {
  const numbers = new Uint16Array(4 * tables.look.length), isMirror = new Set(mirrors.map(mirror => mirror.number));
  for (const batch of data.batches) {
    const [, , , mirror, node, first, count] = batch, { units } = batch.group;
    const ofMirror = isMirror.has(mirror) ? mirror + 1 : 0, ofBody = probes.findIndex(probe => probe.node === node) + 1;
    const [ofColour, ofEmission] = [units.indexOf(batch[1]) + 1, units.indexOf(batch[2]) + 1];
    for (let k = 3 * first; k < 3 * (first + count); ++k) {
      const row = 4 * tables.triangles[k];
      numbers[row] = ofMirror;
      numbers[row + 1] = ofBody;
      numbers[row + 2] = ofColour;
      numbers[row + 3] = ofEmission;
    }
  }
  return numbers;
}

/// A table in such a unit.
function inUnits(table, unit, length = table.length) {
  const values = new Float32Array(length);
  for (let k = 0; k < table.length; ++k) values[k] = table[k] * unit;
  return values;
}

/// By vertex, on the octahedron: those of bodies, and of black backs.
function normalsOf({ tables, backs }, places) {
  const normals = inUnits(tables.normal || [], 2 ** -14, 2 * places.sky);
  normals.set(backs.normals, 2 * places.back);
  return normals;
}

/// The vertices of the room, of its black backs, of the sky and of windows (stream.js), and the triangles of a frame.
/// A frame has at most `worlds`. Returns { array, light, stream, buffers }, light the buffer for their irradiance.
function makeRoomArrays(gl, room, worlds) {
  const { data, tables } = room, array = gl.createVertexArray(), buffers = [], places = placesBeside(room, worlds);
  gl.bindVertexArray(array);
  const add = (place, values, count, type, isShare = false) => {
    const buffer = makeBuffer(gl, gl.ARRAY_BUFFER, places.all * count * values.BYTES_PER_ELEMENT);
    gl.bufferSubData(gl.ARRAY_BUFFER, 0, values);
    buffers.push(buffer);
    gl.enableVertexAttribArray(place);
    if (place < 5) gl.vertexAttribPointer(place, count, type, isShare, 0, 0);
    else gl.vertexAttribIPointer(place, count, type, 0, 0);
    return buffer;
  };
  const points = new Float32Array(3 * places.window);
  points.set(tables.points);
  for (let k = 0, to = 3 * places.back; k < room.backs.of.length; ++k)
    for (let axis = 0, from = 3 * room.backs.of[k]; axis < 3; ++axis) points[to++] = tables.points[from++];
  points.set(cubeCorners.flatMap(x => times(x, room.size)), 3 * places.sky);
  const looks = new Uint16Array(places.all);
  looks.set(tables.look);
  looks.fill(looksBeside.back, places.back).fill(looksBeside.sky, places.sky).fill(looksBeside.window, places.window);
  const positions = add(0, points, 3, gl.FLOAT), light = add(1, new Float32Array(0), 3, gl.FLOAT);
  add(2, normalsOf(room, places), 2, gl.FLOAT);
  if (tables.place) add(3, inUnits(tables.place, 2 ** -16), 4, gl.FLOAT);
  else gl.vertexAttrib4f(3, 0, 0, 0, 0);
  if (tables.colour) add(4, Uint16Array.from(tables.colour), 4, gl.UNSIGNED_SHORT, true);
  add(5, looks, 1, gl.UNSIGNED_SHORT);
  add(6, numbersOf(room), 4, gl.UNSIGNED_SHORT);
  const stream = makeStream(gl, room, places, positions);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, stream.drawn);
  gl.bindVertexArray(null);
  return { array, light, stream, buffers };
}

function setValues(gl, buffer, values) {
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  gl.bufferSubData(gl.ARRAY_BUFFER, 0, values);
}

/// The looks of materials, six texels in a row to each.
function setLooks(gl, texture, looks) {
  const numbers = new Float32Array(24 * looks.length);
  looks.forEach((look, k) => numbers.set([...look.albedo, look.alpha, ...look.rest, look.cutoff, ...look.emission,
    look.kind, ...look.f0, look.f90, ...look.tint, look.ior, ...look.reflectance, look.roughness], 24 * k));
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, 6, looks.length, 0, gl.RGBA, gl.FLOAT, numbers);
  setFilters(gl, gl.NEAREST, gl.NEAREST);
}

function setFilters(gl, smaller, larger, target = gl.TEXTURE_2D) {
  gl.texParameteri(target, gl.TEXTURE_MIN_FILTER, smaller);
  gl.texParameteri(target, gl.TEXTURE_MAG_FILTER, larger);
  gl.texParameteri(target, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  gl.texParameteri(target, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
}

/// An image of the scene, decoded from sRGB where it is looked up.
function makeTexture(gl, image, { wrap, nearest }) {
  const texture = gl.createTexture(), wraps = [gl.CLAMP_TO_EDGE, gl.REPEAT, gl.MIRRORED_REPEAT];
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, gl.RGBA, gl.UNSIGNED_BYTE, image);
  gl.generateMipmap(gl.TEXTURE_2D);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, nearest ? gl.NEAREST : gl.LINEAR);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, wraps[wrap[0]]);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, wraps[wrap[1]]);
  if (gl.anisotropy) gl.texParameterf(gl.TEXTURE_2D, gl.anisotropy.TEXTURE_MAX_ANISOTROPY_EXT, 8);
  return texture;
}

/// 256 sRGB colours in a row.
function makeScale(gl, colours) {
  const texels = new Uint8Array(4 * 256).fill(255);
  for (let k = 0; k < 256; ++k) texels.set(colours.slice(3 * k, 3 * k + 3), 4 * k);
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, texels);
  setFilters(gl, gl.LINEAR, gl.LINEAR);
  return texture;
}

async function halvesOf(base64) {
  const bytes = await inflated(bytesOf(base64));
  return halvesToNumbers(new Uint16Array(bytes.buffer, 0, bytes.length / 2));
}

/// Its texture is made by setSky.
async function makeSky(gl, sky) {
  sky.shown = await halvesOf(sky.texels);
  sky.rest = sky.withoutSuns ? await halvesOf(sky.withoutSuns) : sky.shown;
  sky.texture = gl.createTexture();
  return sky;
}
/// L = s_sky L_rest + s_sun (L - L_rest). Halves hold what is not brighter than the file's sky, the scale
/// the rest.
function setSky(gl, sky, factor, ofSun) {
  const most = Math.max(1e-12, ...factor, ...(sky.withoutSuns ? ofSun : [])), [a, b] = [times(factor, 1 / most), times(ofSun, 1 / most)];
  const texels = sky.shown.map((x, k) => a[k % 3] * sky.rest[k] + b[k % 3] * (x - sky.rest[k]));
  sky.brightness = sky.scale * most;
  gl.bindTexture(gl.TEXTURE_2D, sky.texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB16F, sky.width, sky.height, 0, gl.RGB, gl.FLOAT, texels);
  setFilters(gl, gl.LINEAR, gl.LINEAR);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.REPEAT);
}

/// A picture of linear light with depth and stencil, `asked` samples to a pixel, and the texture that
/// their means go to.
function makeTarget(gl, width, height, asked) {
  const samples = asked > 1 ? Math.min(asked, gl.getInternalformatParameter(gl.RENDERBUFFER, gl.RGBA16F, gl.SAMPLES)[0] || 0) : 0;
  const target = { width, height, asked, drawn: gl.createFramebuffer(), mean: gl.createFramebuffer(), texture: gl.createTexture(),
    parts: [gl.createRenderbuffer(), gl.createRenderbuffer()], isChecked: false };
  gl.bindTexture(gl.TEXTURE_2D, target.texture);
  gl.texStorage2D(gl.TEXTURE_2D, Math.floor(Math.log2(Math.max(width, height))) + 1, gl.RGBA16F, width, height);
  setFilters(gl, gl.NEAREST, gl.NEAREST);
  gl.bindFramebuffer(gl.FRAMEBUFFER, target.mean);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target.texture, 0);
  gl.bindFramebuffer(gl.FRAMEBUFFER, target.drawn);
  [[gl.RGBA16F, gl.COLOR_ATTACHMENT0], [gl.DEPTH24_STENCIL8, gl.DEPTH_STENCIL_ATTACHMENT]].forEach(([format, place], k) => {
    gl.bindRenderbuffer(gl.RENDERBUFFER, target.parts[k]);
    gl.renderbufferStorageMultisample(gl.RENDERBUFFER, samples, format, width, height);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, target.parts[k]);
  });
  return target;
}
/// The answer waits for all that has been asked of the graphics card: it is asked for after a frame.
function checkTarget(gl, target) {
  gl.bindFramebuffer(gl.FRAMEBUFFER, target.drawn);
  target.isChecked = gl.checkFramebufferStatus(gl.FRAMEBUFFER) === gl.FRAMEBUFFER_COMPLETE;
  if (!target.isChecked && !gl.isContextLost())
    throw new Error("This page needs a stencil beside 16-bit floats, which this browser's WebGL 2 does not give.");
}

function freeTarget(gl, target) {
  gl.deleteFramebuffer(target.drawn);
  gl.deleteFramebuffer(target.mean);
  gl.deleteTexture(target.texture);
  target.parts.forEach(part => gl.deleteRenderbuffer(part));
}
