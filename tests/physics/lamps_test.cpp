// Lamps apart: radiosity is linear in its lamps, so what each sends, found once, gives every state of all.
#include "radiosity/relight.h"
#include "radiosity/solution/lamp_codes.h"
#include "raytrace/two_pass.h"
#include "scenes/lamps.h"
#include "tests/support/random.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

PassOneSettings settings_of(MeshCut cut, std::optional<LampGrouping> lamps = LampGrouping::node) {
  PassOneChoice choice;
  choice.elements = 1200;
  choice.mesh = cut;
  choice.rays = 256;
  choice.lamps = lamps;
  return pass_one_settings(choice);
}

/// A room with a mirror on a wall, a box, a white lamp under the ceiling, a blue one on a wall, and a
/// small bright point.
Scene room_of_three_lamps() {
  Scene scene;
  const Material grey = diffuse(0.6), red = diffuse(Rgb(0.7, 0.2, 0.1));
  add_room(scene, Point3(0.0), Point3(3.0, 2.4, 2.0), {grey, red, grey, grey, grey, grey});
  add_box(scene, "box", Point3(1.0, 0.0, 0.8), Point3(1.6, 0.7, 1.4), diffuse(0.5));
  add_polygon(scene, "mirror",
              {{0.5, 0.4, 0.001}, {2.5, 0.4, 0.001}, {2.5, 2.0, 0.001}, {0.5, 2.0, 0.001}},
              mirror(0.9));
  add_polygon(scene, "ceiling lamp",
              {{1.2, 2.39, 0.8}, {1.8, 2.39, 0.8}, {1.8, 2.39, 1.2}, {1.2, 2.39, 1.2}},
              diffuse(0.0, 30.0));
  add_polygon(scene, "wall lamp",
              {{0.01, 1.0, 1.0}, {0.01, 1.4, 1.0}, {0.01, 1.4, 1.5}, {0.01, 1.0, 1.5}},
              diffuse(Rgb(0.0), Rgb(5.0, 10.0, 40.0)));
  scene.lights.push_back({.name = "point", .intensity = Rgb(2.0), .position = {2.5, 1.0, 1.5}});
  return scene;
}

RadiositySolution solved(const PreparedScene& prepared, const PassOneSettings& settings) {
  return solve_pass_one(prepared.light(), settings);
}

double mean_of(const std::vector<glm::vec3>& values) {
  double sum = 0.0;
  for (const glm::vec3& value : values)
    sum += double{value.r} + double{value.g} + double{value.b};
  return sum / double(3 * values.size());
}

class Lamps : public testing::TestWithParam<MeshCut> {};

TEST_P(Lamps, AddUpToTheOrdinarySolutionWhichTheyLeaveAsItIs) {
  const auto apart = prepare_scene(room_of_three_lamps(), settings_of(GetParam()));
  const auto together =
      prepare_scene(room_of_three_lamps(), settings_of(GetParam(), std::nullopt));
  const RadiositySolution by_lamp = solved(*apart, settings_of(GetParam())),
                          ordinary = solved(*together, settings_of(GetParam(), std::nullopt));
  ASSERT_EQ(by_lamp.field.by_lamp.size(), 3U);
  EXPECT_EQ(by_lamp.field.irradiance, ordinary.field.irradiance); // to the last bit
  EXPECT_EQ(by_lamp.field.indirect, ordinary.field.indirect);
  for (std::size_t v = 0; v < ordinary.field.irradiance.size(); ++v) {
    glm::vec3 sum(0.0F);
    for (const auto& [direct, indirect] : by_lamp.field.by_lamp) {
      EXPECT_GE(std::min({direct[v].r, direct[v].g, direct[v].b}), 0.0F);
      EXPECT_GE(std::min({indirect[v].r, indirect[v].g, indirect[v].b}), 0.0F);
      sum += direct[v] + indirect[v];
    }
    for (int band = 0; band < 3; ++band) // the parts are floats, of which there are six
      EXPECT_NEAR(sum[band], ordinary.field.irradiance[v][band],
                  1e-5F * ordinary.field.irradiance[v][band]);
  }
}

/// Root mean square of the difference of two fields on one mesh, relative to their mean.
double difference(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  double squares = 0.0;
  for (std::size_t v = 0; v < a.size(); ++v)
    for (int band = 0; band < 3; ++band)
      squares += std::pow(double{a[v][band]} - double{b[v][band]}, 2.0);
  return std::sqrt(squares / double(3 * a.size())) / mean_of(b);
}

// The mesh and the cut of all lamps differ from those of one alone, and samples fall elsewhere: the
// bound is what two such solutions of one scene differ by.
TEST_P(Lamps, AloneAreTheSceneWithoutTheOthers) {
  PassOneSettings settings = settings_of(GetParam());
  settings.interpolation.shadow_bend = 0.0; // so that the meshes are one
  const Scene scene = room_of_three_lamps();
  const auto apart = prepare_scene(scene, settings);
  const RadiositySolution solution = solved(*apart, settings);
  const LampGroups lamps = find_lamps(scene, LampGrouping::node);
  for (std::size_t l = 0; l < lamps.size(); ++l) {
    SCOPED_TRACE(lamps.names[l]);
    std::vector<Rgb> factors(lamps.size(), Rgb(0.0));
    factors[l] = Rgb(1.0);
    const auto alone = prepare_scene(relit(scene, lamps, factors), settings);
    const RadiositySolution truth = solved(*alone, settings);
    const IrradianceField found = relit(solution.field, factors);
    ASSERT_EQ(found.irradiance.size(), truth.field.irradiance.size());
    EXPECT_NEAR(mean_of(found.irradiance), mean_of(truth.field.irradiance),
                0.01 * mean_of(truth.field.irradiance));
    EXPECT_LT(difference(found.indirect, truth.field.indirect), 0.03);
    EXPECT_LT(difference(found.irradiance, truth.field.irradiance), 0.05);
  }
}

INSTANTIATE_TEST_SUITE_P(OfBothCuts, Lamps,
                         testing::Values(MeshCut::uniform, MeshCut::hierarchical),
                         [](const auto& one) { return name_of(one.param); });

RenderSettings small_picture() {
  RenderSettings settings;
  settings.width = settings.height = 24;
  settings.samples = 16;
  settings.diffuse.term = DiffuseTerm::direct;
  return settings;
}

class RelitPictures : public testing::Test {
protected:
  RelitPictures()
      : settings_(settings_of(MeshCut::hierarchical)),
        prepared_(prepare_scene(room_of_three_lamps(), settings_)),
        solution_(solved(*prepared_, settings_)) {}

  Image picture(const IrradianceField& field) const {
    return render(field, look_at({2.8, 1.6, 1.8}, {0.8, 0.8, 0.3}, 1.0), small_picture()).image;
  }
  Image relit_picture(const std::vector<Rgb>& factors) const {
    return picture(relit(solution_.field, factors));
  }

  PassOneSettings settings_;
  std::shared_ptr<const PreparedScene> prepared_;
  RadiositySolution solution_;
};

TEST_F(RelitPictures, AreThePictureWhereAllFactorsAreOne) {
  EXPECT_EQ(relit_picture(std::vector<Rgb>(3, Rgb(1.0))).pixels, picture(solution_.field).pixels);
}

TEST_F(RelitPictures, AreTwiceAsBrightUnderTwiceTheLight) {
  const Image once = picture(solution_.field), twice = relit_picture(std::vector<Rgb>(3, Rgb(2.0)));
  for (std::size_t k = 0; k < once.pixels.size(); ++k)
    EXPECT_EQ(twice.pixels[k], 2.0F * once.pixels[k]); // powers of two are exact
}

TEST_F(RelitPictures, AreBlackWithoutLight) {
  for (const glm::vec3& pixel : relit_picture(std::vector<Rgb>(3, Rgb(0.0))).pixels)
    EXPECT_EQ(pixel, glm::vec3(0.0F));
}

TEST_F(RelitPictures, HaveChannelsOfTheirOwn) {
  const Image red = relit_picture({Rgb(1.0, 0.0, 0.0), Rgb(1.0, 0.0, 0.0), Rgb(1.0, 0.0, 0.0)});
  double sum = 0.0;
  for (const glm::vec3& pixel : red.pixels) {
    EXPECT_EQ(pixel.g, 0.0F);
    EXPECT_EQ(pixel.b, 0.0F);
    sum += double{pixel.r};
  }
  EXPECT_GT(sum, 0.0);
}

// The mirror room is half of the doubled room, of which the lamp has an image: the two halves of that
// lamp have one name, and so are one lamp.
TEST(LampsInMirrors, AreThoseOfTheDoubledRoom) {
  Scene half = half_room();
  add_polygon(half, "second", {{1.99, 1.0, 1.0}, {1.99, 1.0, 1.4}, {1.99, 1.4, 1.4}, {1.99, 1.4, 1.0}},
              diffuse(0.0, 10.0));
  Scene whole = doubled(half);
  for (Node& node : whole.nodes)
    if (node.name == "second" || node.name == "second.image")
      node.lamp = "second";
  PassOneSettings settings = settings_of(MeshCut::hierarchical);
  settings.mesh.element_size = 0.2;
  const auto light_of_second = [&](const Scene& scene) {
    const auto prepared = prepare_scene(scene, settings);
    const RadiositySolution solution = solved(*prepared, settings);
    const auto& names = solution.field.scene->lamp_groups->names;
    std::vector<Rgb> factors(names.size(), Rgb(0.0));
    factors[static_cast<std::size_t>(std::ranges::find(names, "second") - names.begin())] = Rgb(1.0);
    const IrradianceField field = relit(solution.field, factors);
    std::vector<glm::vec3> means;
    const ElementMesh& mesh = field.mesh();
    for (std::uint32_t n = 0; n < scene.nodes.size(); ++n) {
      glm::dvec3 sum(0.0);
      double area = 0.0;
      for (std::size_t e = 0; e < element_count(mesh); ++e) {
        if (mesh.sides[index(mesh.side_of_element[e])].node != NodeId{n})
          continue;
        area += mesh.area[e];
        for (const ElementVertexId v : mesh.corners[e])
          sum += 0.25 * mesh.area[e] * glm::dvec3(field.irradiance[index(v)]);
      }
      if (scene.nodes[n].name.find(".image") == std::string::npos && area > 0.0)
        means.emplace_back(sum / area);
    }
    return means;
  };
  const auto mirrored = light_of_second(half), truth = light_of_second(whole);
  ASSERT_LE(truth.size(), mirrored.size()); // there is no mirror in it
  EXPECT_GT(mean_of(truth), 0.0);
  EXPECT_NEAR(mean_of(std::vector(mirrored.begin(), mirrored.begin() + 5)),
              mean_of(std::vector(truth.begin(), truth.begin() + 5)), 0.02 * mean_of(truth));
}

TEST(LampGroups, HaveTheNamesThatNodesOrTheirExtrasSay) {
  Scene scene = room_of_three_lamps();
  EXPECT_EQ(find_lamps(scene, LampGrouping::node).names,
            (std::vector<std::string>{"ceiling lamp", "wall lamp", "point"}));
  for (Node& node : scene.nodes)
    if (node.name == "wall lamp")
      node.lamp = "evening";
  scene.lights[0].lamp = "evening";
  scene.background = Rgb(1.0);
  EXPECT_EQ(find_lamps(scene, LampGrouping::node).names,
            (std::vector<std::string>{"ceiling lamp", "evening", "sky"}));
}

TEST(LampCodes, KeepLightToAFewHundredThousandths) {
  Random random(53);
  VertexLightOfLamp light;
  for (int k = 0; k < 1000; ++k)
    for (auto* values : {&light.direct, &light.indirect})
      values->emplace_back(std::exp(random.between(-12.0, 6.0)) *
                           random.in_box(Vec3(0.0), Vec3(1.0)));
  light.direct[7] = glm::vec3(0.0F);
  const LampCodes codes = encoded(light);
  EXPECT_EQ(codes.bytes.size(), 12U * light.direct.size());
  const VertexLightOfLamp found = decoded(codes.top, codes.bytes);
  EXPECT_EQ(found.direct[7], glm::vec3(0.0F));
  for (std::size_t k = 0; k < light.direct.size(); ++k)
    for (int band = 0; band < 3; ++band) {
      const float most = std::max({light.direct[k].r, light.direct[k].g, light.direct[k].b});
      // Half a step of a mantissa of 14 bits, of which the brightest channel has the first at least.
      EXPECT_NEAR(found.direct[k][band], light.direct[k][band], most / 16383.0F);
    }
}

} // namespace
} // namespace meninas::test
