#include "radiosity/field/view/view_refinement.h"

#include <algorithm>
#include <limits>

namespace meninas {

double surplus_bound(const ViewRefinement& how, double pixels) {
  constexpr double within_pixel = 2.5;
  return pixels > 1.0 ? how.tolerance : within_pixel * how.tolerance / pixels;
}

float mean_light(const IrradianceField& field) {
  double sum = 0.0;
  for (const glm::vec3& irradiance : field.irradiance)
    sum += double{largest(irradiance)};
  return field.irradiance.empty() ? 0.0F : static_cast<float>(sum / double(field.irradiance.size()));
}

bool has_edge_of_light(const IrradianceField& field, ElementId element, double pixels, float dark,
                       const ViewRefinement& how) {
  if (pixels <= how.finest)
    return false;
  glm::vec3 low(std::numeric_limits<float>::infinity()), high(0.0F);
  float brightest = 0.0F;
  for (const ElementVertexId corner : field.mesh().corners[index(element)]) {
    const glm::vec3& all = field.irradiance[index(corner)];
    const glm::vec3 direct = all - field.indirect[index(corner)];
    low = glm::min(low, direct);
    high = glm::max(high, direct);
    brightest = std::max(brightest, largest(all));
  }
  return double{largest(high - low)} > double{spread_to_surplus} * surplus_bound(how, pixels) * double{brightest + dark};
}

} // namespace meninas
