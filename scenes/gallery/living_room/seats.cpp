// Sofa and armchair: upholstered boxes, cushions between them, turned feet.
#include "scenes/gallery/living_room/pieces.h"
#include "scenes/gallery/living_room/textures.h"

namespace meninas::gallery {

Paint textured(const std::string& name, Picture picture, const Rgb& factor) {
  Paint paint = diffuse(name, factor);
  paint.picture = std::move(picture);
  return paint;
}

Paint wood() { return textured("wood", wood_grain(), Rgb(0.9)); }
Paint dark_wood() { return textured("dark-wood", wood_grain(), {0.5, 0.42, 0.4}); }
Paint porcelain() { return coated("porcelain", {0.78, 0.77, 0.74}, 0.05); }

Mesh placed(Mesh mesh, const Place& place) {
  return moved(turned(std::move(mesh), Point3(0.0), {0.0, 1.0, 0.0}, place.degrees), place.foot);
}

/// A cushion that is thick in its middle, upright: its thickness along z.
static Mesh upright_cushion(const Point3& centre, const Vec3& half, double p, double q, int n) {
  return moved(turned(superellipsoid({Point3(0.0), {half.x, half.z, half.y}, p, q}, n), Point3(0.0),
                      {1.0, 0.0, 0.0}, 90.0),
               centre);
}

void add_seat(Stage& stage, const Seat& seat, const Place& place) {
  constexpr double width = 0.58, arm = 0.2, gap = 0.003;
  const double half = 0.5 * width * seat.cushions;
  std::vector<Mesh> body{
      rounded_box({-half + gap, 0.12, -0.42}, {half - gap, 0.3, 0.43}, 0.03, 6, 0.25),
      rounded_box({-half + gap, 0.303, -0.42}, {half - gap, 0.8, -0.24}, 0.07, 8, 0.25)};
  for (const double side : {-1.0, 1.0}) {
    const double x = side * (half + 0.5 * arm);
    body.push_back(
        rounded_box({x - 0.5 * arm, 0.12, -0.43}, {x + 0.5 * arm, 0.6, 0.45}, 0.085, 10, 0.25));
  }
  std::vector<Mesh> cushions;
  for (int k = 0; k < seat.cushions; ++k) {
    const double x = -half + (k + 0.5) * width;
    cushions.push_back(
        superellipsoid({{x, 0.385, 0.11}, {0.5 * width - gap, 0.08, 0.345}, 9.0, 3.0}, 26));
    cushions.push_back(
        upright_cushion({x, 0.675, -0.135}, {0.5 * width - 2 * gap, 0.2, 0.095}, 6.0, 2.6, 26));
  }
  std::vector<Mesh> feet;
  const std::vector<Vec2> foot{{0.0, 0.0},     {0.014, 0.0},   {0.014, 0.0},   {0.018, 0.03},
                               {0.028, 0.085}, {0.028, 0.118}, {0.028, 0.118}, {0.0, 0.118}};
  for (const double x : {-half - 0.1, half + 0.1})
    for (const double z : {-0.33, 0.35})
      feet.push_back(turned_body({x, 0.0, z}, rounded_profile(foot, 6), 24));

  const Paint cloth = textured(seat.name + "-cloth", weave(), seat.cloth);
  stage.add(seat.name, cloth, placed(merged(body), place));
  stage.add(seat.name + "-cushions", cloth, placed(merged(cushions), place));
  stage.add(seat.name + "-feet", diffuse("turned-wood", {0.2, 0.12, 0.07}),
            placed(merged(feet), place));
  if (!seat.pillows)
    return;
  int k = 0;
  for (const auto& [x, degrees, colour] : {std::tuple(-half + 0.27, 6.0, Rgb(0.62, 0.4, 0.13)),
                                           std::tuple(half - 0.27, -8.0, Rgb(0.16, 0.3, 0.33))}) {
    Mesh pillow = upright_cushion(Point3(0.0), {0.22, 0.2, 0.075}, 5.0, 2.0, 28);
    pillow = turned(std::move(pillow), Point3(0.0), {0.0, 0.0, 1.0}, degrees);
    pillow = turned(std::move(pillow), Point3(0.0), {1.0, 0.0, 0.0}, -14.0);
    const auto number = std::to_string(++k);
    stage.add(seat.name + "-pillow-" + number, textured("pillow-" + number, weave(), colour),
              placed(moved(std::move(pillow), {x, 0.69, 0.095}), place));
  }
}

} // namespace meninas::gallery
