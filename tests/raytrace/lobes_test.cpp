// Glossy metals and coats: lobes' grids against integrals, what they leave of even light, pictures.
#include "raytrace/glossy_frustum.h"
#include "tests/raytrace/pictures.h"
#include "tests/support/metals.h"
#include "tests/support/scene_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double pi = std::numbers::pi;

Material plastic(double reflectance, double roughness) {
  Material material = diffuse(reflectance);
  material.roughness = roughness;
  return material;
}

Bsdf bsdf_of(const Material& material) { return make_bsdf(material, untextured(material)); }

Direction at_angle(double cosine) { return {std::sqrt(1.0 - cosine * cosine), 0.0, cosine}; }

Rgb sum_of(const std::vector<LobeRay>& rays) {
  Rgb sum(0.0);
  for (const LobeRay& ray : rays)
    sum += ray.weight;
  return sum;
}

TEST(LobeGrid, WhiteReflectsAllOfEvenLightWhateverTheGrid) {
  std::vector<LobeRay> rays;
  for (const Material& material :
       {metal(Rgb(1.0), 0.05), metal(Rgb(1.0), 0.4), metal(Rgb(1.0), 1.0), plastic(1.0, 0.0),
        plastic(1.0, 0.1), plastic(1.0, 0.2)})
    for (const double cosine : {1.0, 0.5, 0.02})
      for (const int n : {1, 2, 7}) {
        const Bsdf bsdf = bsdf_of(material);
        glossy_frustum(bsdf, at_angle(cosine), n, {0.3, 0.9}, rays);
        const Rgb all = sum_of(rays) + even_reflectance(bsdf, at_angle(cosine));
        EXPECT_NEAR(all.g, 1.0, 1e-12) << material.roughness << ' ' << cosine << ' ' << n;
      }
}

TEST(LobeGrid, ItsSamplesHaveTheMeanOfAFineGrid) {
  const Direction out = at_angle(0.17); // facets hide what they reflect low above the surface
  const auto falls_off = [](const Direction& in) { return std::exp(-6.0 * in.z); };
  for (const double roughness : {0.4, 1.0}) {
    const Bsdf bsdf = bsdf_of(metal(Rgb(0.9), roughness));
    std::vector<LobeRay> rays;
    const auto sum = [&](double light = 0.0) {
      for (const LobeRay& ray : rays)
        light += ray.weight.g * falls_off(ray.in);
      return light;
    };
    const int n = 64;
    glossy_frustum(bsdf, out, n, {0.5, 0.5}, rays);
    const double whole = sum();
    double mean = 0.0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        lobe_sample(bsdf, out, {(i + 0.5) / n, (j + 0.5) / n}, rays);
        mean += sum() / (n * n);
      }
    // The table of albedos is good to 1e-3, the grid's sum about as good where facets are hidden.
    EXPECT_NEAR(mean, whole, 5e-3 * whole) << roughness;
  }
}

TEST(LobeGrid, ColourLosesAndNeverGains) {
  std::vector<LobeRay> rays;
  const Bsdf bsdf = bsdf_of(metal({0.9, 0.5, 0.1}, 0.6));
  glossy_frustum(bsdf, at_angle(0.4), 5, {0.5, 0.5}, rays);
  const Rgb all = sum_of(rays) + even_reflectance(bsdf, at_angle(0.4));
  EXPECT_THAT(all.r, testing::AllOf(testing::Gt(0.8), testing::Lt(0.9)));
  EXPECT_THAT(all.b, testing::AllOf(testing::Gt(0.05), testing::Lt(0.1)));
}

TEST(LobeGrid, WithoutWidthIsTheMirrorDirection) {
  std::vector<LobeRay> rays;
  const Bsdf bsdf = bsdf_of(metal({0.9, 0.5, 0.1}, 0.01));
  EXPECT_EQ(lobe_divisions(bsdf, at_angle(0.6), 1e6), 1);
  glossy_frustum(bsdf, at_angle(0.6), 1, {0.2, 0.4}, rays);
  ASSERT_EQ(rays.size(), 1U);
  EXPECT_EQ(rays[0].in, Direction(-0.8, 0.0, 0.6));
  EXPECT_EQ(rays[0].weight, Rgb(0.9, 0.5, 0.1));
}

TEST(LobeGrid, SmootherAndFainterLobesTakeFewerRays) {
  const auto n = [](const Material& material, double directions) {
    return lobe_divisions(bsdf_of(material), at_angle(0.8), directions);
  };
  EXPECT_EQ(n(metal(Rgb(1.0), 1.0), 64.0), 8);
  EXPECT_EQ(n(metal(Rgb(1.0), 0.25), 64.0), 4);
  EXPECT_EQ(n(metal(Rgb(0.25), 0.25), 64.0), 2);
  EXPECT_EQ(n(plastic(0.5, 0.1), 64.0), 1);
}

/// Integral of f(o, i) L(i) cos i over directions i, by midpoints in the two angles.
/// Nothing of the grid's map is in it.
double convolution(const Bsdf& bsdf, const Direction& out,
                   const std::function<double(const Direction&)>& light) {
  constexpr int rings = 512, spokes = 1024;
  double sum = 0.0;
  for (int r = 0; r < rings; ++r) {
    const double theta = 0.5 * pi * (r + 0.5) / rings;
    for (int s = 0; s < spokes; ++s) {
      const double phi = 2.0 * pi * (s + 0.5) / spokes;
      const Direction in{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                         std::cos(theta)};
      const double lit = light(in);
      if (lit > 0.0)
        sum += reflection_lobe(bsdf, out, in).g * lit * in.z * std::sin(theta);
    }
  }
  return sum * (0.5 * pi / rings) * (2.0 * pi / spokes);
}

double by_grid(const Bsdf& bsdf, const Direction& out, int n,
               const std::function<double(const Direction&)>& light) {
  std::vector<LobeRay> rays;
  glossy_frustum(bsdf, out, n, {0.5, 0.5}, rays);
  double sum = 0.0;
  for (const LobeRay& ray : rays)
    sum += ray.weight.g * light(ray.in);
  return sum;
}

TEST(LobeGrid, ConvergesToTheConvolution) {
  // A sky brighter towards one side, and one half of it dark.
  const auto smooth = [](const Direction& w) { return 1.0 + 0.7 * w.x + 0.5 * w.y * w.y; };
  const auto step = [](const Direction& w) { return w.x + 0.4 * w.y > -0.5 ? 1.0 : 0.0; };
  for (const double roughness : {0.2, 0.5, 1.0}) {
    const Bsdf bsdf = bsdf_of(metal(Rgb(1.0), roughness));
    const Direction out = at_angle(0.7);
    SCOPED_TRACE(roughness);
    const double even = convolution(bsdf, out, [](const Direction&) { return 1.0; });
    const double exact_smooth = convolution(bsdf, out, smooth),
                 exact_step = convolution(bsdf, out, step);
    // Midpoints of n^2 cells err by about 1 / n^2, at an edge by 1 / n^(3/2);
    // the norm comes from a table good to 1e-3.
    for (const int n : {4, 16, 64}) {
      EXPECT_NEAR(by_grid(bsdf, out, n, smooth), exact_smooth, 1.5e-3 + 1.0 / (n * n)) << n;
      EXPECT_NEAR(by_grid(bsdf, out, n, step), exact_step, 1.5e-3 + std::pow(n, -1.5)) << n;
    }
    // What the test compares with has the lobe's energy itself.
    EXPECT_NEAR(even,
                sum_of([&] {
                  std::vector<LobeRay> rays;
                  glossy_frustum(bsdf, out, 8, {0.5, 0.5}, rays);
                  return rays;
                }())
                    .g,
                1.5e-3);
  }
}

TEST(LobeGrid, NothingReflectsMoreThanItGetsInPassOne) {
  Material glass = plastic(1.0, 0.0);
  glass.transmission = 1.0;
  for (const Material& material :
       {glass, plastic(1.0, 0.0), plastic(1.0, 0.15), metal(Rgb(1.0), 0.3)})
    EXPECT_LE(diffuse_reflectance(material).g, 1.0 + 1e-12);
}

// --- In pictures

/// A plate of the material in the plane y = 0, nothing else.
Scene plate(const Material& material, double half = 2.0) {
  Scene scene;
  add_polygon(scene, "plate",
              {{-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half}}, material);
  return scene;
}

PassOneSettings coarse() {
  PassOneSettings settings;
  settings.mesh.element_size = 0.5;
  settings.form_factors.rays = settings.interpolation.rays = 64;
  return settings;
}

/// Sixteen directions to a sample at the most.
RenderSettings one_pixel(int samples) {
  RenderSettings settings;
  settings.width = settings.height = 1;
  settings.samples = samples;
  return settings;
}

constexpr Point3 eye{0.0, 1.0, 1.5};

/// What leaves the origin towards the eye.
glm::vec3 seen(const Scene& scene, const RenderSettings& settings) {
  return picture(lit_up(scene, coarse()), look_at(eye, Point3(0.0), 1e-4), settings).pixels[0];
}

TEST(Lobes, ALampInALobeIsItsConvolution) {
  // A black lamp of radiance 1 across the plate's horizon: nothing is reflected twice between them.
  Material plate_metal = metal({0.9, 0.6, 0.3}, 0.5);
  Scene scene = plate(plate_metal);
  add_polygon(scene, "lamp", {{-1, 0.4, -2}, {1, 0.4, -2}, {1, 1.8, -2}, {-1, 1.8, -2}},
              diffuse(0.0, pi));
  const Bsdf bsdf = bsdf_of(plate_metal);
  const Direction normal{0, 1, 0};
  const auto lamp = [&](const Direction& local) {
    const Direction w = to_world(normal, local);
    if (w.z >= 0.0)
      return 0.0;
    const Point3 at = w * (-2.0 / w.z);
    return std::abs(at.x) <= 1.0 && at.y >= 0.4 && at.y <= 1.8 ? 1.0 : 0.0;
  };
  const Direction out = to_local(normal, glm::normalize(eye));
  const double lobe = convolution(bsdf, out, lamp) / 0.6; // by green, and no Fresnel
  const double even = even_reflectance(bsdf, out).g;
  EXPECT_LT(even, 0.05) << "the field's share hardly matters here";
  // 4,608 directions meet the edges of the lamp: 4608^(-3/4) = 0.002, and the field's share.
  const glm::vec3 picture = seen(scene, one_pixel(512));
  EXPECT_NEAR(picture.g, 0.6 * lobe, 0.02 * 0.6 * lobe);
  EXPECT_NEAR(picture.r / picture.g, 1.5, 0.03);
}

TEST(Lobes, MoreGlossySamplesConvergeToTheConvolution) {
  // A wall of radiance 1 that glows on most of all there is: rays alone find it. One camera ray.
  constexpr double roughness = 0.5, rho = 0.9;
  Scene scene = plate(metal(Rgb(rho), roughness), 0.5);
  add_polygon(scene, "wall", {{-1, 0.4, -2}, {1, 0.4, -2}, {1, 1.8, -2}, {-1, 1.8, -2}},
              diffuse(0.0, pi));
  const Bsdf bsdf = bsdf_of(scene.materials[0]);
  const Direction normal{0, 1, 0};
  const auto wall = [&](const Direction& local) {
    const Direction w = to_world(normal, local);
    const Point3 at = w * (-2.0 / std::min(-1e-9, w.z));
    return w.z < 0.0 && std::abs(at.x) <= 1.0 && at.y >= 0.4 && at.y <= 1.8 ? 1.0 : 0.0;
  };
  const Direction out = to_local(normal, glm::normalize(eye));
  const double lobe = convolution(bsdf, out, wall);
  const double even = even_reflectance(bsdf, out).g;
  for (const int samples : {1, 16, 256, 4096}) {
    RenderSettings settings = one_pixel(1);
    settings.glossy_samples = samples;
    const Rendering made = [&] {
      const Taken taken = lit_up(scene, coarse());
      return render(taken.solution.field, look_at(eye, Point3(0.0), 1e-4),
                    settings);
    }();
    const double cells = std::pow(std::ceil(std::sqrt(samples * roughness * rho)), 2.0);
    // Some of them lie below the plate.
    EXPECT_LE(double(made.specular_rays), cells) << samples;
    EXPECT_GE(double(made.specular_rays), 0.85 * cells) << samples;
    // n^2 cells at an edge err by n^(-3/2) of the lobe;
    // the wall sends at most as much as fills the hemisphere to what is spread evenly.
    EXPECT_NEAR(made.image.pixels[0].g, lobe, rho * std::pow(cells, -0.75) + even + 2e-3)
        << samples;
  }
}

/// That of the origin to the square of lamp_in_lobe, which is small.
double lamp_form_factor(const Point3& centre, double half) {
  const double r2 = glm::dot(centre, centre), cosine = centre.y / std::sqrt(r2);
  return cosine * cosine / r2 * 4.0 * half * half / pi;
}

/// The lobe's share of what a lamp of radiance 1,
/// a square of side 2 `half` that faces down at `centre`, sends to the origin towards the eye.
double lamp_in_lobe(const Bsdf& bsdf, const Point3& centre, double half) {
  constexpr int cells = 400;
  const Direction normal{0, 1, 0};
  const Direction out = to_local(normal, glm::normalize(eye));
  double sum = 0.0;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const Point3 y = centre + Vec3((2.0 * (i + 0.5) / cells - 1.0) * half, 0.0,
                                     (2.0 * (j + 0.5) / cells - 1.0) * half);
      const double r2 = glm::dot(y, y), cosine = y.y / std::sqrt(r2);
      sum +=
          reflection_lobe(bsdf, out, to_local(normal, glm::normalize(y))).g * cosine * cosine / r2;
    }
  return sum * 4.0 * half * half / (cells * cells);
}

TEST(Lobes, ASmallLampIsFoundByRaysAndByPoints) {
  // 256 directions and 64 points a pixel.
  // Rays alone would miss the lamp or meet it once or twice, points alone miss the narrow lobes.
  for (const double roughness : {0.05, 0.15, 0.4})
    for (const Point3 centre : {Point3(0.0, 1.2, -1.8), Point3(0.6, 1.2, -1.2)}) {
      Scene scene = plate(metal(Rgb(0.8), roughness));
      constexpr double half = 0.15;
      add_polygon(scene, "lamp",
                  {centre + Vec3(-half, 0, -half), centre + Vec3(half, 0, -half),
                   centre + Vec3(half, 0, half), centre + Vec3(-half, 0, half)},
                  diffuse(0.0, pi));
      const Bsdf bsdf = bsdf_of(scene.materials[0]);
      const double lobe = lamp_in_lobe(bsdf, centre, half);
      const glm::vec3 shown = seen(scene, one_pixel(16));
      // The evenly spread light is the field's, within a tenth of it.
      const Direction out = to_local({0, 1, 0}, glm::normalize(eye));
      const double even = even_reflectance(bsdf, out).g * lamp_form_factor(centre, half);
      EXPECT_NEAR(shown.g, lobe + even, 0.04 * lobe + 0.1 * even) << roughness << ' ' << centre.x;
    }
}

TEST(Lobes, ALampInALobeByWayOfAMirror) {
  // The lamp faces away from the plate, towards a mirror above it,
  // whose image of it is the lamp of the test before.
  for (const double roughness : {0.15, 0.4}) {
    Scene scene = plate(metal(Rgb(0.8), roughness));
    const Point3 image(0.0, 1.2, -1.8);
    constexpr double height = 1.0, half = 0.15, rho = 0.9;
    const Point3 centre(image.x, 2.0 * height - image.y, image.z);
    add_polygon(scene, "lamp",
                {centre + Vec3(-half, 0, half), centre + Vec3(half, 0, half),
                 centre + Vec3(half, 0, -half), centre + Vec3(-half, 0, -half)},
                diffuse(0.0, pi));
    add_polygon(scene, "mirror",
                {{-1, height, -2.4}, {1, height, -2.4}, {1, height, -1.2}, {-1, height, -1.2}},
                mirror(rho));
    const Bsdf bsdf = bsdf_of(scene.materials[0]);
    const double lobe = rho * lamp_in_lobe(bsdf, image, half);
    const double even =
        rho * even_reflectance(bsdf, at_angle(glm::normalize(eye).y)).g * lamp_form_factor(image, half);
    EXPECT_NEAR(seen(scene, one_pixel(16)).g, lobe + even, 0.04 * lobe + 0.2 * even) << roughness;
  }
}

TEST(Lobes, APointLightShinesInALobe) {
  Scene scene = plate(metal(Rgb(0.8), 0.4));
  const Point3 at{0.3, 1.2, -1.4};
  scene.lights = {
      {.name = "bulb", .kind = PunctualKind::point, .intensity = Rgb(3.0), .position = at}};
  const Bsdf bsdf = bsdf_of(scene.materials[0]);
  const Direction normal{0, 1, 0};
  const Direction out = to_local(normal, glm::normalize(eye)),
                  in = to_local(normal, glm::normalize(at));
  const double irradiance = 3.0 / glm::dot(at, at) * in.z;
  const double exact =
      (reflection_lobe(bsdf, out, in).g + even_reflectance(bsdf, out).g / pi) * irradiance;
  RenderSettings settings = one_pixel(16);
  settings.diffuse.term = DiffuseTerm::direct;
  EXPECT_NEAR(seen(scene, settings).g, exact, 1e-3 * exact);
}

TEST(Lobes, ARoomOfWhiteGlossIsAFurnace) {
  // Every wall reflects 0.5, by whatever lobe, and glows with E = 1: L = (1 / pi) / (1 - 0.5).
  Material wall = metal(Rgb(0.5), 0.3);
  wall.emission = Rgb(1.0 / pi);
  const double reflectance = diffuse_reflectance(wall).g;
  Scene scene;
  std::array<Material, 6> walls;
  walls.fill(wall);
  add_room(scene, Point3(0.0), Point3(1.0), walls);
  // Lobes seen in lobes are sampled:
  // at 64 camera rays of 4 directions each the largest of 64 pixels is off by 0.006.
  RenderSettings settings = one_pixel(64);
  settings.width = settings.height = 8;
  const Image image =
      picture(lit_up(scene, coarse()), look_at({0.4, 0.5, 0.9}, {0.6, 0.4, 0.0}, 1.0), settings);
  // Towards some directions it reflects a little more than in the mean.
  for (const auto& pixel : image.pixels)
    EXPECT_NEAR(pixel.g, 1.0 / pi / (1.0 - reflectance), 0.01);
}

TEST(Lobes, ACoatedFloorShowsTheLampByFresnelAndKeepsTheRest) {
  // The lamp covers all that the smooth coat reflects; below it the floor has (1 - e) rho.
  const auto under_lamp = [](const Material& floor) {
    Scene scene = plate(floor, 1.0);
    add_polygon(scene, "lamp", {{-9, 4, -9}, {9, 4, -9}, {9, 4, 9}, {-9, 4, 9}}, diffuse(0.0, pi));
    return scene;
  };
  const double cosine = glm::normalize(eye).y;
  const double fresnel = 0.04 + 0.96 * std::pow(1.0 - cosine, 5.0);
  // From the centre of the floor the lamp fills all but its far edges:
  // F = 0.9 or so, which pass one finds, whatever the floor.
  const Camera camera = look_at(eye, Point3(0.0), 1e-4);
  const auto shown = [&](const Material& floor) {
    return picture(lit_up(under_lamp(floor), coarse()), camera, one_pixel(16)).pixels[0].g;
  };
  const double even = shown(plastic(0.6, 1.0)) / 0.6;
  EXPECT_NEAR(shown(plastic(0.6, 0.0)), fresnel * 1.0 + 0.6 * (1.0 - fresnel) * even, 1e-4);
}

TEST(Lobes, AMetalJustTooRoughIsNearlyTheMirror) {
  const auto room = [](double roughness) {
    Scene scene = plate(metal(Rgb(0.9), roughness));
    add_polygon(scene, "wall", {{-4, 0, -2}, {4, 0, -2}, {4, 4, -2}, {-4, 4, -2}},
                diffuse(0.0, pi));
    return scene;
  };
  const auto mirrored = seen(room(0.0), one_pixel(16));
  EXPECT_EQ(mirrored, seen(room(ideal_mirror_roughness), one_pixel(16)));
  EXPECT_NEAR(seen(room(0.0101), one_pixel(16)).g, mirrored.g, 1e-3);
}

} // namespace
} // namespace meninas::test
