// How the room is shaded. L = L_e + rho H / pi, times 2^exposure (raytrace/field_shading.h); coats
// and panes by R(cos) and T(cos) as scenes/materials/lobes.h and glass.h have them.
"use strict";

/// Looks that no material has: windows of worlds on the screen, the sky around the eye, black backs.
const looksBeside = { window: 65535, sky: 65534, back: 65533 };
/// Mirrors beyond that many are not followed.
const maxMirrors = 2048;

/// Only what the room has is compiled and carried to its pixels: where the processor draws, compiling takes longer than a frame.
const onlyWhatItHas = ({ bodies, rough, panes, colours, sheets }) => `#version 300 es
#define BODIES ${Number(bodies)}
#define ROUGH ${Number(rough)}
#define PANES ${Number(panes)}
#define COLOURS ${Number(colours)}
#define SHEETS ${Number(sheets.colours.length + sheets.emissions.length > 0)}
`;

const roomVertex = needs => `${onlyWhatItHas(needs)}
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 irradiance;
layout(location = 2) in vec2 octahedral;
layout(location = 3) in vec4 texturePlace;
layout(location = 4) in vec4 vertexColour;
layout(location = 5) in uint lookNumber;
layout(location = 6) in uvec4 numbers; // of its mirror, its body, and the units of its two textures, from 1
uniform mat4 viewProjection;
uniform vec3 eye, pixelRight, pixelUp; // the sides of a pixel at distance one
uniform float depthFactor; // depth is a constant less this by the distance along the view
uniform uvec4 followed[${maxMirrors / 128}]; // a bit for each mirror with a picture of what it shows here
invariant gl_Position;
out vec3 place, light;
flat out int look, isFollowed;
#if BODIES
out vec3 normal;
flat out int body;
#endif
#if COLOURS
out vec4 colour;
#endif
#if SHEETS
out vec4 onTextures;
flat out ivec2 units;
#endif
void main() {
  place = position;
  light = irradiance; // of all lamps, each times its dimmer (lamps.js)
  vec3 n = vec3(octahedral, 1.0 - abs(octahedral.x) - abs(octahedral.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
  n = normalize(n);
  look = int(lookNumber);
#if BODIES
  normal = n;
  body = int(numbers.y) - 1;
#endif
#if COLOURS
  colour = vertexColour;
#endif
#if SHEETS
  onTextures = texturePlace;
  units = ivec2(numbers.zw) - 1;
#endif
  uint mirror = numbers.x - 1u;
  isFollowed = numbers.x > 0u && numbers.x <= ${maxMirrors}u && (followed[mirror >> 7u][(mirror >> 5u) & 3u] >> (mirror & 31u) & 1u) != 0u ? 1 : 0;
  if (look == ${looksBeside.sky}) place += eye;
  gl_Position = viewProjection * vec4(place, 1.0);
  if (look == ${looksBeside.sky}) gl_Position.z = gl_Position.w; // behind all else, and never before the near plane
  // Behind a front in the same place, by as much as their depth changes within two pixels: elements that share an edge may
  // have vertices at different places of it.
  if (look == ${looksBeside.back}) {
    float slope = max(abs(dot(n, pixelRight)), abs(dot(n, pixelUp))) * depthFactor / max(abs(dot(n, place - eye)), 1e-12);
    gl_Position.z = min(gl_Position.z + (2e-6 + 2.0 * slope) * gl_Position.w, gl_Position.w);
  }
  if (look == ${looksBeside.window}) gl_Position = vec4(position.xy, 1.0, 1.0);
}`;

/// What a draw of the room writes.
const shown = { own: 0, passed: 1, pane: 2, lines: 3, rough: 4 };
/// And what its alpha is: 1 where surfaces are seen straight and 0 by way of mirrors, the share of a pixel that windows
/// cover, or the distance from the eye.
const alphas = { straight: 0, covered: 1, distance: 2 };
const kinds = { plain: 0, unlit: 1, coat: 2, mirror: 3, pane: 4, covering: 5, unlitCovering: 6, curved: 7, solid: 8, glossy: 9 };

/// What is beyond the room along a unit vector.
const skyLight = hasSky => hasSky ? `
uniform sampler2D sky;
uniform vec2 turned;
uniform float skyScale;
vec3 skyLight(vec3 d) {
  d.xz = vec2(turned.x * d.x - turned.y * d.z, turned.y * d.x + turned.x * d.z);
  return textureLod(sky, vec2(0.5 + atan(d.z, d.x) / 6.28318530718, acos(clamp(d.y, -1.0, 1.0)) / 3.14159265359), 0.0).rgb * skyScale;
}` : `
uniform vec3 background;
vec3 skyLight(vec3 d) { return background; }`;

/// The texel of one of the textures, white of none. All corners of a triangle have the same one. Software that draws looks
/// all of them up, so each is asked for what some surface has it for: colour, emission, holes.
const sheetAt = ({ colours, emissions, holes }) => {
  const units = [...colours, ...emissions, ...holes], lookUp = (name, of, how) => `
vec4 ${name}(int unit, vec2 at) {
  vec4 texel = vec4(1.0);
${of.map(k => `  if (unit == ${k}) texel = ${how(`sheets[${k}]`)};`).join("\n")}
  return texel;
}`;
  return (units.length ? `uniform sampler2D sheets[${1 + Math.max(...units)}];` : "")
    + lookUp("colourAt", colours, sheet => `texture(${sheet}, at)`) + lookUp("emissionAt", emissions, sheet => `texture(${sheet}, at)`)
    + lookUp("sharpAt", holes, sheet => `textureLod(${sheet}, at, 0.0)`);
};

/// What the middles of bodies see, as six squares of a cube to each (probes.js): the picture along d, as means of 2^level
/// texels. Beyond the middles of a square's outer texels it is what they are.
const bodySees = `
uniform sampler2DArray probes;
uniform vec4 bodies[${2 * maxProbes}]; // place and thickness, factor and whether it has a picture
#define hasBody (body >= 0 && bodies[2 * max(body, 0) + 1].w > 0.0)
vec3 bodyPlace() { return bodies[2 * max(body, 0)].xyz; }
vec3 bodyScale() { return bodies[2 * max(body, 0) + 1].rgb; }
vec4 bodySees(vec3 d, float level) {
  vec3 a = abs(d);
  bool isX = a.x >= a.y && a.x >= a.z, isY = !isX && a.y >= a.z;
  float along = isX ? d.x : isY ? d.y : d.z, side = along < 0.0 ? -1.0 : 1.0;
  vec2 at = (isX ? vec2(-side * d.z, -d.y) : isY ? vec2(d.x, side * d.z) : vec2(side * d.x, -d.y)) / max(abs(along), 1e-12);
  float face = (isX ? 0.0 : isY ? 2.0 : 4.0) + (side < 0.0 ? 1.0 : 0.0), width = max(1.0, float(${probeSize}) * exp2(-level));
  return textureLod(probes, vec3(0.5 + 0.5 * clamp(at, 1.0 / width - 1.0, 1.0 - 1.0 / width), 6.0 * float(max(body, 0)) + face), level);
}`;

const roomFragment = needs => `${onlyWhatItHas(needs)}
precision highp float;
precision highp int;
precision highp sampler2DArray;
in vec3 place, light;
flat in int look, isFollowed;
#if COLOURS
in vec4 colour;
#else
const vec4 colour = vec4(1.0);
#endif
#if SHEETS
in vec4 onTextures;
flat in ivec2 units;
#else
const vec4 onTextures = vec4(0.0);
const ivec2 units = ivec2(-1);
#endif
uniform int shows, tells, facets;
uniform float between; // of its way from the middle, what a facet's ray stands for
uniform mat4 asideProjection;
uniform vec4 lineColour;
uniform bool falseColours;
uniform vec3 eye, asideEye, ambient, lowest, highest;
uniform vec4 clip; // the room is where dot(clip.xyz, x) > clip.w
uniform float lightScale, exposed, topIrradiance;
uniform vec2 pictureSize;
uniform sampler2D looks, mirrored, falseScale;
out vec4 result;
const float pi = 3.14159265358979;
#define NUMBERS(k) texelFetch(looks, ivec2(k, look), 0)
${skyLight(needs.sky)}
${sheetAt(needs.sheets)}
#if BODIES
in vec3 normal;
flat in int body;
${bodySees}
#else
const bool hasBody = false;
vec3 bodyPlace() { return vec3(0.0); }
vec4 bodySees(vec3 d, float level) { return vec4(0.0); }
vec3 bodyScale() { return vec3(1.0); }
#endif

#if PANES || BODIES
float fresnel(float ior, float c) {
  if (ior <= 0.0) return 1.0;
  float sine2 = (1.0 - c * c) / (ior * ior), behind = sqrt(max(0.0, 1.0 - sine2));
  if (sine2 >= 1.0) return 1.0;
  float s = (c - ior * behind) / (c + ior * behind), p = (ior * c - behind) / (ior * c + behind);
  return 0.5 * (s * s + p * p);
}
/// Of a pane with both faces.
void glassShares(float c, out vec3 reflectedPart, out vec3 passedPart) {
  vec4 f = NUMBERS(3), tint = NUMBERS(4);
  float straight = fresnel(tint.w, 1.0);
  float rise = straight >= 1.0 ? 0.0 : clamp((fresnel(tint.w, c) - straight) / (1.0 - straight), 0.0, 1.0);
  vec3 face = mix(f.rgb, vec3(f.w), rise), loop = face * tint.rgb;
  passedPart = (1.0 - face) * (1.0 - face) * tint.rgb / max(1.0 - loop * loop, 1e-6);
  reflectedPart = face + loop * passedPart;
}
#endif
vec3 coatReflectance(float c) {
  vec4 f = NUMBERS(3);
  return min(f.rgb + (f.w - f.rgb) * pow(1.0 - c, 5.0), 1.0);
}
#if BODIES || ROUGH
/// Where the picture aside shows a point, and whether it does.
vec2 onAside(vec3 x, out bool isSeen) {
  vec4 seen = asideProjection * vec4(x, 1.0);
  vec2 on = 0.5 + 0.5 * seen.xy / max(seen.w, 1e-6);
  isSeen = seen.w > 0.0 && on == clamp(on, 0.0, 1.0);
  return clamp(on, 0.002, 0.998);
}
vec2 onAside(vec3 x) { bool isSeen; return onAside(x, isSeen); }
/// How far from here what that picture shows towards a point is.
float farOnAside(vec3 x) {
  float far = textureLod(mirrored, onAside(x), 0.0).a;
  return min(distance(asideEye + far * normalize(x - asideEye), place), 1e4);
}
/// The frame of facets by GGX about n. Sixteen pixels, and the four of each quarter of them, have facets between one
/// another's, so that their mean is that of as many times more (the order of pixels: Bayer 1973).
struct Facets { vec3 n, t, b; float alpha, o, first; };
Facets facetsAbout(vec3 n, vec3 towards, float roughness) {
  vec3 t = normalize(cross(abs(n.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), n));
  ivec2 at = ivec2(gl_FragCoord.xy);
  int other = at.x ^ at.y, order = 8 * (other & 1) + 4 * (at.y & 1) + (other & 2) + ((at.y >> 1) & 1);
  return Facets(n, t, cross(n, t), roughness * roughness, max(1e-3, -dot(towards, n)), (float(order) + 0.5) / 16.0);
}
/// Where the ray of facet k goes, its cosine o.h, and its weight G2 (o.h) / (n.h) (Walter et al. 2007), o.n times its
/// share of the albedo.
vec3 facetRay(Facets f, vec3 towards, int k, out float c, out float weight) {
  // A lattice of one step for all: 9.381966 is 16 times it, so that one pixel's facets are golden angles apart.
  // Steep facets are rare, but look at lamps: of 1 - u = s^2, s even, there are more of them, each worth 2 s.
  float s = 1.0 - (float(k) + f.first) / float(facets), phi = 6.28318531 * fract(9.38196601 * f.first + 0.381966011 * float(k));
  float slope = f.alpha * sqrt(1.0 - s * s) / s;
  vec3 h = normalize(f.n + slope * (cos(phi) * f.t + sin(phi) * f.b));
  c = clamp(-dot(towards, h), 0.0, 1.0);
  vec3 r = towards + 2.0 * c * h;
  float up = dot(r, f.n), square = f.alpha * f.alpha;
  weight = up <= 0.0 ? 0.0 : 4.0 * s * up * f.o * c / (dot(f.n, h)
    * (up * sqrt(mix(f.o * f.o, 1.0, square)) + f.o * sqrt(mix(up * up, 1.0, square))));
  return r;
}
/// How far from here what the middle of a body sees towards a point is.
float farOfBody(vec3 x) {
  vec3 to = x - bodyPlace();
  return min(distance(bodyPlace() + bodySees(to, 0.0).a * normalize(to), place), 1e4);
}
/// What it sees of what a ray from here meets, first taken for so far away, then for as far as what is seen there. The
/// ray stands for what is within an angle, which that middle sees as large as it is nearer.
vec3 metByBody(vec3 r, float far, float angle) {
  vec3 met = place + farOfBody(place + far * r) * r;
  met = place + farOfBody(met) * r;
  vec3 to = met - bodyPlace();
  const float texels = ${(2 / Math.PI * probeSize).toFixed(1)}; // of a face to a radian
  return bodySees(to, log2(max(1.0, texels * angle * distance(met, place) / max(length(to), 1e-6)))).rgb * bodyScale();
}
/// What a rough surface mirrors, times R(o.h): each facet shows the picture aside where its ray ends, first
/// taken for as far away as what the mirror shows straight, then as what is there. Means stand for what
/// is between rays (Williams 1983). Beyond the picture's edges the body's middle tells.
vec3 blurred(vec3 n, vec3 towards, float roughness, bool coat, vec3 metal) {
  vec3 straight = reflect(towards, n), sum = vec3(0.0);
  float ends = farOnAside(place + length(highest - lowest) * straight), weights = 0.0, c, weight;
  vec2 middle = onAside(place + ends * straight);
  Facets all = facetsAbout(n, towards, roughness);
  for (int k = 0; k < facets; ++k) {
    vec3 r = facetRay(all, towards, k, c, weight);
    if (weight <= 0.0) continue;
    vec3 met = place + ends * r;
    float level = log2(max(1.0, between * length((onAside(met) - middle) * pictureSize)));
    met = place + farOnAside(met) * r;
    bool isSeen;
    vec3 shown = textureLod(mirrored, onAside(met, isSeen), level).rgb;
    if (!isSeen && hasBody) shown = metByBody(r, ends, min(between * distance(r, straight), dot(r, n)));
    sum += weight * (coat ? coatReflectance(c) : metal) * shown;
    weights += weight;
  }
  return sum / max(weights, 1e-6);
}
/// The mean of what facets show of that. Their albedo is the share of light that they throw back at once; the rest they
/// spread.
vec3 seenByFacets(vec3 n, vec3 towards, float roughness, out float albedo) {
  vec3 straight = reflect(towards, n), sum = vec3(0.0);
  float far = farOfBody(place + length(highest - lowest) * straight), weights = 0.0, c, weight;
  Facets all = facetsAbout(n, towards, roughness);
  for (int k = 0; k < facets; ++k) {
    vec3 r = facetRay(all, towards, k, c, weight);
    if (weight <= 0.0) continue;
    sum += weight * metByBody(r, far, min(between * distance(r, straight), dot(r, n)));
    weights += weight;
  }
  albedo = min(1.0, weights / (all.o * float(facets)));
  return sum / max(weights, 1e-6);
}
#endif
#if BODIES
/// What the middle of a body sees along a direction, taken for what is seen from here: as far away as
/// the walls of the box around the room.
vec3 seenByBody(vec3 r, float roughness) {
  vec3 to = (mix(lowest, highest, step(0.0, r)) - place) / (r + 1e-9);
  vec3 met = place + r * max(0.0, min(to.x, min(to.y, to.z)));
  return hasBody ? bodySees(met - bodyPlace(), 6.0 * roughness).rgb * bodyScale() : ambient * exposed;
}
vec3 seenBySolid(vec3 n, vec3 towards) {
  vec4 f = NUMBERS(3), tint = NUMBERS(4);
  float c = min(1.0, abs(dot(n, towards))), straight = fresnel(tint.w, 1.0);
  vec3 face = mix(f.rgb, vec3(f.w), clamp((fresnel(tint.w, c) - straight) / (1.0 - straight + 1e-6), 0.0, 1.0));
  vec3 through = refract(towards, n, 1.0 / max(tint.w, 1.0));
  return face * seenByBody(reflect(towards, n), 0.0) + (1.0 - face) * tint.rgb * exp(NUMBERS(5).rgb * bodies[2 * max(body, 0)].w) * seenByBody(through, 0.0);
}

#endif

void main() {
  if (look == ${looksBeside.window}) { result = vec4(0.0); return; }
  if (!gl_FrontFacing) discard; // of the window alone backs count: they mark where the rest is drawn
  if (look == ${looksBeside.sky}) {
    result = vec4(falseColours ? vec3(0.0) : min(skyLight(normalize(place - eye)) * exposed, vec3(6e4)), tells == ${alphas.distance} ? 6e4 : 1.0);
    return;
  }
  if (dot(clip.xyz, place) <= clip.w) discard;
  if (shows == ${shown.lines}) { result = lineColour; return; }
  if (look == ${looksBeside.back}) { result = vec4(0.0, 0.0, 0.0, tells == ${alphas.distance} ? min(distance(place, eye), 6e4) : 1.0); return; }
  vec4 first = NUMBERS(0), second = NUMBERS(1), third = NUMBERS(2);
  int kind = int(third.w);
  vec4 texel = colourAt(units.x, onTextures.xy);
  float alpha = first.w * colour.a * texel.a;
  if (second.w >= 0.0 && first.w * colour.a * sharpAt(units.x, onTextures.xy).a < second.w) discard;
  // The picture of the mirror's world is the other way round.
  vec4 seen = isFollowed == 0 ? vec4(0.0) : texelFetch(mirrored, ivec2(int(pictureSize.x) - 1 - int(gl_FragCoord.x), int(gl_FragCoord.y)), 0);
  seen.rgb /= max(seen.a, 0.01); // the mean of what windows cover of the pixel
  vec3 towards = normalize(place - eye), face = normalize(cross(dFdx(place), dFdy(place)));
  float c = min(1.0, abs(dot(face, towards)));
  vec3 tint = colour.rgb * texel.rgb, rho = first.rgb * tint + second.rgb;
  if (kind != ${kinds.covering} && kind != ${kinds.unlitCovering}) alpha = 1.0;
  if (falseColours) {
    float h = dot(light, vec3(0.2126, 0.7152, 0.0722)) * lightScale / topIrradiance;
    vec3 code = texture(falseScale, vec2((255.0 * clamp(h, 0.0, 1.0) + 0.5) / 256.0, 0.5)).rgb;
    bool lit = kind != ${kinds.mirror} && kind != ${kinds.curved} && kind != ${kinds.solid};
    result = vec4(lit ? code : seen.rgb, tells == ${alphas.straight} ? 0.0 : 1.0);
    return;
  }
  vec3 radiance = third.rgb * emissionAt(units.y, onTextures.zw).rgb;
  vec3 field = light * (lightScale / pi);
  vec3 weight = NUMBERS(5).rgb * tint, passedPart = vec3(1.0 - alpha);
  if (kind == ${kinds.coat}) weight = coatReflectance(c);
#if PANES
  if (kind == ${kinds.pane}) glassShares(c, weight, passedPart);
#endif
  if (shows == ${shown.passed}) { result = vec4(passedPart, 1.0); return; }
  if (kind == ${kinds.unlit} || kind == ${kinds.unlitCovering}) radiance = first.rgb * tint;
  else if (kind == ${kinds.coat}) radiance += rho * (1.0 - max(weight.r, max(weight.g, weight.b))) * field;
  else radiance += rho * field;
  radiance *= alpha * exposed;
#if BODIES
  if (kind == ${kinds.curved})
    radiance += weight * seenByBody(reflect(towards, normalize(normal)), NUMBERS(5).w);
  if (kind == ${kinds.solid}) radiance += seenBySolid(normalize(normal), towards);
#endif
#if ROUGH
  if (shows == ${shown.rough})
    radiance += blurred(dot(face, towards) > 0.0 ? -face : face, towards, NUMBERS(5).w, kind == ${kinds.coat}, weight);
#endif
  if (isFollowed != 0 && shows != ${shown.rough}) radiance += weight * seen.rgb;
  else if (shows == ${shown.own} && kind == ${kinds.coat}) radiance += weight * field * exposed;
#if BODIES
  if (kind == ${kinds.glossy} && hasBody) {
    // The look has what is spread, and their albedo, for light from most sides.
    float albedo;
    vec4 most = NUMBERS(3);
    vec3 shown = seenByFacets(dot(normal, towards) > 0.0 ? -normalize(normal) : normalize(normal), towards, NUMBERS(5).w, albedo);
    radiance += weight * (albedo / most.w) * shown + most.rgb * tint * ((1.0 - albedo) / max(1.0 - most.w, 1e-3) - 1.0) * field * exposed;
  } else if (kind == ${kinds.glossy}) radiance += weight * field * exposed;
#endif
  bool isMirrored = isFollowed != 0 || shows == ${shown.rough};
  float told = tells == ${alphas.distance} ? distance(place, eye) : tells == ${alphas.straight} && isMirrored ? 0.0 : 1.0;
  result = min(vec4(radiance, shows == ${shown.pane} ? passedPart.g : told), vec4(6e4));
}`;
