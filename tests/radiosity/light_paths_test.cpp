// The sum over terms equals the rays-only answer: direct light from the source and its images (D), gathered emission (G) and the
// transport (T) against a solution in which no closed form owns anything, so that rays alone find every path.
#include "scenes/gltf.h"
#include "scenes/sampling.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/random.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

/// The same, but that every emission is gathered by rays.
LightScene by_rays_alone(const LightScene& light) {
  LightScene rays = light;
  rays.emitters.clear();
  rays.emitter_tree = {};
  std::fill(rays.from_source.begin(), rays.from_source.end(), std::uint8_t{0});
  return rays;
}

/// Mean and variance of the mean, by element, of independent solutions.
struct Replicas {
  std::vector<Rgb> mean, variance;
};

Replicas solve_again_and_again(const LightScene& light, int count, std::uint32_t seed) {
  Replicas replicas;
  const std::size_t size = element_count(light.mesh);
  std::vector<Rgb> squares(size, Rgb(0.0));
  replicas.mean.assign(size, Rgb(0.0));
  for (int r = 0; r < count; ++r) {
    PassOneSettings settings;
    settings.form_factors.rays = 256;
    settings.form_factors.seed = hash(seed, static_cast<std::uint32_t>(r));
    settings.direct.seed = hash(seed, static_cast<std::uint32_t>(r), 1);
    settings.solver.tolerance = 1e-6;
    settings.interpolation.method = Interpolation::average;
    const RadiositySolution solution = solve_pass_one(light, settings);
    for (std::size_t e = 0; e < size; ++e) {
      replicas.mean[e] += solution.irradiance[e] / double(count);
      squares[e] += solution.irradiance[e] * solution.irradiance[e] / double(count);
    }
  }
  for (std::size_t e = 0; e < size; ++e)
    replicas.variance.push_back(
        glm::max(Rgb(0.0), squares[e] - replicas.mean[e] * replicas.mean[e]) / double(count - 1));
  return replicas;
}

struct Agreement {
  double worst = 0.0; ///< largest difference of an element, in standard errors
  double mean =
      0.0; ///< mean difference in standard errors: 0 +- a few tenths, for elements share their emitters
  double square = 0.0; ///< mean square: about 1
};

/// 32 solutions each: the standard error of their mean is known to an eighth, and of a thousand values one is beyond 3.6 of them.
Agreement agreement(const LightScene& light) {
  constexpr int count = 32;
  const Replicas source = solve_again_and_again(light, count, 1),
                 rays = solve_again_and_again(by_rays_alone(light), count, 2);
  Agreement result;
  std::size_t lit = 0;
  for (std::size_t e = 0; e < source.mean.size(); ++e) {
    const double difference = source.mean[e].g - rays.mean[e].g;
    const double error = std::sqrt(source.variance[e].g + rays.variance[e].g);
    if (difference == 0.0)
      continue;
    // No sample of emission at all tells nothing about the error: the rays must have met the emitter.
    EXPECT_GT(error, 0.0) << e;
    const double z = difference / error;
    result.worst = std::max(result.worst, std::abs(z));
    result.mean += z;
    result.square += z * z;
    ++lit;
  }
  result.mean /= double(lit);
  result.square /= double(lit);
  return result;
}

void expect_agreement(Scene scene, double elements, const WorldSettings& worlds = {}) {
  const auto l =
      lit(std::move(scene), {.target_elements = elements}, {.mirrors = {}, .worlds = worlds});
  const Agreement found = agreement(*l->light);
  EXPECT_LT(found.worst, 4.0);
  EXPECT_LT(std::abs(found.mean), 0.5);
  EXPECT_LT(found.square, 1.6);
  EXPECT_GT(found.square, 0.4);
}

class LightPaths : public testing::TestWithParam<const char*> {};

TEST_P(LightPaths, TermsAddUpToTheRaysOnlyAnswer) {
  expect_agreement(
      load_gltf(std::string(MENINAS_SOURCE_DIR) + "/scenes/gallery/" + GetParam() + ".gltf"),
      150.0);
}

INSTANTIATE_TEST_SUITE_P(Gallery, LightPaths,
                         testing::Values("cornell", "cornell-mirror", "mirror-spot",
                                         "facing-mirrors", "periscope"),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           std::erase(name, '-');
                           return name;
                         });

// Whoever owns the deep worlds, the closed form or the rays, the answer is the same.
TEST(LightPathsByDepth, OwnershipMovesNothing) {
  for (const int depth : {0, 1, 3})
    expect_agreement(facing_mirrors(Rgb(0.9)), 100.0, {.max_depth = depth});
}

} // namespace
} // namespace meninas::test
