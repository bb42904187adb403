// The picture as a display shows it (image/view_transform.h).
"use strict";

const wholeVertex = `#version 300 es
out vec2 at;
void main() {
  at = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(at, 0.0, 1.0);
}`;

const viewTransforms = {
  srgb: `
vec3 transformed(vec3 c) { return c; }`,
  neutral: `
vec3 transformed(vec3 c) {
  float least = min(c.r, min(c.g, c.b)), start = 0.76, d = 0.24;
  c -= least < 0.08 ? least - 6.25 * least * least : 0.04;
  float peak = max(c.r, max(c.g, c.b));
  if (peak < start) return c;
  float compressed = 1.0 - d * d / (peak + d - start);
  return mix(c * compressed / peak, vec3(compressed), 1.0 - 1.0 / (0.15 * (peak - compressed) + 1.0));
}`,
  agx: `
vec3 transformed(vec3 c) {
  const mat3 toRec2020 = mat3(0.6274, 0.0691, 0.0164, 0.3293, 0.9195, 0.0880, 0.0433, 0.0113, 0.8956);
  const mat3 fromRec2020 = mat3(1.6605, -0.1246, -0.0182, -0.5876, 1.1329, -0.1006, -0.0728, -0.0083, 1.1187);
  const mat3 inset = mat3(0.856627153315983, 0.137318972929847, 0.11189821299995, 0.0951212405381588, 0.761241990602591, 0.0767994186031903, 0.0482516061458583, 0.101439036467562, 0.811302368396859);
  const mat3 outset = mat3(1.1271005818144368, -0.1413297634984383, -0.14132976349843826, -0.11060664309660323, 1.157823702216272, -0.11060664309660294, -0.016493938717834573, -0.016493938717834257, 1.2519364065950405);
  c = inset * (toRec2020 * c);
  vec3 x = clamp((log2(max(c, 1e-10)) + 12.47393) / 16.5, 0.0, 1.0), x2 = x * x, x4 = x2 * x2;
  x = 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x - 0.00232;
  return fromRec2020 * pow(max(outset * x, 0.0), vec3(2.2));
}`
};

/// With one view transform, called in one place: what is compiled takes time where the processor draws.
const screenFragment = transform => `#version 300 es
precision highp float;
in vec2 at;
uniform sampler2D picture;
uniform int block; // the picture has so many pixels along each side of a pixel of the screen
uniform bool asItIs; // false colours
out vec4 result;
${viewTransforms[transform]}
vec3 displayed(vec3 c) {
  c = max(c, 0.0);
  return clamp(asItIs ? c : transformed(c), 0.0, 1.0);
}
/// A pixel that is partly of something brighter than the display, seen straight, shows the mean of
/// what its parts show (raytrace/pixels/bright_edges.h): lamps would have edges like stairs.
void main() {
  vec3 sum = vec3(0.0), parts = vec3(0.0), c;
  float low = 1e30, high = 0.0, straight = 0.0, share = 1.0 / float(block * block);
  ivec2 corner = ivec2(gl_FragCoord.xy) * block;
  // Their mean comes last.
  for (int k = 0; k <= block * block; ++k) {
    bool isMean = k == block * block;
    vec4 texel = isMean ? vec4(sum * share, 0.0) : texelFetch(picture, corner + ivec2(k % block, k / block), 0);
    c = displayed(texel.rgb);
    if (isMean) break;
    straight += texel.a;
    float brightest = max(texel.r, max(texel.g, texel.b));
    sum += texel.rgb;
    parts += c;
    low = min(low, brightest);
    high = max(high, brightest);
  }
  if (straight * share > 0.5 && high >= 1.0 && low < 0.75 * high) c = parts * share;
  result = vec4(mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c)), 1.0);
}`;
