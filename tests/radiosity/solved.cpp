#include "tests/radiosity/solved.h"

#include <gtest/gtest.h>

namespace meninas::test {

Solved solved(const Scene& scene, const PassOneSettings& settings, bool by_shots) {
  const auto l = lit(scene, settings.mesh, settings.plan);
  Solved result{by_shots ? shoot_pass_one(l->light, settings, {}, {})
                         : solve_pass_one(l->light, settings),
                {}};
  result.nodes = light_by_node(scene, l->light->mesh, result.solution);
  return result;
}

void expect_alike(const Solved& a, const Solved& b, double tolerance) {
  for (std::size_t n = 0; n < a.nodes.size(); ++n)
    for (int band = 0; band < 3 && a.nodes[n].area > 1.0; ++band)
      EXPECT_NEAR(a.nodes[n].irradiance[band], b.nodes[n].irradiance[band],
                  tolerance * a.nodes[n].irradiance[band])
          << a.nodes[n].name << ' ' << band;
}

} // namespace meninas::test
