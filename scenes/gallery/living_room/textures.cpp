#include "scenes/gallery/living_room/textures.h"

#include "scenes/gallery/living_room/smooth_shapes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace meninas::gallery {
namespace {

using Colour = std::array<double, 3>; ///< sRGB from 0 to 255
constexpr double turn = 2.0 * std::numbers::pi;

/// Random values at whole coordinates, bilinear between them, with period `nx` x `ny`.
double noise(double x, double y, int nx, int ny, std::uint64_t seed) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto value = [&](int i, int j) {
    const int a = ((static_cast<int>(fx) + i) % nx + nx) % nx;
    const int b = ((static_cast<int>(fy) + j) % ny + ny) % ny;
    return chance(seed * 1000003U + static_cast<std::uint64_t>(b * nx + a));
  };
  const auto ease = [](double t) { return t * t * (3.0 - 2.0 * t); };
  const double s = ease(x - fx), t = ease(y - fy);
  return std::lerp(std::lerp(value(0, 0), value(1, 0), s), std::lerp(value(0, 1), value(1, 1), s),
                   t);
}

/// A picture whose colours lie on ramps between two colours, 256 / ramps steps each.
struct Shade {
  int ramp;
  double at; ///< 0 to 1
};
Picture picture(const std::string& name, int width, int height,
                const std::vector<std::array<Colour, 2>>& ramps,
                const std::function<Shade(double, double)>& shade) {
  Picture result{name, width, height, {}, {}};
  const int steps = 256 / static_cast<int>(ramps.size());
  for (const auto& [dark, light] : ramps)
    for (int k = 0; k < steps; ++k) {
      std::array<std::uint8_t, 4> colour{0, 0, 0, 255};
      for (std::size_t c = 0; c < 3; ++c)
        colour[c] = static_cast<std::uint8_t>(
            std::lround(std::lerp(dark[c], light[c], static_cast<double>(k) / (steps - 1))));
      result.palette.push_back(colour);
    }
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Shade at = shade((x + 0.5) / width, (y + 0.5) / height);
      const auto step = std::lround(std::clamp(at.at, 0.0, 1.0) * (steps - 1));
      result.texels.push_back(static_cast<std::uint8_t>(at.ramp * steps + step));
    }
  return result;
}

/// Growth rings cut lengthwise: bands across, drawn out along.
double grain(double along, double across, std::uint64_t seed) {
  const double drift = noise(4.0 * along, 6.0 * across, 4, 6, seed);
  const double rings = 0.5 + 0.5 * std::sin(turn * (9.0 * across + 2.5 * drift));
  const double fibre = noise(16.0 * along, 128.0 * across, 16, 128, seed + 1);
  return 0.35 * rings + 0.4 * fibre + 0.25 * drift;
}

} // namespace

Picture planks() {
  return picture("planks", 512, 512, {{{{92, 64, 42}, {186, 142, 98}}}}, [](double u, double v) {
    const int board = static_cast<int>(8.0 * u);
    const double across = 8.0 * u - board;
    const auto seed = static_cast<std::uint64_t>(board);
    const double along = v + chance(seed + 70);
    const int piece = static_cast<int>(2.0 * along) % 2;
    const double end = std::abs(std::remainder(2.0 * along, 1.0));
    if (across < 0.016 || end < 0.004)
      return Shade{0, 0.0};
    const auto own = 2 * seed + static_cast<std::uint64_t>(piece);
    return Shade{0, 0.15 + 0.35 * chance(own + 300) + 0.5 * grain(v, across, 10 * own + 20)};
  });
}

Picture wood_grain() {
  return picture("wood", 256, 128, {{{{84, 50, 30}, {160, 108, 66}}}}, [](double u, double v) {
    return Shade{0, grain(u, v, 900)};
  });
}

Picture weave() {
  return picture("weave", 64, 64, {{{{206, 206, 206}, {255, 255, 255}}}}, [](double u, double v) {
    const double a = std::sin(turn * 16.0 * u), b = std::sin(turn * 16.0 * v);
    return Shade{0, 0.55 + 0.3 * a * b + 0.25 * (noise(32.0 * u, 32.0 * v, 32, 32, 5) - 0.5)};
  });
}

Picture carpet() {
  const std::vector<std::array<Colour, 2>> ramps{{{{128, 36, 34}, {166, 58, 48}}},
                                                 {{{34, 44, 74}, {58, 72, 108}}},
                                                 {{{196, 178, 142}, {228, 212, 178}}},
                                                 {{{168, 120, 58}, {204, 156, 86}}}};
  return picture("carpet", 512, 256, ramps, [](double u, double v) {
    const double x = 2.7 * (u - 0.5), y = 1.9 * (v - 0.5); // metres from its middle
    const double rim = std::min(1.35 - std::abs(x), 0.95 - std::abs(y));
    const double wool = 0.5 + 0.35 * std::sin(turn * 256.0 * v) +
                        0.5 * (noise(256.0 * u, 256.0 * v, 256, 256, 3) - 0.5);
    const double r = std::hypot(x, 1.25 * y), angle = std::atan2(1.25 * y, x);
    const double star = 0.42 + 0.09 * std::cos(8.0 * angle);
    const double flowers = std::sin(14.0 * x) * std::sin(14.0 * y);
    int ramp = 0;
    if (rim < 0.04)
      ramp = 1;
    else if (rim < 0.06 || (rim > 0.22 && rim < 0.24))
      ramp = 2;
    else if (rim < 0.22)
      ramp = std::abs(std::sin(12.0 * (x + y)) * std::sin(12.0 * (x - y))) > 0.5 ? 3 : 1;
    else if (r < star)
      ramp = r < 0.5 * star ? (r < 0.3 * star ? 2 : 0) : (r > 0.92 * star ? 2 : 1);
    else if (flowers > 0.75)
      ramp = flowers > 0.92 ? 2 : 3;
    else if (flowers < -0.85)
      ramp = 1;
    return Shade{ramp, wool};
  });
}

Picture painting() {
  const std::vector<std::array<Colour, 2>> ramps{{{{236, 170, 110}, {96, 132, 176}}},
                                                 {{{70, 92, 104}, {128, 140, 140}}},
                                                 {{{44, 66, 50}, {96, 118, 70}}},
                                                 {{{244, 214, 150}, {255, 240, 206}}}};
  return picture("painting", 256, 256, ramps, [](double u, double v) {
    const double stroke = noise(64.0 * u, 24.0 * v, 64, 24, 8) - 0.5;
    const double far =
        0.52 + 0.06 * std::sin(turn * 1.3 * u + 1.0) + 0.02 * std::sin(turn * 5.0 * u);
    const double near = 0.70 - 0.08 * std::sin(turn * 0.8 * u) + 0.015 * std::sin(turn * 7.0 * u);
    if (v > near)
      return Shade{2, 0.9 - 1.6 * (v - near) + 0.7 * stroke};
    if (v > far)
      return Shade{1, 0.8 - 2.5 * (v - far) + 0.4 * stroke};
    if (std::hypot(u - 0.68, v - 0.34) < 0.07)
      return Shade{3, 0.6 + stroke};
    return Shade{0, 1.0 - 1.7 * v + 0.35 * stroke};
  });
}

Picture book_backs() {
  // Cloth of six colours, and gold.
  const std::vector<std::array<Colour, 2>> ramps{
      {{{92, 34, 30}, {142, 58, 46}}},  {{{34, 50, 66}, {66, 92, 116}}},
      {{{48, 66, 46}, {86, 110, 74}}},  {{{176, 158, 124}, {226, 212, 182}}},
      {{{64, 46, 36}, {110, 82, 60}}},  {{{150, 104, 46}, {196, 144, 74}}},
      {{{74, 54, 78}, {120, 92, 122}}}, {{{196, 160, 84}, {232, 204, 132}}}};
  return picture("books", 512, 256, ramps, [](double u, double v) {
    const int design = static_cast<int>(book_designs * u);
    const auto seed = static_cast<std::uint64_t>(design);
    const double x = book_designs * u - design;
    const int cloth = static_cast<int>(7.0 * chance(seed + 40));
    const double first = 0.06 + 0.1 * chance(seed + 80), width = 0.012 + 0.02 * chance(seed + 120);
    const bool gold = std::abs(v - first) < width || std::abs(v - 1.0 + first) < width;
    const bool title = std::abs(v - 0.35) < 0.1 && x > 0.25 && x < 0.75 &&
                       chance(seed * 64 + static_cast<std::uint64_t>(64.0 * v)) > 0.35;
    const double thread = noise(512.0 * u, 128.0 * v, 512, 128, 17);
    return Shade{(gold || title) && cloth != 3 ? 7 : cloth,
                 0.35 + 0.4 * chance(seed + 160) + 0.3 * (thread - 0.5)};
  });
}

} // namespace meninas::gallery
