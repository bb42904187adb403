#include "image/view_transform.h"

#include "image/display.h"
#include "image/image_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace meninas {
namespace {

using glm::dvec3;

double distance(const dvec3& a, const dvec3& b) { return glm::length(a - b); }

// The specification of the PBR Neutral Tone Mapper: f is what a dielectric reflects, 4 %, and less
// for dark colours; up to 0.8 nothing else happens.
TEST(ViewTransform, NeutralKeepsColoursBelowItsShoulder) {
  EXPECT_EQ(displayed(ViewTransform::neutral, dvec3(0.0)), dvec3(0.0));
  EXPECT_LT(distance(displayed(ViewTransform::neutral, {0.5, 0.3, 0.2}), {0.46, 0.26, 0.16}),
            1e-12);
  // x < 0.08: x - (x - 6.25 x^2) = 6.25 x^2.
  EXPECT_LT(distance(displayed(ViewTransform::neutral, dvec3(0.04)), dvec3(0.01)), 1e-12);
  EXPECT_LT(distance(displayed(ViewTransform::neutral, dvec3(0.799)), dvec3(0.759)), 1e-12);
}

// 1 - 0.24^2 / (1.96 - 0.04 + 0.24 - 0.76) of the grey 1.96, worked by hand.
TEST(ViewTransform, NeutralCompressesWhatIsBrighter) {
  const double shown = 1.0 - 0.0576 / 1.4;
  EXPECT_LT(distance(displayed(ViewTransform::neutral, dvec3(1.96)), dvec3(shown)), 1e-12);
}

// (2, 0.54, 0.54) less 0.04 has the peak 1.96, which becomes 1 - 0.0576 / 1.44 = 0.96, one less; so
// much of the way, 1 - 1 / 1.15, the colour pales.
TEST(ViewTransform, NeutralPalesTowardsThePeak) {
  const double pale = 1.0 - 1.0 / 1.15, other = 0.5 * 0.96 / 1.96;
  const double shown = (1.0 - pale) * other + pale * 0.96;
  EXPECT_LT(distance(displayed(ViewTransform::neutral, {2.0, 0.54, 0.54}), {0.96, shown, shown}),
            1e-12);
}

// Middle grey, 0.18, is where the range of 16.5 stops says: sigmoid(10 / 16.5)^2.2 by the
// polynomial, half of the display's range of codes; the matrices keep greys to 1e-3.
TEST(ViewTransform, AgxShowsMiddleGreyAtHalfOfTheCodes) {
  const double x = 10.0 / 16.5;
  const double y = 15.5 * std::pow(x, 6) - 40.14 * std::pow(x, 5) + 31.96 * std::pow(x, 4) -
                   6.868 * std::pow(x, 3) + 0.4298 * x * x + 0.1191 * x - 0.00232;
  const dvec3 grey = displayed(ViewTransform::agx, dvec3(0.18));
  EXPECT_LT(distance(grey, dvec3(std::pow(y, 2.2))), 2e-3);
  EXPECT_NEAR(std::pow(grey.g, 1.0 / 2.2), 0.5, 0.01);
}

TEST(ViewTransform, AllAreMonotonicInGreysAndStayWithinTheDisplay) {
  for (const ViewTransform transform : view_transforms) {
    double before = -1.0;
    for (double stops = -16.0; stops <= 16.0; stops += 0.125) {
      const dvec3 shown = displayed(transform, dvec3(std::exp2(stops)));
      EXPECT_GE(shown.g, before - 1e-4) << name_of(transform) << " at " << stops;
      EXPECT_LE(std::max({shown.r, shown.g, shown.b}) - std::min({shown.r, shown.g, shown.b}), 5e-3);
      before = shown.g;
    }
    EXPECT_GT(before, 0.97);
    for (const dvec3& extreme : {dvec3(1e300, 0.0, 0.0), dvec3(-1.0), dvec3(0.0, 1e-300, 5.0)})
      for (int c = 0; c < 3; ++c) {
        EXPECT_GE(displayed(transform, extreme)[c], 0.0);
        EXPECT_LE(displayed(transform, extreme)[c], 1.0);
      }
  }
}

/// The hue of a colour as the place of its middle channel between the others, 0 to 1.
double hue(const dvec3& c) {
  const double low = std::min({c.r, c.g, c.b}), high = std::max({c.r, c.g, c.b});
  return (c.r + c.g + c.b - 2.0 * low - high) / (high - low);
}

// An orange light two stops brighter: clipped it is yellow.
TEST(ViewTransform, NeutralKeepsTheHueOfBrightLamps) {
  const dvec3 dim(0.6, 0.3, 0.1), bright = 4.0 * dim;
  const double asked = hue(displayed(ViewTransform::neutral, dim));
  EXPECT_NEAR(hue(displayed(ViewTransform::neutral, bright)), asked, 0.02);
  EXPECT_GT(std::abs(hue(displayed(ViewTransform::srgb, bright)) - asked), 0.3);
}

// The name stands in the file as a chunk of text, and the pixels are read as they are.
TEST(ViewTransform, IsNamedInTheFile) {
  Image picture(2, 1);
  picture.at(0, 0) = glm::vec3(0.5F, 0.3F, 0.2F);
  picture.at(1, 0) = glm::vec3(4.0F);
  for (const ViewTransform transform : view_transforms) {
    const auto png = encode_png(picture, {.transform = transform});
    const std::string bytes(reinterpret_cast<const char*>(png.data()), png.size());
    const std::string text =
        std::string("tEXtView transform") + '\0' + std::string(title_of(transform));
    EXPECT_EQ(bytes.find(text) != std::string::npos, transform != ViewTransform::srgb);
    const Bitmap read = decode_image(png, Encoding::linear, "a.png");
    const auto codes = display_codes(picture, 0.0, transform);
    for (std::size_t k = 0; k < codes.size(); ++k)
      EXPECT_FLOAT_EQ(read.pixels[k / 3][static_cast<int>(k % 3)],
                      static_cast<float>(codes[k]) / 255.0F);
  }
}

} // namespace
} // namespace meninas
