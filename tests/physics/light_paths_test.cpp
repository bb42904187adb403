// The sum over terms equals the rays-only answer:
// direct light and its images (D), gathered emission (G) and the transport (T)
// against a solution in which no closed form owns anything, so that rays alone find every path.
#include "scenes/gltf/gltf.h"
#include "scenes/sampling.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/random.h"
#include "tests/support/rooms.h"
#include "tests/support/source_dir.h"

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
  std::fill(rays.direct_sides.begin(), rays.direct_sides.end(), std::uint8_t{0});
  return rays;
}

/// What is compared, and how finely it is sampled.
/// Where few rays meet the lamp, so that an element's error is not known, the means over nodes are.
/// Of the box of `mirror-spot`, lit through a hole, 4,096 rays of each of its few elements meet the
/// lamp once in a dozen solutions, which says nothing of the error either; sixteen times as many do.
struct Comparison {
  std::string scene;
  bool by_node = false;
  int rays = 256;
  int replicas = 32;
};

/// Mean, and variance of the mean, of independent solutions, by element or by node.
struct Replicas {
  std::vector<double> mean, variance;
};

/// Area means of the irradiance over what is compared.
std::vector<double> means_of(const LightScene& light, const std::vector<Rgb>& irradiance,
                             bool by_node) {
  const ElementMesh& mesh = light.mesh;
  const std::size_t size = by_node ? light.scene.nodes.size() : element_count(mesh);
  std::vector<double> value(size, 0.0), area(size, 0.0);
  for (std::size_t e = 0; e < element_count(mesh); ++e) {
    const std::size_t k = by_node ? index(mesh.sides[index(mesh.side_of_element[e])].node) : e;
    value[k] += mesh.area[e] * irradiance[e].g;
    area[k] += mesh.area[e];
  }
  for (std::size_t k = 0; k < size; ++k)
    value[k] = area[k] > 0.0 ? value[k] / area[k] : 0.0;
  return value;
}

Replicas solve_again_and_again(const LightScene& light, const Comparison& how, std::uint32_t seed) {
  Replicas replicas;
  for (int r = 0; r < how.replicas; ++r) {
    PassOneSettings settings;
    settings.form_factors.rays = how.rays;
    settings.form_factors.seed = hash(seed, static_cast<std::uint32_t>(r));
    settings.direct.seed = hash(seed, static_cast<std::uint32_t>(r), 1);
    settings.solver.tolerance = 1e-6;
    settings.interpolation.method = Interpolation::average;
    const auto found = means_of(light, solve_pass_one(std::make_shared<const LightScene>(light), settings).irradiance, how.by_node);
    replicas.mean.resize(found.size(), 0.0);
    replicas.variance.resize(found.size(), 0.0);
    for (std::size_t k = 0; k < found.size(); ++k) {
      replicas.mean[k] += found[k] / how.replicas;
      replicas.variance[k] += found[k] * found[k] / how.replicas;
    }
  }
  for (std::size_t k = 0; k < replicas.mean.size(); ++k)
    replicas.variance[k] =
        std::max(0.0, replicas.variance[k] - replicas.mean[k] * replicas.mean[k]) /
        (how.replicas - 1);
  return replicas;
}

struct Agreement {
  double worst = 0.0; ///< largest difference of an element, in standard errors
  double mean =
      0.0; ///< mean difference in standard errors: elements share their light, so it has about one itself
  double square = 0.0; ///< mean square: about 1
};

/// With 32 solutions the standard error of their mean is known to an eighth:
/// of a thousand values one is beyond 3.6 of them.
Agreement agreement(const LightScene& light, const Comparison& how) {
  const Replicas source = solve_again_and_again(light, how, 1),
                 rays = solve_again_and_again(by_rays_alone(light), how, 2);
  Agreement result;
  std::size_t lit = 0;
  for (std::size_t k = 0; k < source.mean.size(); ++k) {
    const double difference = source.mean[k] - rays.mean[k];
    const double error = std::sqrt(source.variance[k] + rays.variance[k]);
    if (difference == 0.0)
      continue;
    EXPECT_GT(rays.variance[k], 0.0) << k; // no ray met the lamp: nothing is known of the error
    const double z = difference / error;
    result.worst = std::max(result.worst, std::abs(z));
    result.mean += z;
    result.square += z * z;
    ++lit;
  }
  EXPECT_GT(lit, 0U);
  result.mean /= double(lit);
  result.square /= double(lit);
  return result;
}

void expect_agreement(Scene scene, double elements, const Comparison& how,
                      const WorldSettings& worlds = {}) {
  const auto l =
      lit(std::move(scene), {.target_elements = elements}, {.mirrors = {}, .worlds = worlds});
  const Agreement found = agreement(*l->light, how);
  EXPECT_LT(found.worst, 4.0);
  if (how.by_node)
    return; // a few values, which share the error of the lamp
  EXPECT_LT(std::abs(found.mean), 2.0);
  EXPECT_LT(found.square, 1.6);
  EXPECT_GT(found.square, 0.4);
}

class LightPaths : public testing::TestWithParam<Comparison> {};

TEST_P(LightPaths, TermsAddUpToTheRaysOnlyAnswer) {
  expect_agreement(
      load_gltf(source_dir() + "/scenes/gallery/" + GetParam().scene + ".gltf"),
      100.0, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Gallery, LightPaths,
                         testing::Values(Comparison{"cornell"}, Comparison{"facing-mirrors"},
                                         Comparison{"cornell-mirror", true, 1024, 12},
                                         Comparison{"mirror-spot", true, 65536, 8},
                                         Comparison{"periscope", true, 1024, 12},
                                         Comparison{"glass-solids", true, 1024, 12}),
                         [](const auto& compared) {
                           std::string name = compared.param.scene;
                           std::erase(name, '-');
                           return name;
                         });

// Whoever owns the deep worlds, the closed form or the rays, the answer is the same.
TEST(LightPathsByDepth, OwnershipMovesNothing) {
  for (const int depth : {0, 1, 3})
    expect_agreement(facing_mirrors(Rgb(0.9)), 100.0, {.scene = "facing-mirrors", .rays = 128},
                     {.max_depth = depth});
}

} // namespace
} // namespace meninas::test
