// Means over elements by their corners and second differences.
#include "radiosity/field/curved_means.h"
#include "radiosity/field/vertex_places.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <functional>

namespace meninas::test {
namespace {

std::unique_ptr<LitScene> wall(const std::vector<Point3>& corners) {
  Scene scene;
  add_polygon(scene, "wall", corners, diffuse(0.5));
  return lit(std::move(scene), {.element_size = 0.25});
}

std::vector<glm::vec3> values_of(const ElementMesh& mesh,
                                 const std::function<double(const Point3&)>& f) {
  std::vector<glm::vec3> values;
  for (const Point3& vertex : mesh.vertices)
    values.emplace_back(f(vertex));
  return values;
}

// Of squares the rule is exact, at borders, where f'' is that of the inner corners, too;
// without second differences means are off by s^2 (f_uu + f_vv) / 12.
TEST(CurvedMeans, AreExactOfSquares) {
  const auto l = wall({{0, 0, 0}, {1.5, 0, 0}, {1.5, 1, 0}, {0, 1, 0}});
  const auto f = [](const Point3& p) {
    return 3.0 + 2.0 * p.x - p.x * p.x - 0.5 * p.y * p.y + p.x * p.y;
  };
  const std::vector<glm::vec3> values = values_of(l->mesh, f);
  const std::vector<Rgb> curved = curved_means(l->mesh, edges_of(l->mesh), values),
                         straight = corner_means(l->mesh, values);
  ASSERT_GT(curved.size(), 20U);
  const double s = 0.25, off = s * s * (2.0 + 1.0) / 12.0;
  for (std::size_t e = 0; e < curved.size(); ++e) {
    // Simpson's rule has no error of squares.
    double exact = 0.0;
    const Point3 centre = centre_of(l->mesh, static_cast<ElementId>(e));
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        exact += (i == 0 ? 4.0 : 1.0) * (j == 0 ? 4.0 : 1.0) / 36.0 *
                 f(centre + 0.5 * s * Vec3(i, j, 0));
    EXPECT_NEAR(curved[e].g, exact, 1e-5); // values are floats
    EXPECT_NEAR(straight[e].g, exact - off, 1e-5);
  }
}

// A wall of a tenth of a micrometre in light of 1e34 W/m^2 has slopes that floats do not hold.
TEST(CurvedMeans, DoNotDependOnTheScaleOfSceneAndLight) {
  const auto means_of = [](double size, double light) {
    Scene scene;
    add_polygon(scene, "wall", {{0, 0, 0}, {1.5 * size, 0, 0}, {1.5 * size, size, 0}, {0, size, 0}}, diffuse(0.5));
    const auto l = lit(std::move(scene), {.element_size = 0.25 * size});
    return curved_means(l->mesh, edges_of(l->mesh), values_of(l->mesh, [&](const Point3& p) {
                          return light * (3.0 - p.x * p.x / (size * size) + p.y / size);
                        }));
  };
  const std::vector<Rgb> plain = means_of(1.0, 1.0), extreme = means_of(1e-7, 1e34);
  ASSERT_EQ(extreme.size(), plain.size());
  for (std::size_t e = 0; e < plain.size(); ++e)
    EXPECT_NEAR(1e-34 * extreme[e].g, plain[e].g, 1e-5) << e; // values are floats
}

TEST(CurvedMeans, AreThoseOfCornersInTriangles) {
  const auto l = wall({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const auto values = values_of(l->mesh, [](const Point3& p) { return 1.0 + p.x * p.x; });
  EXPECT_EQ(curved_means(l->mesh, edges_of(l->mesh), values), corner_means(l->mesh, values));
}

// Beside a spike second differences would make less than nothing of an element's mean,
// and of those around it more than they have.
TEST(CurvedMeans, AreWithinWhatIsThere) {
  const auto l = wall({{0, 0, 0}, {1.5, 0, 0}, {1.5, 1, 0}, {0, 1, 0}});
  const auto spike = values_of(l->mesh, [](const Point3& p) {
    return glm::distance(p, Point3(0.75, 0.5, 0.0)) < 1e-6 ? 0.0 : 1.0;
  });
  auto dark = spike;
  for (glm::vec3& value : dark)
    value = 1.0F - value;
  bool differs = false;
  for (const auto& values : {spike, dark}) {
    const std::vector<Rgb> means = curved_means(l->mesh, edges_of(l->mesh), values);
    for (const Rgb& mean : means) {
      EXPECT_GE(mean.g, 0.0);
      EXPECT_LE(mean.g, 2.0);
    }
    differs = differs || means != corner_means(l->mesh, values);
  }
  EXPECT_TRUE(differs);
}

} // namespace
} // namespace meninas::test
