#include "image/view_transform.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

double largest_of(const glm::dvec3& c) { return std::max({c.r, c.g, c.b}); }

glm::dvec3 neutral(glm::dvec3 c) {
  constexpr double start = 0.8 - 0.04, desaturation = 0.15;
  const double least = std::min({c.r, c.g, c.b});
  c -= least < 0.08 ? least - 6.25 * least * least : 0.04;
  const double peak = largest_of(c);
  if (peak < start)
    return c;
  constexpr double d = 1.0 - start;
  const double compressed = 1.0 - d * d / (peak + d - start);
  const double pale = 1.0 - 1.0 / (desaturation * (peak - compressed) + 1.0);
  return glm::mix(compressed / peak * c, glm::dvec3(compressed), pale);
}

/// The default contrast.
double sigmoid(double x) {
  const double x2 = x * x, x4 = x2 * x2;
  return 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 +
         0.1191 * x - 0.00232;
}

// Matrices are given by their columns.
constexpr glm::dmat3 rec709_to_rec2020{0.6274, 0.0691, 0.0164, 0.3293, 0.9195,
                                       0.0880, 0.0433, 0.0113, 0.8956};
constexpr glm::dmat3 rec2020_to_rec709{1.6605, -0.1246, -0.0182, -0.5876, 1.1329,
                                       -0.1006, -0.0728, -0.0083, 1.1187};
constexpr glm::dmat3 inset{0.856627153315983,  0.137318972929847,  0.11189821299995,
                           0.0951212405381588, 0.761241990602591,  0.0767994186031903,
                           0.0482516061458583, 0.101439036467562,  0.811302368396859};
constexpr glm::dmat3 outset{1.1271005818144368,    -0.1413297634984383,   -0.14132976349843826,
                            -0.11060664309660323,  1.157823702216272,     -0.11060664309660294,
                            -0.016493938717834573, -0.016493938717834257, 1.2519364065950405};

glm::dvec3 agx(const glm::dvec3& exposed) {
  // Ten stops below middle grey and six and a half above.
  constexpr double darkest = -12.47393, brightest = 4.026069, display_gamma = 2.2;
  glm::dvec3 c = inset * (rec709_to_rec2020 * exposed);
  for (int k = 0; k < 3; ++k) {
    const double stops = std::log2(std::max(c[k], 1e-10));
    c[k] = sigmoid(std::clamp((stops - darkest) / (brightest - darkest), 0.0, 1.0));
  }
  return rec2020_to_rec709 *
         glm::pow(glm::max(outset * c, glm::dvec3(0.0)), glm::dvec3(display_gamma));
}

} // namespace

std::string_view name_of(ViewTransform transform) {
  switch (transform) {
  case ViewTransform::neutral:
    return "neutral";
  case ViewTransform::agx:
    return "agx";
  case ViewTransform::srgb:
    break;
  }
  return "srgb";
}

std::string_view title_of(ViewTransform transform) {
  switch (transform) {
  case ViewTransform::neutral:
    return "Khronos PBR Neutral";
  case ViewTransform::agx:
    return "AgX";
  case ViewTransform::srgb:
    break;
  }
  return "sRGB";
}

glm::dvec3 displayed(ViewTransform transform, const glm::dvec3& exposed) {
  // Beyond this nothing is seen to change, and squares stay numbers.
  constexpr double bright_enough = 1e30;
  const glm::dvec3 light = glm::clamp(exposed, 0.0, bright_enough);
  const glm::dvec3 shown = transform == ViewTransform::neutral ? neutral(light)
                           : transform == ViewTransform::agx   ? agx(light)
                                                               : light;
  return glm::clamp(shown, 0.0, 1.0);
}

} // namespace meninas
