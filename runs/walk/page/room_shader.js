// How the room is shaded. L = L_e + rho H / pi, times 2^exposure (raytrace/field_shading.h); coats
// and panes by R(cos) and T(cos) as scenes/materials/lobes.h and glass.h have them.
"use strict";

const roomVertex = `#version 300 es
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 irradiance;
layout(location = 2) in vec2 octahedral;
layout(location = 3) in vec4 texturePlace;
layout(location = 4) in vec4 vertexColour;
layout(location = 5) in uint lookNumber;
uniform mat4 viewProjection;
invariant gl_Position;
out vec3 place, light, normal;
out vec4 onTextures, colour;
flat out int look;
void main() {
  place = position;
  light = irradiance; // of all lamps, each times its dimmer (lamps.js)
  vec3 n = vec3(octahedral, 1.0 - abs(octahedral.x) - abs(octahedral.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
  normal = normalize(n);
  onTextures = texturePlace;
  colour = vertexColour;
  look = int(lookNumber);
  gl_Position = viewProjection * vec4(position, 1.0);
}`;

/// What a draw of the room writes. Alpha is 1 where surfaces are seen straight, 0 by way of mirrors;
/// of what is drawn aside it is the distance from the eye.
const shown = { own: 0, black: 1, weight: 2, besideMirror: 3, passed: 4, pane: 5, lines: 6, rough: 7 };
const kinds = { plain: 0, unlit: 1, coat: 2, mirror: 3, pane: 4, covering: 5, unlitCovering: 6, curved: 7, solid: 8, glossy: 9 };

/// Only what the room has is compiled: where the processor draws, that takes longer than a frame.
const roomFragment = ({ bodies, rough, panes }) => `#version 300 es
#define BODIES ${Number(bodies)}
#define ROUGH ${Number(rough)}
#define PANES ${Number(panes)}
precision highp float;
precision highp int;
in vec3 place, light, normal;
in vec4 onTextures, colour;
flat in int look;
uniform int shows, facets;
uniform mat4 asideProjection;
uniform vec4 lineColour;
uniform bool aside, falseColours, hasColour, hasEmission, hasProbe;
uniform vec3 eye, asideEye, ambient, lowest, highest, probePlace, probeScale;
uniform vec4 clip; // the room is where dot(clip.xyz, x) > clip.w
uniform float lightScale, exposed, topIrradiance, thickness;
uniform vec2 pictureSize;
uniform sampler2D looks, colourTexture, emissionTexture, behindPane, falseScale;
uniform samplerCube probe;
out vec4 result;
const float pi = 3.14159265358979;
#define NUMBERS(k) texelFetch(looks, ivec2(k, look), 0)

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
  float far = textureLod(behindPane, onAside(x), 0.0).a;
  return min(distance(asideEye + far * normalize(x - asideEye), place), 1e4);
}
/// The frame of facets by GGX about n, turned from pixel to pixel.
struct Facets { vec3 n, t, b; float alpha, o, turn; };
Facets facetsAbout(vec3 n, vec3 towards, float roughness) {
  vec3 t = normalize(cross(abs(n.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), n));
  float turn = 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  return Facets(n, t, cross(n, t), roughness * roughness, max(1e-3, -dot(towards, n)), turn);
}
/// Where the ray of facet k goes, its cosine o.h, and its weight G2 (o.h) / (n.h) (Walter et al. 2007). Of 48
/// facets it stands for a quarter of its way from the middle (more would reach below the horizon).
vec3 facetRay(Facets f, vec3 towards, int k, out float c, out float weight, out float width) {
  float u = (float(k) + 0.5) / float(facets), phi = f.turn + 2.39996323 * float(k), slope = f.alpha * sqrt(u / (1.0 - u));
  width = 0.25 * sqrt(48.0 / float(facets));
  vec3 h = normalize(f.n + slope * (cos(phi) * f.t + sin(phi) * f.b));
  c = clamp(-dot(towards, h), 0.0, 1.0);
  vec3 r = towards + 2.0 * c * h;
  float up = dot(r, f.n), square = f.alpha * f.alpha;
  weight = up <= 0.0 ? 0.0 : 2.0 * up * f.o * c / (dot(f.n, h)
    * (up * sqrt(mix(f.o * f.o, 1.0, square)) + f.o * sqrt(mix(up * up, 1.0, square))));
  return r;
}
/// How far from here what the middle of a body sees towards a point is.
float farOfBody(vec3 x) {
  vec3 to = x - probePlace;
  return distance(probePlace + textureLod(probe, to, 0.0).a * normalize(to), place);
}
/// What a rough surface mirrors, times R(o.h): each facet shows the picture aside where its ray ends, first
/// taken for as far away as what the mirror shows straight, then as what is there. Means stand for what
/// is between rays (Williams 1983). Beyond the picture's edges the body's middle tells.
vec3 blurred(vec3 n, vec3 towards, float roughness, bool coat, vec3 metal) {
  vec3 straight = reflect(towards, n), sum = vec3(0.0);
  float ends = farOnAside(place + length(highest - lowest) * straight), weights = 0.0, c, weight, width;
  vec2 middle = onAside(place + ends * straight);
  Facets all = facetsAbout(n, towards, roughness);
  for (int k = 0; k < facets; ++k) {
    vec3 r = facetRay(all, towards, k, c, weight, width);
    if (weight <= 0.0) continue;
    vec3 met = place + ends * r;
    float level = log2(max(1.0, width * length((onAside(met) - middle) * pictureSize)));
    met = place + farOnAside(met) * r;
    bool isSeen;
    vec3 shown = textureLod(behindPane, onAside(met, isSeen), level).rgb;
    if (!isSeen && hasProbe) shown = textureLod(probe, place + farOfBody(place + ends * r) * r - probePlace, 1.0).rgb * probeScale;
    sum += weight * (coat ? coatReflectance(c) : metal) * shown;
    weights += weight;
  }
  return sum / max(weights, 1e-6);
}
/// The mean of what facets show of that.
vec3 seenByFacets(vec3 n, vec3 towards, float roughness) {
  vec3 straight = reflect(towards, n), sum = vec3(0.0);
  float far = min(1e4, farOfBody(place + length(highest - lowest) * straight)), weights = 0.0, c, weight, width;
  Facets all = facetsAbout(n, towards, roughness);
  for (int k = 0; k < facets; ++k) {
    vec3 r = facetRay(all, towards, k, c, weight, width);
    if (weight <= 0.0) continue;
    vec3 met = place + min(1e4, farOfBody(place + far * r)) * r;
    met = place + min(1e4, farOfBody(met)) * r;
    float level = log2(max(1.0, width * 81.0 * distance(r, straight))); // in texels of a face
    sum += weight * textureLod(probe, met - probePlace, level).rgb;
    weights += weight;
  }
  return sum * probeScale / max(weights, 1e-6);
}
#endif
#if BODIES
/// What the middle of a body sees along a direction, taken for what is seen from here: as far away as
/// the walls of the box around the room.
vec3 seenByBody(vec3 r, float roughness) {
  vec3 to = (mix(lowest, highest, step(0.0, r)) - place) / (r + 1e-9);
  vec3 met = place + r * max(0.0, min(to.x, min(to.y, to.z)));
  return hasProbe ? textureLod(probe, met - probePlace, 6.0 * roughness).rgb * probeScale : ambient * exposed;
}
vec3 seenBySolid(vec3 n, vec3 towards) {
  vec4 f = NUMBERS(3), tint = NUMBERS(4);
  float c = min(1.0, abs(dot(n, towards))), straight = fresnel(tint.w, 1.0);
  vec3 face = mix(f.rgb, vec3(f.w), clamp((fresnel(tint.w, c) - straight) / (1.0 - straight + 1e-6), 0.0, 1.0));
  vec3 through = refract(towards, n, 1.0 / max(tint.w, 1.0));
  return face * seenByBody(reflect(towards, n), 0.0) + (1.0 - face) * tint.rgb * exp(NUMBERS(5).rgb * thickness) * seenByBody(through, 0.0);
}

#endif

void main() {
  if (dot(clip.xyz, place) <= clip.w) discard;
  if (shows == ${shown.lines}) { result = lineColour; return; }
  vec4 first = NUMBERS(0), second = NUMBERS(1), third = NUMBERS(2);
  int kind = int(third.w);
  vec4 texel = hasColour ? texture(colourTexture, onTextures.xy) : vec4(1.0);
  float alpha = first.w * colour.a * texel.a;
  if (second.w >= 0.0) {
    float sharp = first.w * colour.a * (hasColour ? textureLod(colourTexture, onTextures.xy, 0.0).a : 1.0);
    if (sharp < second.w) discard;
  }
  if (shows == ${shown.black}) { result = vec4(0.0, 0.0, 0.0, 1.0); return; }
  vec3 towards = normalize(place - eye), face = normalize(cross(dFdx(place), dFdy(place)));
  float c = min(1.0, abs(dot(face, towards)));
  vec3 tint = colour.rgb * texel.rgb, rho = first.rgb * tint + second.rgb;
  if (kind != ${kinds.covering} && kind != ${kinds.unlitCovering}) alpha = 1.0;
  if (falseColours) {
    float h = dot(light, vec3(0.2126, 0.7152, 0.0722)) * lightScale / topIrradiance;
    vec3 code = texture(falseScale, vec2((255.0 * clamp(h, 0.0, 1.0) + 0.5) / 256.0, 0.5)).rgb;
    bool lit = shows == ${shown.own} && kind != ${kinds.mirror} && kind != ${kinds.curved} && kind != ${kinds.solid};
    result = vec4(lit ? code : vec3(shows == ${shown.weight} ? 1.0 : 0.0), 0.0);
    return;
  }
  vec3 radiance = third.rgb * (hasEmission ? texture(emissionTexture, onTextures.zw).rgb : vec3(1.0));
  vec3 field = light * (lightScale / pi);
  vec3 weight = NUMBERS(5).rgb * tint, passedPart = vec3(1.0 - alpha);
  if (kind == ${kinds.coat}) weight = coatReflectance(c);
#if PANES
  if (kind == ${kinds.pane}) glassShares(c, weight, passedPart);
#endif
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
  if (shows == ${shown.own} && kind == ${kinds.coat}) radiance += weight * field * exposed;
  if (kind == ${kinds.glossy} && !hasProbe) radiance += weight * field * exposed;
#if BODIES
  if (kind == ${kinds.glossy} && hasProbe)
    radiance += weight * seenByFacets(dot(normal, towards) > 0.0 ? -normalize(normal) : normalize(normal), towards, NUMBERS(5).w);
#endif
  if (shows == ${shown.weight}) result = vec4(weight, 1.0);
  else if (shows == ${shown.passed}) result = vec4(passedPart, 1.0);
  else result = vec4(radiance, 1.0);
  if (shows == ${shown.pane} && kind == ${kinds.pane})
    result.rgb += weight * texture(behindPane, gl_FragCoord.xy / pictureSize).rgb;
  if (aside) result.a = distance(place, eye);
  if (shows == ${shown.weight} || shows == ${shown.besideMirror} || shows == ${shown.pane} || shows == ${shown.rough} && !aside)
    result.a = 0.0;
  result = min(result, vec4(6e4));
}`;
