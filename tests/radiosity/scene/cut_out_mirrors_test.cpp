// Holes of cut-out mirrors and panes throw no light: segments that meet one are lost,
// and what is left is the light of the same sheet built of polygons.
#include "radiosity/light/cluster_cut.h"
#include "radiosity/light/light_samples.h"
#include "radiosity/scene/mirror_holes.h"
#include "radiosity/light/shared_light.h"
#include "scenes/sampling.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/glass_rooms.h"
#include "tests/support/random.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

constexpr double rho = 0.9;

using HoleAt = bool (*)(const Point3&);

/// The scene with these holes in what is cut out.
std::unique_ptr<LitScene> lit_with(Scene scene, HoleAt hole_at, double element_size = 0.25) {
  auto l = lit(std::move(scene), {.element_size = element_size});
  const Scene& in = l->scene;
  const Holes holes = [&in, hole_at](TriangleId triangle, Vec2 b) {
    std::array<Point3, 3> x;
    for (std::size_t c = 0; c < 3; ++c)
      x[c] = in.vertices[index(in.triangles[index(triangle)].vertices[c])].position;
    return hole_at((1.0 - b.x - b.y) * x[0] + b.x * x[1] + b.y * x[2]);
  };
  l->rays.emplace(in, l->surfaces, holes);
  l->light = std::make_shared<const LightScene>(
      make_light_scene(in, l->surfaces, *l->rays, {l->plan.mirrors, l->plan.worlds}, l->mesh));
  return l;
}

Material cut_out(Material material) {
  material.alpha_mode = AlphaMode::mask;
  return material;
}

// --- A sheet at y = 0 with a square hole,
// under a ceiling at y = 1 that it throws light of a lamp on

enum class Sheet { whole, with_hole, of_polygons };

bool in_square(const Point3& x) { return std::abs(x.x) < 0.3 && std::abs(x.z) < 0.3; }

/// A horizontal rectangle that faces up.
std::vector<Point3> facing_up(double x0, double x1, double z0, double z1, double y) {
  return {{x0, y, z1}, {x1, y, z1}, {x1, y, z0}, {x0, y, z0}};
}

std::vector<Point3> facing_down(double x0, double x1, double z0, double z1, double y) {
  return {{x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1}};
}

/// The lamp is n by n squares.
Scene ceiling_over(Sheet sheet, const Material& material, int n = 1) {
  Scene scene;
  add_polygon(scene, "ceiling", facing_down(-1.5, 1.5, -1.5, 1.5, 1.0), diffuse(0.5));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = 0.7 + 0.2 * i / n, z = -0.1 + 0.2 * j / n, size = 0.2 / n;
      add_polygon(scene, "lamp", facing_down(x, x + size, z, z + size, 0.5), diffuse(0.0, 10.0));
    }
  if (sheet != Sheet::of_polygons) {
    add_polygon(scene, "sheet", facing_up(-0.6, 0.6, -0.6, 0.6, 0.0), cut_out(material));
    return scene;
  }
  add_polygon(scene, "sheet", facing_up(-0.6, 0.6, -0.6, -0.3, 0.0), material);
  add_polygon(scene, "sheet", facing_up(-0.6, 0.6, 0.3, 0.6, 0.0), material);
  add_polygon(scene, "sheet", facing_up(-0.6, -0.3, -0.3, 0.3, 0.0), material);
  add_polygon(scene, "sheet", facing_up(0.3, 0.6, -0.3, 0.3, 0.0), material);
  return scene;
}

std::unique_ptr<LitScene> lit_sheet(Sheet sheet, const Material& material, int n = 1) {
  return lit_with(
      ceiling_over(sheet, material, n),
      sheet == Sheet::with_hole ? in_square : [](const Point3&) { return false; });
}

Receiver on_ceiling(const LitScene& l, double x, double z) {
  const MeshSide& side = l.mesh.sides[index(l.mesh.side_of_element[elements_of(l, "ceiling")[0]])];
  return {{x, 1.0, z}, {0.0, -1.0, 0.0}, side.plane_class, {}};
}

/// At points that would see the lamp in the hole, beside it, and in part:
/// the light of the sheet with the hole is that of polygons, to `tolerance` of the whole sheet's.
template <typename LightAt>
void expect_light_of_polygons(const Material& material, int n, double tolerance,
                              const LightAt& light_at) {
  const auto whole = lit_sheet(Sheet::whole, material, n),
             cut = lit_sheet(Sheet::with_hole, material, n),
             polygons = lit_sheet(Sheet::of_polygons, material, n);
  int dark = 0, partly = 0, bright = 0;
  for (const double z : {0.0, 0.35, 0.75})
    for (double x = -1.4; x < 0.5; x += 0.1) {
      const double all = light_at(*whole, on_ceiling(*whole, x, z)),
                   wanted = light_at(*polygons, on_ceiling(*polygons, x, z)),
                   found = light_at(*cut, on_ceiling(*cut, x, z));
      EXPECT_NEAR(found, wanted, tolerance * all) << x << ' ' << z;
      if (wanted == 0.0) {
        EXPECT_EQ(found, 0.0) << x << ' ' << z;
        ++dark;
      } else {
        ++(wanted < 0.99 * all ? partly : bright);
      }
    }
  EXPECT_GT(dark, 5);
  EXPECT_GT(partly, 5);
  EXPECT_GT(bright, 5);
}

TEST(CutOutMirrors, ThrowTheLightOfEmittersAsPolygonsDo) {
  // Of 1,024 points in a square only those in the 32
  // cells or so along the hole's edge are by chance.
  const DirectSettings settings{.shadow_rays = 64, .penumbra_rays = 1024};
  for (const Material& material : {mirror(rho), glass(Rgb(1.0))})
    expect_light_of_polygons(material, 1, 0.015, [&](const LitScene& l, const Receiver& x) {
      DirectWorkspace work;
      return direct_irradiance(*l.light, x, settings, 5, work).mirrored.g;
    });
}

TEST(CutOutMirrors, ThrowTheLightOfSharedRaysAsPolygonsDo) {
  expect_light_of_polygons(mirror(rho), 1, 0.03, [](const LitScene& l, const Receiver& x) {
    SharedLightWorkspace work;
    double sum = 0.0;
    for (std::uint32_t mean = 0; mean < 64; ++mean) {
      std::uint32_t next = 0;
      const auto point = [&]() -> NumberedPoint { return {x, next++}; };
      sum += mean_direct_irradiance(*l.light, point, {.caches_occluders = true}, hash(7, mean), work).mirrored.g;
    }
    return sum / 64.0;
  });
}

TEST(CutOutMirrors, ThrowTheLightOfClustersAsPolygonsDo) {
  // Squares that stand for many are in the hole or beside it by their rays alone.
  std::size_t together = 0;
  const DirectSettings settings{.shadow_rays = 64, .penumbra_rays = 64};
  const auto light_at = [&](const LitScene& l, const Receiver& x) {
    const ClusterTree tree = make_cluster_tree(l.light->emitters);
    ClusterWorkspace work;
    DirectWorkspace direct;
    const ClusterCut cut{.theta = 0.3, .rays = 2048};
    const auto light = cluster_irradiance({*l.light, tree, settings, cut}, x, 3, work, direct);
    for (const LightcutNode& part : work.stand_ins)
      together += part.world != real_world && tree.nodes[part.node].count > 1;
    return light.mirrored.g;
  };
  // To the stated error of the closed forms, theta^2.
  expect_light_of_polygons(mirror(rho), 8, 0.03, light_at);
  EXPECT_GT(together, 100U);
}

TEST(CutOutMirrors, PassOneFindsTheLightOfPolygons) {
  PassOneSettings settings;
  settings.form_factors.rays = 256;
  settings.interpolation.method = Interpolation::average;
  const auto light_of = [&](Sheet sheet) {
    const auto l = lit_sheet(sheet, mirror(rho));
    return mean_over(*l, solve_pass_one(l->light, settings).irradiance, "ceiling").g;
  };
  const double polygons = light_of(Sheet::of_polygons);
  EXPECT_NEAR(light_of(Sheet::with_hole), polygons, 0.01 * polygons);
  EXPECT_GT(light_of(Sheet::whole), 1.1 * polygons);
}

TEST(CutOutMirrors, NoPointOfALampIsSeenInAHole) {
  // The same points on the same images as without the hole,
  // of which those seen by way of it send nothing.
  for (const Material& material : {mirror(rho), glass(Rgb(0.9, 1.0, 0.8))}) {
    const auto whole = lit_sheet(Sheet::whole, material),
               cut = lit_sheet(Sheet::with_hole, material);
    DirectWorkspace work;
    std::vector<EmissionSample> all, left;
    int lost = 0, kept = 0;
    Random random(4);
    for (std::uint32_t trial = 0; trial < 200; ++trial) {
      const Receiver x = on_ceiling(*cut, random.between(-1.4, 0.5), random.between(-0.9, 0.9));
      const EmissionSampling sampling{.per_image = 16, .seed = trial};
      emission_samples(*whole->light, x, sampling, work, all);
      emission_samples(*cut->light, x, sampling, work, left);
      ASSERT_EQ(all.size(), left.size());
      for (std::size_t k = 0; k < all.size(); ++k) {
        const bool in_hole = in_square(x.position + all[k].towards / -all[k].towards.y);
        EXPECT_EQ(left[k].radiance, in_hole ? Rgb(0.0) : all[k].radiance);
        if (all[k].radiance != Rgb(0.0))
          ++(in_hole ? lost : kept);
      }
    }
    EXPECT_GT(lost, 300);
    EXPECT_GT(kept, 300);
  }
}

// --- Punctual lights

/// On the plane x = 0.
bool in_round_hole(const Point3& x) { return std::hypot(x.y - 1.5, x.z) < 0.3; }

TEST(CutOutMirrors, APunctualLightHasNoImageInAHole) {
  const Point3 lamp{1.0, 2.5, 0.3}, image{-1.0, 2.5, 0.3};
  for (const Material& material : {mirror(rho), glass(Rgb(1.0))}) {
    Scene scene;
    add_polygon(scene, "floor", {{0.1, 0, 3}, {4, 0, 3}, {4, 0, -3}, {0.1, 0, -3}}, diffuse(0.5));
    add_polygon(scene, "sheet", {{0, 1, 3}, {0, 1, -3}, {0, 2, -3}, {0, 2, 3}}, cut_out(material));
    scene.lights = {{.name = "lamp", .intensity = Rgb(30.0), .position = lamp}};
    const auto l = lit_with(scene, in_round_hole);
    int in = 0, beside = 0;
    for (double x = 0.75; x < 3.9; x += 0.05)
      for (double z = -1.5; z < 1.5; z += 0.11) {
        const Point3 at{x, 0.0, z};
        const Point3 on_sheet = glm::mix(at, image, x / (1.0 + x));
        if (on_sheet.y < 1.0 + 1e-6 || on_sheet.y > 2.0 - 1e-6)
          continue;
        const Vec3 to = image - at;
        const double distance = glm::length(to), cosine = (1.0 + x) / distance;
        const double reflected =
            material.metallic > 0.0 ? rho : 1.0 - pane_transmittance(1.5, cosine);
        const bool hole = in_round_hole(on_sheet);
        ++(hole ? in : beside);
        const double wanted = hole ? 0.0 : reflected * 30.0 * to.y / std::pow(distance, 3.0);
        DirectWorkspace work;
        const ArrivingLight light = direct_irradiance(
            *l->light, {at, {0, 1, 0}, l->mesh.sides[0].plane_class, {}}, {}, 0, work);
        EXPECT_NEAR(light.mirrored.g, wanted, 1e-9 * light.total.g) << x << ' ' << z;
      }
    EXPECT_GT(in, 50);
    EXPECT_GT(beside, 500);
  }
}

// --- Segments, and points of mirrors

/// On the planes z = 0 and z = 1.
bool in_either_hole(const Point3& x) {
  return std::hypot(x.x - 0.5, x.y - 0.5) < (x.z < 0.5 ? 0.3 : 0.2);
}

TEST(CutOutMirrors, SegmentsAreLostInTheHolesOfAnyMirrorOfTheirChain) {
  Scene scene = facing_mirrors(Rgb(rho));
  add_box(scene, "box", {0.3, 0.0, 0.4}, {0.6, 0.5, 0.6}, diffuse(0.5));
  for (Material& material : scene.materials)
    material.alpha_mode = is_mirror(material) ? AlphaMode::mask : AlphaMode::opaque;
  const auto whole = lit(scene, {.element_size = 0.5}), cut = lit_with(scene, in_either_hole, 0.5);
  Random random(3);
  int lost = 0, kept = 0;
  for (int trial = 0; trial < 500; ++trial) {
    std::array<FoldedSegment, 16> segments;
    std::uint32_t holes = 0;
    for (std::uint32_t k = 0; k < 16; ++k) {
      const auto& worlds = cut->light->worlds.worlds;
      const auto w = static_cast<std::uint32_t>(random.between(0.0, double(worlds.size())));
      const Point3 from = random.in_box(Vec3(0.05), Vec3(0.95));
      const Point3 to = random.in_box(Vec3(0.05), Vec3(0.95));
      fold(*cut->light, WorldId{w},
           {from, apply(worlds[w].image, to), none<PlaneId>, none<PlaneId>}, segments[k]);
      for (std::size_t leg = 0; leg + 1 < segments[k].legs.size(); ++leg)
        holes |= in_either_hole(segments[k].legs[leg].to) ? 1U << k : 0U;
    }
    std::uint64_t rays = 0;
    std::array<LegBlocker, 16> blockers;
    blockers.fill({TriangleId{0}, 1});
    const std::uint32_t others = blocked(*whole->light, segments, 16, rays);
    EXPECT_EQ(blocked(*cut->light, segments, 16, rays, &blockers), others | holes);
    for (std::uint32_t k = 0; k < 16; ++k) {
      EXPECT_TRUE((holes >> k & 1U) == 0 || blockers[k].triangle == none<TriangleId>);
      ++((holes & ~others) >> k & 1U ? lost : kept);
    }
  }
  EXPECT_GT(lost, 1000);
  EXPECT_GT(kept, 1000);
}

TEST(CutOutMirrors, AreAskedForTheirOwnHolesInAPlaneThatOthersShare) {
  // A cut-out mirror laid on a whole one of another reflectance;
  // far off, where corners are known to 1e-4 m.
  for (const Vec3& far : {Vec3(0.0), Vec3(3e3, -2e3, 1e3)}) {
    Scene scene;
    add_polygon(scene, "laid on", facing_up(-0.6, 0.6, -0.6, 0.6, 0.0), cut_out(mirror(rho)));
    add_polygon(scene, "below", facing_up(-1.0, 1.0, -1.0, 1.0, 0.0), mirror(0.5));
    for (Vertex& vertex : scene.vertices)
      vertex.position += far;
    scene.position_error = far == Vec3(0.0) ? 0.0 : 1e-4;
    const auto l = lit_with(scene, [](const Point3& x) {
      return in_square(std::abs(x.x) > 1e2 ? x - Vec3(3e3, -2e3, 1e3) : x);
    });
    ASSERT_EQ(l->plan.mirrors.mirrors.size(), 2U);
    const bool first_is_below = l->plan.mirrors.mirrors[0].reflectance.g == 0.5;
    const MirrorId laid_on{first_is_below ? 1U : 0U}, below{first_is_below ? 0U : 1U};
    EXPECT_EQ(l->light->cut_out_mirrors[index(laid_on)], 1);
    EXPECT_EQ(l->light->cut_out_mirrors[index(below)], 0);
    // Its corner, its edge, the line in which its triangles meet,
    // and a height that rounding may leave.
    const Vec3 off(0.0, 0.5 * l->surfaces.tolerance, 0.0);
    for (const Vec3& x : {Vec3(-0.6, 0, 0.6), Vec3(0.6, 0, 0.1), Vec3(0.45, 0, -0.45),
                          Vec3(-0.45, 0, -0.45), Vec3(0.1, 0, 0.35)}) {
      EXPECT_TRUE(is_solid_at(*l->light, laid_on, far + x + off)) << x.x << ' ' << x.z;
      EXPECT_TRUE(is_solid_at(*l->light, below, far + x)) << x.x << ' ' << x.z;
    }
    for (const Vec3& x : {Vec3(0.0), Vec3(0.2, 0, -0.2), Vec3(0.29, 0, 0.1), Vec3(0.8, 0, 0.0)}) {
      EXPECT_FALSE(is_solid_at(*l->light, laid_on, far + x + off)) << x.x << ' ' << x.z;
      EXPECT_TRUE(is_solid_at(*l->light, below, far + x)) << x.x << ' ' << x.z;
    }
  }
}

TEST(CutOutMirrors, CostNothingWhereNoneAre) {
  EXPECT_TRUE(lit(facing_mirrors(Rgb(rho)), {.element_size = 0.5})->light->cut_out_mirrors.empty());
  // What is cut out but is no mirror is none of them.
  Scene scene = facing_mirrors(Rgb(rho));
  for (Material& material : scene.materials)
    material.alpha_mode = is_mirror(material) ? AlphaMode::opaque : AlphaMode::mask;
  EXPECT_TRUE(lit_with(scene, in_either_hole)->light->cut_out_mirrors.empty());
}

} // namespace
} // namespace meninas::test
