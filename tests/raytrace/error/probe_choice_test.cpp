// Which pixels tell the error:
// means stay what they are, and where a field changes much is looked at.
#include "raytrace/error/picture_error.h"
#include "raytrace/error/probe_choice.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

/// A room, with a field of which one vertex of a wall in sight is wrong.
struct SpoiltRoom {
  TwoPassSettings settings;
  std::shared_ptr<const PreparedScene> prepared;
  RadiositySolution solution;
  IrradianceField field;
  Image right, spoilt;

  SpoiltRoom() {
    settings.pass_one.mesh.element_size = 0.15;
    settings.pass_one.form_factors.rays = settings.pass_one.interpolation.rays = 64;
    settings.render.width = settings.render.height = 64;
    settings.render.samples = 4;
    settings.render.diffuse.term = DiffuseTerm::direct;
    Scene scene = half_room_with_small_mirror();
    scene.cameras = {look_at({1.8, 1.1, 2.8}, {0.4, 0.6, 1.0}, 1.4)};
    prepared = prepare_scene(scene, settings.pass_one);
    solution = solve_pass_one(prepared->light(), settings.pass_one);
    field = solution.field;
    right = picture(solution.field);
    const auto& places = light().mesh.vertices;
    const Point3 spot(0.0, 0.3, 1.5);
    const auto nearest = std::ranges::min_element(
        places, {}, [&](const Point3& x) { return glm::distance(x, spot); });
    const auto v = static_cast<std::size_t>(nearest - places.begin());
    field.indirect[v] += 40.0F * field.irradiance[v];
    field.irradiance[v] += 40.0F * field.irradiance[v];
    spoilt = picture(field);
  }

  const LightScene& light() const { return *solution.field.scene; }
  const Camera& camera() const { return prepared->scene.cameras.front(); }
  Image picture(const IrradianceField& of) const {
    return render(of, camera(), settings.render).image;
  }
  std::vector<std::uint8_t> emits() const {
    return emitter_pixels(field, camera(), settings.render, spoilt, 4);
  }
  ProbeChoice choose(std::uint32_t seed, int wanted) const {
    RenderSettings drawn = settings.render;
    drawn.seed = seed;
    return choose_probes(field, FieldContent::indirect, camera(), drawn, emits(), wanted);
  }
};

/// Solved once for all tests.
const SpoiltRoom& room() {
  static const SpoiltRoom spoilt;
  return spoilt;
}

double changed(glm::ivec2 pixel) {
  const glm::vec3 off = room().spoilt.at(pixel.x, pixel.y) - room().right.at(pixel.x, pixel.y);
  return double{glm::dot(off, off)};
}

/// The mean over pixels outside emitters of what was changed, squared.
double mean_change() {
  const auto emits = room().emits();
  double sum = 0.0, count = 0.0;
  for (int y = 0; y < room().spoilt.height; ++y)
    for (int x = 0; x < room().spoilt.width; ++x)
      if (emits[static_cast<std::size_t>(y * room().spoilt.width + x)] == 0) {
        sum += changed({x, y});
        count += 1.0;
      }
  return sum / count;
}

TEST(ProbeChoice, KeepsMeans) {
  // Over many draws the weighted mean is that of the picture,
  // for what is even and for what sits in a few pixels.
  constexpr std::uint32_t draws = 256;
  double sum = 0.0, squares = 0.0, weights = 0.0;
  for (std::uint32_t seed = 0; seed < draws; ++seed) {
    const ProbeChoice choice = room().choose(seed, 64);
    ASSERT_EQ(choice.pixels.size(), 64U);
    double mean = 0.0;
    for (std::size_t k = 0; k < choice.pixels.size(); ++k) {
      mean += choice.weight[k] * changed(choice.pixels[k]) / 64.0;
      weights += choice.weight[k] / 64.0;
      EXPECT_GT(choice.weight[k], 0.0);
      EXPECT_LE(choice.weight[k], 2.0);
    }
    sum += mean;
    squares += mean * mean;
  }
  const double mean = sum / draws;
  const double sigma = std::sqrt((squares / draws - mean * mean) / draws);
  EXPECT_NEAR(mean, mean_change(), 4.0 * sigma);
  EXPECT_LT(sigma, 0.05 * mean) << "or else nothing is tested";
  EXPECT_NEAR(weights / draws, 1.0, 0.02);
}

TEST(ProbeChoice, AnyFirstOnesWillDo) {
  constexpr std::uint32_t draws = 256;
  double sum = 0.0, squares = 0.0;
  for (std::uint32_t seed = 0; seed < draws; ++seed) {
    const ProbeChoice choice = room().choose(seed, 512);
    double mean = 0.0;
    for (std::size_t k = 0; k < 32; ++k)
      mean += choice.weight[k] * changed(choice.pixels[k]) / 32.0;
    sum += mean;
    squares += mean * mean;
  }
  const double mean = sum / draws;
  EXPECT_NEAR(mean, mean_change(), 4.0 * std::sqrt((squares / draws - mean * mean) / draws));
}

TEST(ProbeChoice, IsEvenWhereNothingChanges) {
  IrradianceField even = room().field;
  for (auto* values : {&even.irradiance, &even.mirrored, &even.indirect, &even.indirect_mirrored})
    std::ranges::fill(*values, glm::vec3(1.0F));
  const ProbeChoice choice = choose_probes(even, FieldContent::all, room().camera(),
                                           room().settings.render, room().emits(), 100);
  for (const double weight : choice.weight)
    EXPECT_EQ(weight, 1.0);
}

TEST(PictureError, IsCertainWhereAFewPixelsHoldIt) {
  // One vertex in a thousand is wrong.
  // Sixty-four pixels drawn evenly would miss it two times out of three, and say far too much else.
  const double mean_radiance = [] {
    double sum = 0.0, count = 0.0;
    const auto emits = room().emits();
    for (std::size_t p = 0; p < emits.size(); ++p)
      if (emits[p] == 0) {
        const glm::vec3& l = room().spoilt.pixels[p];
        sum += double{l.r} + l.g + l.b;
        count += 3.0;
      }
    return sum / count;
  }();
  const double error = std::sqrt(mean_change() / 3.0) / mean_radiance;
  ASSERT_GT(error, 0.1) << "or else other errors are as large";
  for (std::uint32_t seed = 0; seed < 16; ++seed) {
    TwoPassSettings settings = room().settings;
    settings.render.seed = seed;
    const PictureError estimate = estimate_error(room().field, room().camera(), settings, room().solution.solver,
        {room().spoilt, {}}, {.gathered_pixels = 64, .pixels = 64});
    EXPECT_NEAR(std::hypot(estimate.mesh, estimate.form_factors), error, 0.3 * error) << seed;
  }
}

} // namespace
} // namespace meninas::test
