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
  light = irradiance; // of all lamps; of solutions that know lamps apart, the sum of each times its dimmer
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
const kinds = { plain: 0, unlit: 1, coat: 2, mirror: 3, pane: 4, covering: 5, curved: 6, solid: 7 };

const roomFragment = `#version 300 es
precision highp float;
precision highp int;
in vec3 place, light, normal;
in vec4 onTextures, colour;
flat in int look;
uniform int shows;
uniform mat4 viewProjection;
uniform bool aside, falseColours, hasColour, hasEmission, hasProbe;
uniform vec3 eye, ambient, lowest, highest, probePlace;
uniform vec4 clip; // the room is where dot(clip.xyz, x) > clip.w
uniform float lightScale, exposed, topIrradiance, probeScale, thickness;
uniform vec2 pictureSize;
uniform sampler2D looks, colourTexture, emissionTexture, behindPane, falseScale;
uniform samplerCube probe;
out vec4 result;
const float pi = 3.14159265358979;
#define NUMBERS(k) texelFetch(looks, ivec2(k, look), 0)

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
/// What a rough surface mirrors, times R(o.h): facets by GGX (Walter et al. 2007), each of which shows
/// the picture aside where its ray would end, as far away as what the mirror shows straight.
vec3 blurred(vec3 n, vec3 towards, float roughness, bool coat, vec3 metal) {
  const int count = 24;
  float alpha = roughness * roughness;
  float ends = max(0.0, texture(behindPane, gl_FragCoord.xy / pictureSize).a - distance(place, eye));
  float turn = 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  vec3 t = normalize(cross(abs(n.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), n)), b = cross(n, t), sum = vec3(0.0);
  float weights = 0.0;
  for (int k = 0; k < count; ++k) {
    float u = (float(k) + 0.5) / float(count), phi = turn + 2.39996323 * float(k);
    float slope = alpha * sqrt(u / (1.0 - u));
    vec3 h = normalize(n + slope * (cos(phi) * t + sin(phi) * b));
    float c = clamp(-dot(towards, h), 0.0, 1.0);
    vec3 r = towards + 2.0 * c * h;
    float up = dot(r, n);
    if (up <= 0.0) continue;
    vec3 met = place + ends * r;
    vec4 seen = viewProjection * vec4(met - 2.0 * dot(n, met - place) * n, 1.0);
    vec2 on = clamp(0.5 + 0.5 * seen.xy / max(seen.w, 1e-6), 0.002, 0.998);
    vec4 f = NUMBERS(3);
    vec3 reflectance = coat ? min(f.rgb + (f.w - f.rgb) * pow(1.0 - c, 5.0), 1.0) : metal;
    sum += c * reflectance * texture(behindPane, on).rgb;
    weights += c;
  }
  return sum / max(weights, 1e-6);
}
vec3 coatReflectance(float c) {
  vec4 f = NUMBERS(3);
  return min(f.rgb + (f.w - f.rgb) * pow(1.0 - c, 5.0), 1.0);
}
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

void main() {
  if (dot(clip.xyz, place) <= clip.w) discard;
  if (shows == ${shown.lines}) { result = vec4(0.0, 0.0, 0.0, 0.45); return; }
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
  if (kind != ${kinds.covering}) alpha = 1.0;
  if (falseColours) {
    float h = dot(light, vec3(0.2126, 0.7152, 0.0722)) * lightScale / topIrradiance;
    vec3 code = texture(falseScale, vec2((255.0 * clamp(h, 0.0, 1.0) + 0.5) / 256.0, 0.5)).rgb;
    bool lit = shows == ${shown.own} && kind != ${kinds.mirror} && kind < ${kinds.curved};
    result = vec4(lit ? code : vec3(shows == ${shown.weight} ? 1.0 : 0.0), 0.0);
    return;
  }
  vec3 radiance = third.rgb * (hasEmission ? texture(emissionTexture, onTextures.zw).rgb : vec3(1.0));
  vec3 field = light * (lightScale / pi);
  vec3 weight = NUMBERS(5).rgb * tint, passedPart = vec3(1.0 - alpha);
  if (kind == ${kinds.coat}) weight = coatReflectance(c);
  if (kind == ${kinds.pane}) glassShares(c, weight, passedPart);
  if (kind == ${kinds.unlit}) radiance = first.rgb * tint;
  else if (kind == ${kinds.coat}) radiance += rho * (1.0 - max(weight.r, max(weight.g, weight.b))) * field;
  else radiance += rho * field;
  radiance *= alpha * exposed;
  if (kind == ${kinds.curved})
    radiance += weight * seenByBody(reflect(towards, normalize(normal)), NUMBERS(5).w);
  if (kind == ${kinds.solid}) radiance += seenBySolid(normalize(normal), towards);
  if (shows == ${shown.rough})
    radiance += blurred(dot(face, towards) > 0.0 ? -face : face, towards, NUMBERS(5).w, kind == ${kinds.coat}, weight);
  if (shows == ${shown.own} && kind == ${kinds.coat}) radiance += weight * field * exposed;
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
