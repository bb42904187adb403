// Emission that rays find by chance is spread over neighbours: no light is lost, and no dot is left.
#include "radiosity/field/emission_kernels.h"
#include "radiosity/field/final_gathering.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/random.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace meninas::test {
namespace {

struct Floor {
  std::unique_ptr<LitScene> lit;
  VertexSamples found;
  std::vector<std::uint8_t> taken;
};

Floor floor_of_vertices() {
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 4}, {4, 0, 4}, {4, 0, 0}}, diffuse(0.5));
  Floor floor{lit(std::move(scene), {.element_size = 0.1}), {}, {}};
  floor.found = make_samples(floor.lit->mesh);
  std::ranges::fill(floor.found.states, VertexState::gathered);
  floor.taken.assign(floor.found.states.size(), 1);
  return floor;
}

void add_emission(const std::vector<VertexEmission>& gathered, VertexSamples& found) {
  for (const auto& [v, hits, total, mirrored] : gathered) {
    found.field.irradiance[v] += total;
    found.field.indirect[v] += total;
    found.field.mirrored[v] += mirrored;
    found.field.indirect_mirrored[v] += mirrored;
  }
}

/// The sum over vertices of value times the area around.
double power_of(const VertexSamples& found, const std::vector<glm::vec3>& values) {
  double sum = 0.0;
  for (std::size_t v = 0; v < values.size(); ++v)
    for (const ElementId element : around(found.around, v))
      sum += double{values[v].r} * found.mesh.area[index(element)];
  return sum;
}

// Hits one in fifty, as of a lamp that a ray in thousands meets.
TEST(EmissionKernels, LeaveNoDotsAndLoseNoLight) {
  Floor floor = floor_of_vertices();
  VertexSamples& found = floor.found;
  const std::size_t count = found.states.size();
  std::vector<VertexEmission> gathered;
  Random random(5);
  for (std::uint32_t v = 0; v < count; ++v)
    if (random.between(0.0, 1.0) < 0.02)
      gathered.push_back({v, 1, glm::vec3(50.0F), glm::vec3(50.0F)});
  ASSERT_GT(gathered.size(), 10U);
  add_emission(gathered, found);
  const double before = power_of(found, found.field.irradiance);
  spread_emission(gathered, floor.taken, found);
  for (const auto* values : {&found.field.irradiance, &found.field.indirect, &found.field.mirrored,
                             &found.field.indirect_mirrored})
    EXPECT_NEAR(power_of(found, *values), before, 1e-4 * before);
  // 1 W/m^2 on average, with noise of 7 before. A cone of 16 hits has the noise of 2/3 as many,
  // 0.31, and at the corners of the floor, where a quarter of it is left, twice that.
  double squares = 0.0, most = 0.0;
  for (const glm::vec3& value : found.field.irradiance) {
    squares += (value.r - 1.0) * (value.r - 1.0);
    most = std::max(most, double{value.r});
  }
  EXPECT_LT(std::sqrt(squares / double(count)), 0.62);
  EXPECT_LT(most, 3.0);
}

TEST(EmissionKernels, LeaveWhatIsWellFoundAsItIs) {
  Floor floor = floor_of_vertices();
  VertexSamples& found = floor.found;
  const std::size_t count = found.states.size();
  std::vector<VertexEmission> gathered;
  for (std::uint32_t v = 0; v < count; ++v)
    if (found.mesh.vertices[v].x < 2.01)
      gathered.push_back({v, 40, glm::vec3(3.0F), glm::vec3(0.0F)});
  add_emission(gathered, found);
  const VertexIrradiance before = found.field;
  spread_emission(gathered, floor.taken, found);
  EXPECT_EQ(found.field.irradiance, before.irradiance);

  // One hit beside that light spreads away from it.
  const auto beside = std::ranges::find_if(found.mesh.vertices, [](const Point3& x) {
    return x.x > 2.01 && x.x < 2.3 && std::abs(x.z - 2.0) < 0.1;
  });
  ASSERT_NE(beside, found.mesh.vertices.end());
  const auto v = static_cast<std::size_t>(beside - found.mesh.vertices.begin());
  const std::vector<VertexEmission> well_found = gathered;
  gathered.push_back({static_cast<std::uint32_t>(v), 1, glm::vec3(100.0F), glm::vec3(0.0F)});
  std::ranges::sort(gathered, {}, &VertexEmission::vertex);
  found.field = before;
  found.field.irradiance[v] += glm::vec3(100.0F);
  found.field.indirect[v] += glm::vec3(100.0F);
  spread_emission(gathered, floor.taken, found);
  EXPECT_LT(found.field.irradiance[v].r, 2.0F);
  for (const VertexEmission& emission : well_found)
    EXPECT_EQ(found.field.irradiance[emission.vertex], before.irradiance[emission.vertex]);
}

} // namespace
} // namespace meninas::test
