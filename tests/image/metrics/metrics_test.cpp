// Metrics against closed forms, laws of scale and symmetry, and sums written out a second time.
#include "image/display.h"
#include "image/metrics/metrics.h"
#include "image/metrics/ssim.h"
#include "tests/image/picture_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace meninas::test {
namespace {

Image mapped(Image picture, auto change) {
  for (auto& pixel : picture.pixels)
    pixel = change(pixel);
  return picture;
}

Image flat(int width, int height, float value) {
  return mapped(Image(width, height), [&](glm::vec3) { return glm::vec3(value); });
}

/// The same picture, half as bright again in one corner.
Image lit_corner(Image picture) {
  for (int y = 0; y < picture.height / 2; ++y)
    for (int x = 0; x < picture.width / 2; ++x)
      picture.at(x, y) *= 1.5F;
  return picture;
}

TEST(Metrics, IdenticalPicturesDoNotDiffer) {
  const Image picture = random_picture(31, 17);
  const auto difference = compare_pictures(picture, picture);
  for (const Metric metric :
       {Metric::rmse, Metric::relmse, Metric::mae, Metric::max_abs, Metric::flip})
    EXPECT_EQ(value_of(difference, metric), 0.0) << name_of(metric);
  EXPECT_EQ(difference.psnr, std::numeric_limits<double>::infinity());
  EXPECT_EQ(difference.ssim, 1.0);
  for (const float grey : {0.05F, 0.2F, 0.7F, 1.0F})
    EXPECT_EQ(compare_pictures(flat(16, 16, grey), flat(16, 16, grey)).ssim, 1.0) << grey;
  for (const Metric metric : {Metric::rmse, Metric::relmse, Metric::mae, Metric::max_abs})
    for (const float value : error_map(difference, metric, picture, picture).values)
      EXPECT_EQ(value, 0.0F);
}

TEST(Metrics, AConstantDifference) {
  // Values and difference are multiples of 1/8: nothing is rounded.
  const Image reference =
      mapped(random_picture(20, 30), [](glm::vec3 p) { return glm::round(8.0F * p) / 8.0F; });
  const Image picture = mapped(reference, [](glm::vec3 p) { return p + 0.125F; });
  const auto difference = compare_pictures(picture, reference, {.peak = 4.0});
  EXPECT_DOUBLE_EQ(difference.rmse, 0.125);
  EXPECT_DOUBLE_EQ(difference.mae, 0.125);
  EXPECT_DOUBLE_EQ(difference.max_abs, 0.125);
  EXPECT_DOUBLE_EQ(difference.psnr, 20.0 * std::log10(4.0 / 0.125));
  EXPECT_EQ(difference.width, 20);
  EXPECT_EQ(difference.height, 30);
}

TEST(Metrics, OneChannelOfOnePixel) {
  const Image reference = flat(5, 4, 2.0F);
  Image picture = reference;
  picture.at(3, 1).g = 2.5F;
  const auto difference = compare_pictures(picture, reference, {.relmse_epsilon = 1.0});
  EXPECT_DOUBLE_EQ(difference.rmse, std::sqrt(0.25 / 60.0));
  EXPECT_DOUBLE_EQ(difference.mae, 0.5 / 60.0);
  EXPECT_DOUBLE_EQ(difference.relmse, 0.25 / (4.0 + 1.0) / 60.0);
  EXPECT_DOUBLE_EQ(difference.max_abs, 0.5);
  EXPECT_DOUBLE_EQ(difference.psnr, 20.0 * std::log10(2.0 / std::sqrt(0.25 / 60.0)));
  EXPECT_EQ(difference.worst, glm::ivec2(3, 1));
  const auto at = [&](Metric metric) {
    return error_map(difference, metric, picture, reference, {.relmse_epsilon = 1.0}).at(3, 1);
  };
  EXPECT_FLOAT_EQ(at(Metric::rmse), std::sqrt(0.25F / 3.0F));
  EXPECT_FLOAT_EQ(at(Metric::relmse), 0.05F / 3.0F);
  EXPECT_FLOAT_EQ(at(Metric::mae), 0.5F / 3.0F);
  EXPECT_FLOAT_EQ(at(Metric::max_abs), 0.5F);
}

TEST(Metrics, ARelativeDifferenceOfBrightPictures) {
  const Image reference = mapped(random_picture(16, 16), [](glm::vec3 p) { return 1e6F * p; });
  const Image picture = mapped(reference, [](glm::vec3 p) { return 1.25F * p; });
  EXPECT_NEAR(compare_pictures(picture, reference).relmse, 0.0625, 1e-7);
}

TEST(Metrics, AllButRelmseAndPsnrAreSymmetric) {
  const Image a = random_picture(24, 16, 1), b = random_picture(24, 16, 2);
  const MetricSettings settings{.exposure = -2.0};
  const auto ab = compare_pictures(a, b, settings), ba = compare_pictures(b, a, settings);
  for (const Metric metric : {Metric::rmse, Metric::mae, Metric::max_abs, Metric::flip})
    EXPECT_EQ(value_of(ab, metric), value_of(ba, metric)) << name_of(metric);
  EXPECT_NEAR(ab.ssim, ba.ssim, 1e-12); // sums in another order
  EXPECT_NE(ab.relmse, ba.relmse);
}

TEST(Metrics, BrighterPicturesDifferAsMuchMore) {
  // Powers of two scale floats exactly;
  // exposure and epsilon follow the light, so what is seen stays the same.
  const Image reference = random_picture(24, 16);
  const Image picture = lit_corner(reference);
  const auto times8 = [](glm::vec3 p) { return 8.0F * p; };
  const auto dim = compare_pictures(picture, reference);
  const auto bright = compare_pictures(mapped(picture, times8), mapped(reference, times8),
                                       {.exposure = -3.0, .relmse_epsilon = 0.64});
  EXPECT_DOUBLE_EQ(bright.rmse, 8.0 * dim.rmse);
  EXPECT_DOUBLE_EQ(bright.mae, 8.0 * dim.mae);
  EXPECT_DOUBLE_EQ(bright.max_abs, 8.0 * dim.max_abs);
  EXPECT_NEAR(bright.relmse, dim.relmse, 1e-12); // 0.64 is no power of two times 0.01
  EXPECT_NEAR(bright.psnr, dim.psnr, 1e-9);
  EXPECT_EQ(bright.ssim, dim.ssim);
  EXPECT_EQ(bright.flip, dim.flip);
  EXPECT_EQ(bright.worst, dim.worst);
}

TEST(Metrics, DifferencesAddUpOverTiles) {
  const Image reference = random_picture(8, 12);
  const Image picture = lit_corner(reference);
  Image wide_picture(16, 12), wide_reference(16, 12);
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 16; ++x) {
      wide_picture.at(x, y) = picture.at(x % 8, y);
      wide_reference.at(x, y) = reference.at(x % 8, y);
    }
  const auto one = compare_pictures(picture, reference);
  const auto two = compare_pictures(wide_picture, wide_reference);
  EXPECT_NEAR(two.rmse, one.rmse, 1e-12 * one.rmse);
  EXPECT_NEAR(two.relmse, one.relmse, 1e-12 * one.relmse);
  EXPECT_NEAR(two.mae, one.mae, 1e-12 * one.mae);
  EXPECT_EQ(two.worst, one.worst);
}

TEST(Metrics, ExtremeValuesStayFinite) {
  const float largest = std::numeric_limits<float>::max();
  Image picture = flat(12, 12, largest), reference = flat(12, 12, -largest);
  const auto far = compare_pictures(picture, reference);
  for (const Metric metric : all_metrics)
    EXPECT_TRUE(std::isfinite(value_of(far, metric)) || metric == Metric::psnr) << name_of(metric);
  const auto dark = compare_pictures(flat(1, 1, 1e-30F), flat(1, 1, 0.0F));
  EXPECT_NEAR(dark.rmse, 1e-30, 1e-37);
  EXPECT_GT(dark.relmse, 0.0);
}

TEST(Metrics, SimilarityOfFlatGreys) {
  // No variance: only luminance is compared, (2 a b + C1) / (a^2 + b^2 + C1) of the encoded greys.
  const double a = srgb_encode(0.2F), b = srgb_encode(0.6F), c1 = 1e-4;
  const auto difference = compare_pictures(flat(16, 16, 0.2F), flat(16, 16, 0.6F));
  EXPECT_NEAR(difference.ssim, (2.0 * a * b + c1) / (a * a + b * b + c1),
              1e-4); // variances are differences of floats: 1e-7 / C2
}

TEST(Metrics, SimilarityIsTheSumOfThePaper) {
  // One window summed in two dimensions, variances as means of squared deviations.
  const Image a = random_picture(11, 11, 3), b = random_picture(11, 11, 4);
  const auto grey = [](const glm::vec3& p) {
    const glm::vec3 q = glm::clamp(p, 0.0F, 1.0F);
    return static_cast<double>(srgb_encode(0.2126F * q.r + 0.7152F * q.g + 0.0722F * q.b));
  };
  double weights = 0.0, mean_a = 0.0, mean_b = 0.0, var_a = 0.0, var_b = 0.0, cov = 0.0;
  const auto sum = [&](auto add) {
    for (int y = 0; y < 11; ++y)
      for (int x = 0; x < 11; ++x)
        add(std::exp(-((x - 5) * (x - 5) + (y - 5) * (y - 5)) / (2.0 * 1.5 * 1.5)),
            grey(a.at(x, y)), grey(b.at(x, y)));
  };
  sum([&](double w, double, double) { weights += w; });
  sum([&](double w, double va, double vb) {
    mean_a += w * va / weights;
    mean_b += w * vb / weights;
  });
  sum([&](double w, double va, double vb) {
    var_a += w * (va - mean_a) * (va - mean_a) / weights;
    var_b += w * (vb - mean_b) * (vb - mean_b) / weights;
    cov += w * (va - mean_a) * (vb - mean_b) / weights;
  });
  const double expected = (2.0 * mean_a * mean_b + 1e-4) * (2.0 * cov + 9e-4) /
                          ((mean_a * mean_a + mean_b * mean_b + 1e-4) * (var_a + var_b + 9e-4));
  EXPECT_NEAR(ssim_map(a, b).at(5, 5), expected, 1e-5);
  EXPECT_NEAR(compare_pictures(a, b).ssim, expected, 1e-5); // the only window inside
}

TEST(Metrics, BadPixelsAreNamed) {
  Image picture(4, 3);
  EXPECT_EQ(first_bad_pixel(picture), std::nullopt);
  picture.at(2, 1).b = std::numeric_limits<float>::infinity();
  EXPECT_EQ(first_bad_pixel(picture), "pixel (2, 1) is infinite");
  picture.at(3, 0).r = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(first_bad_pixel(picture), "pixel (3, 0) is NaN");
}

} // namespace
} // namespace meninas::test
