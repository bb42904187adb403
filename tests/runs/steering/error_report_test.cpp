// What a run says to turn first, by the parts of its error.
#include "runs/steering/error_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace meninas::test {
namespace {

using testing::HasSubstr;
using testing::Optional;

TwoPassSettings settings_with(DiffuseTerm term) {
  TwoPassSettings settings;
  settings.render.diffuse.term = term;
  return settings;
}
const TwoPassSettings interpolated = settings_with(DiffuseTerm::interpolated),
                      direct = settings_with(DiffuseTerm::direct);

TEST(ClosingLine, SaysAboutOfANumberAlone) {
  EXPECT_EQ(describe_error({.mesh = 0.012, .pixels = 0.005, .total = 0.013}), "about 1.3 % off (mesh 1.2 %, camera rays 0.5 %)");
  EXPECT_EQ(describe_error({.mesh = 1.5, .total = 1.5}), "over 100 % off (mesh over 100 %)");
  EXPECT_EQ(describe_error({.total = 1e-6}), "under 0.01 % off");
}

TEST(FirstTurn, IsOfTheLargestPart) {
  EXPECT_THAT(suggest_option({.form_factors = 0.04, .pixels = 0.03, .total = 0.05}, interpolated),
              Optional(HasSubstr("--rays")));
  EXPECT_THAT(suggest_option({.form_factors = 0.03, .pixels = 0.04, .total = 0.05}, interpolated),
              Optional(HasSubstr("--samples")));
  EXPECT_THAT(suggest_option({.mirror_tail = 0.05, .total = 0.05}, interpolated),
              Optional(HasSubstr("--mirror-depth")));
  EXPECT_THAT(suggest_option({.solver = 0.05, .total = 0.05}, interpolated),
              Optional(HasSubstr("--tolerance")));
}

TEST(FirstTurn, TakesLightFromTheSourceWhereEdgesWithinElementsAreMostOfTheMesh) {
  const PictureError edges{.mesh = 0.1, .mesh_direct = 0.09, .total = 0.1},
      smooth{.mesh = 0.1, .mesh_direct = 0.05, .total = 0.1};
  EXPECT_THAT(suggest_option(edges, interpolated), Optional(HasSubstr("--diffuse direct")));
  EXPECT_THAT(suggest_option(smooth, interpolated), Optional(HasSubstr("more --elements")));
  EXPECT_THAT(suggest_option(edges, direct), Optional(HasSubstr("more --elements")));
}

TEST(FirstTurn, NamesTheOptionThatTheRunListensTo) {
  TwoPassSettings other = direct;
  other.pass_one.form_factors.method = FormFactorMethod::hemicube;
  EXPECT_THAT(suggest_option({.form_factors = 0.05, .total = 0.05}, other),
              Optional(HasSubstr("--hemicube-resolution")));
  TwoPassSettings sized = direct;
  sized.pass_one.mesh.element_size = 0.1;
  EXPECT_THAT(suggest_option({.mesh = 0.05, .total = 0.05}, sized),
              Optional(HasSubstr("a smaller --element-size")));
}

TEST(FirstTurn, IsNotAskedForWhereTheErrorIsHardToSee) {
  EXPECT_EQ(suggest_option({.mesh = 0.019, .total = 0.019}, interpolated), std::nullopt);
  EXPECT_NE(suggest_option({.mesh = 0.021, .total = 0.021}, interpolated), std::nullopt);
}

} // namespace
} // namespace meninas::test
