// Rows that `view` sends are those of the library, and rows that it keeps give the solution that it would have without.
#include "runs/live/factor_rows.h"

#include "radiosity/queries/element_factors.h"
#include "raytrace/two_pass.h"
#include "runs/live/kept_rows.h"
#include "runs/walk/walk_room.h"
#include "scenes/errors.h"
#include "tests/runs/live/live_message.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace meninas {
namespace {

PassOneSettings uniform() {
  PassOneSettings settings;
  settings.mesh.element_size = 0.25;
  settings.form_factors.rays = 256;
  return settings;
}

float half_to_float(int bits) {
  const int exponent = bits >> 10;
  const auto fraction = static_cast<float>(bits & 1023);
  return exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024.0F + fraction, exponent - 25);
}

// Halves are off by 2^-11 of each number.
TEST(FactorRows, AreThoseOfTheLibrary) {
  const std::shared_ptr<const PreparedScene> prepared = prepare_scene(test::half_room_with_small_mirror(), uniform());
  const RadiositySolution solution = solve_pass_one(prepared->light(), uniform());
  const WalkRoom room = walk_room(solution.field);
  ASSERT_EQ(room.elements.size(), room.element_ends.size());
  const ShownMesh mesh{solution.field.scene, room.elements, uniform().form_factors, 7};
  FormFactorSettings settings = uniform().form_factors;
  settings.rays = rays_of_shown_row;
  FactorRows rows;
  std::size_t mirrored = 0, refused = 0;
  for (std::size_t k = 0; k < room.elements.size(); k += 101) {
    if (room.elements[k] == none<ElementId>)
      continue;
    const Message message = read(rows.row(mesh, k));
    EXPECT_EQ(message.head.at("room"), 7);
    ASSERT_EQ(message.bits.size(), 2 * room.elements.size());
    const double scale = message.head.at("scale");
    const ElementFactors own = element_factors(*solution.field.scene, room.elements[k], settings);
    std::vector<ElementFactor> by_element(element_count(solution.field.mesh()));
    for (const ElementFactor& factor : own.row)
      by_element[index(factor.to)] = factor;
    double sum = 0.0;
    for (std::size_t j = 0; j < room.elements.size(); ++j) {
      const ElementFactor exact = room.elements[j] == none<ElementId> ? ElementFactor{} : by_element[index(room.elements[j])];
      const double direct = scale * double{half_to_float(message.bits[2 * j])}, by_mirrors = scale * double{half_to_float(message.bits[2 * j + 1])};
      EXPECT_NEAR(direct, exact.direct, 0x1p-11 * exact.direct + 0x1p-25 * scale);
      EXPECT_NEAR(by_mirrors, exact.mirrored, 0x1p-11 * exact.mirrored + 0x1p-25 * scale);
      sum += direct + by_mirrors;
      mirrored += by_mirrors > 0.0 ? 1 : 0;
    }
    const auto head = [&](const char* name) { return message.head.at(name).get<double>(); };
    EXPECT_NEAR(sum, head("direct") + head("mirrored"), 0x1p-10);
    EXPECT_NEAR(sum + head("escaped") + head("absorbed") + head("black"), 1.0, 0x1p-9);
  }
  EXPECT_GT(mirrored, 0U) << "or else nothing is tested";
  EXPECT_THROW(static_cast<void>(rows.row(mesh, room.elements.size())), UsageError);
  for (std::size_t k = 0; k < room.elements.size(); ++k)
    if (room.elements[k] == none<ElementId>) {
      EXPECT_THROW(static_cast<void>(rows.row(mesh, k)), UsageError);
      ++refused;
    }
  EXPECT_GT(refused, 0U) << "the mirror has none";
}

Scene with_light(double reflectance, double emission) {
  Scene scene = test::half_room_with_small_mirror();
  for (Material& material : scene.materials) {
    if (material.emission != Rgb(0.0))
      material.emission *= emission;
    else if (!is_mirror(material))
      material.base_color *= reflectance;
  }
  return scene;
}

TEST(KeptRows, OfAnotherLightGiveTheSolutionOfARunWithoutThem) {
  KeptRows kept;
  const PassOneSettings settings = uniform();
  for (const auto& [reflectance, emission] : {std::pair{1.0, 1.0}, {0.7, 1.0}, {0.7, 3.0}}) {
    const auto prepared = prepare_scene(with_light(reflectance, emission), settings);
    EXPECT_EQ(are_of(kept, *prepared->light(), settings.form_factors), kept.key.has_value());
    const FormFactors& rows = rows_of(kept, *prepared->light(), settings.form_factors, {});
    const RadiositySolution by_kept = solve_pass_one(prepared->light(), rows, settings), alone = solve_pass_one(prepared->light(), settings);
    EXPECT_EQ(by_kept.radiosity, alone.radiosity);
    EXPECT_EQ(by_kept.irradiance, alone.irradiance);
    EXPECT_EQ(by_kept.field.irradiance, alone.field.irradiance);
  }
  Scene moved = with_light(1.0, 1.0);
  moved.vertices.front().position.x += 0.01;
  const auto prepared = prepare_scene(std::move(moved), settings);
  EXPECT_FALSE(are_of(kept, *prepared->light(), settings.form_factors));
  const auto same = prepare_scene(with_light(1.0, 1.0), settings);
  FormFactorSettings others = settings.form_factors;
  others.seed = 3;
  EXPECT_TRUE(are_of(kept, *same->light(), settings.form_factors));
  EXPECT_FALSE(are_of(kept, *same->light(), others));
}

} // namespace
} // namespace meninas
