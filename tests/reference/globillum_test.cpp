// The mirror rooms of the global illumination tests of 1992: what pass one finds at points against paths.
#include "radiosity/pass_one.h"
#include "radiosity/queries/point_light.h"
#include "raytrace/diffuse_term.h"
#include "raytrace/two_pass.h"
#include "scenes/gltf/gltf.h"
#include "tests/reference/tracing.h"
#include "tests/support/source_dir.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

namespace meninas::test {
namespace {

struct Place {
  const char* what;
  QueryPoint point;
  double reflectance;
};

// A plan's (x, y, height) is at (x, height, -y).
const std::array places{Place{"the floor below the lamp", {{5.25, 0.0, -2.75}, {0, 1, 0}}, 0.3},
                        Place{"the floor before the mirror", {{3.75, 0.0, -0.75}, {0, 1, 0}}, 0.3},
                        Place{"the ceiling", {{6.25, 3.0, -4.25}, {0, -1, 0}}, 0.7},
                        Place{"a wall that mirrors alone light", {{10.0, 1.5, -2.75}, {-1, 0, 0}}, 0.5},
                        Place{"a partition", {{3.1, 1.5, -4.75}, {1, 0, 0}}, 0.5}};

TEST(Globillum, PointsOfTheMirrorRoomsAreThoseOfPaths) {
  const std::filesystem::path gallery = std::filesystem::path(source_dir()) / "scenes/gallery";
  for (const char* name : {"globillum-1", "globillum-2", "globillum-3"}) {
    SCOPED_TRACE(name);
    PassOneSettings settings;
    settings.cut = MeshCut::hierarchical;
    settings.mesh.element_size = 0.25;
    settings.form_factors.rays = settings.interpolation.rays = 128;
    const auto prepared = prepare_scene(load_gltf(gallery / (std::string(name) + ".gltf")), settings);
    const RadiositySolution solution = solve_pass_one(prepared->light(), settings);
    std::vector<QueryPoint> points;
    for (const Place& place : places)
      points.push_back(place.point);
    const auto light = irradiance_at_points(*prepared->light(), reflected_by_elements(solution.field),
                                            points, {.rays = 2048});
    for (std::size_t k = 0; k < places.size(); ++k) {
      SCOPED_TRACE(places[k].what);
      const Point3& x = points[k].position;
      const Point3 eye = x + 0.5 * points[k].normal + Vec3(0.1, 0.05, 0.1);
      const MeanRadiance seen = radiance_seen(prepared->scene, eye, x, 128);
      const double scale = std::numbers::pi / places[k].reflectance;
      EXPECT_LT(seen.error.g, 0.02 * seen.mean.g) << "too noisy to tell";
      // The field of 25 cm elements is off by some thousandths.
      EXPECT_NEAR(light[k].total.g, scale * seen.mean.g,
                  scale * (4.0 * seen.error.g + 5e-3 * seen.mean.g));
    }
  }
}

} // namespace
} // namespace meninas::test
