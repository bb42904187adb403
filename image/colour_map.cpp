#include "image/colour_map.h"

#include "image/display.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace meninas {

glm::vec3 magma(double t) {
  // Every fifteenth of the 256 published colours.
  static const std::array<glm::vec3, 18> knots{{{0.001462F, 0.000466F, 0.013866F},
                                                {0.035520F, 0.028397F, 0.125209F},
                                                {0.102815F, 0.063010F, 0.257854F},
                                                {0.191460F, 0.064818F, 0.396152F},
                                                {0.291366F, 0.064553F, 0.475462F},
                                                {0.384299F, 0.097855F, 0.501002F},
                                                {0.475780F, 0.134577F, 0.507921F},
                                                {0.569172F, 0.167454F, 0.504105F},
                                                {0.664915F, 0.198075F, 0.488836F},
                                                {0.761077F, 0.231214F, 0.460162F},
                                                {0.852126F, 0.276106F, 0.418573F},
                                                {0.925937F, 0.346844F, 0.374959F},
                                                {0.969680F, 0.446936F, 0.360311F},
                                                {0.989363F, 0.557873F, 0.391671F},
                                                {0.996580F, 0.668256F, 0.456192F},
                                                {0.996727F, 0.776795F, 0.541039F},
                                                {0.992440F, 0.884330F, 0.640099F},
                                                {0.987053F, 0.991438F, 0.749504F}}};
  const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(knots.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), knots.size() - 2);
  return glm::mix(knots[below], knots[below + 1],
                  static_cast<float>(place - static_cast<double>(below)));
}

glm::vec3 blue_orange(double t) {
  // Lightness and chroma grow with |t|; the hues are 65 degrees and 250 degrees.
  const auto size = static_cast<float>(std::min(std::abs(t), 1.0));
  const float lightness = 0.2F + 0.62F * size, chroma = 0.145F * std::min(1.0F, 2.5F * size);
  const float hue = glm::radians(t > 0.0 ? 65.0F : 250.0F);
  const float a = chroma * std::cos(hue), b = chroma * std::sin(hue);

  // From Oklab by cone responses to linear light.
  const float l = lightness + 0.3963377774F * a + 0.2158037573F * b;
  const float m = lightness - 0.1055613458F * a - 0.0638541728F * b;
  const float s = lightness - 0.0894841775F * a - 1.2914855480F * b;
  const glm::vec3 cones{l * l * l, m * m * m, s * s * s};
  const glm::mat3 to_rgb{4.0767416621F,  -1.2684380046F, -0.0041960863F, //
                         -3.3077115913F, 2.6097574011F,  -0.7034186147F, //
                         0.2309699292F,  -0.3413193965F, 1.7076147010F};
  const glm::vec3 linear = to_rgb * cones;
  return {srgb_encode(linear.r), srgb_encode(linear.g), srgb_encode(linear.b)};
}

} // namespace meninas
