#include "scenes/gallery/generator/meninas_figures.h"

#include "scenes/gallery/generator/furniture.h"

namespace meninas::gallery {

static const Paint skin = diffuse("skin", {0.68, 0.47, 0.36});

/// Outlines in units of the figure's height, from the hem to the neck.
static std::vector<Vec2> outline(Dress dress) {
  switch (dress) {
  case Dress::wide_skirt:
    return {{0.36, 0.0},   {0.36, 0.16},  {0.3, 0.36},  {0.18, 0.5},
            {0.075, 0.58}, {0.115, 0.75}, {0.035, 0.81}};
  case Dress::skirt:
    return {{0.25, 0.0}, {0.23, 0.25}, {0.15, 0.48}, {0.07, 0.57}, {0.11, 0.75}, {0.035, 0.82}};
  case Dress::cloak:
    return {{0.1, 0.0}, {0.12, 0.3}, {0.14, 0.5}, {0.105, 0.6}, {0.13, 0.77}, {0.035, 0.83}};
  }
  return {};
}

static std::vector<Vec2> times(std::vector<Vec2> profile, double height) {
  for (auto& point : profile)
    point *= height;
  return profile;
}

void add_figure(Stage& stage, const Figure& figure) {
  const auto& [name, foot, height, dress, gown, hair, gaze] = figure;
  const auto profile = times(outline(dress), height);
  const auto neck = profile.back();

  // People are wider than deep.
  const Vec3 flat{1.0, 1.0, dress == Dress::cloak ? 0.75 : 0.85};
  stage.add(name + ".gown", diffuse(name + ".gown", gown),
            scaled(lathe(foot, profile, 10), foot, flat));

  // Heads grow less than bodies do.
  // The hair is a larger shell, set back far enough for the face to stand out of it.
  const auto size = 0.6 + 0.25 * height;
  const auto top = height - neck.y;
  const Point3 throat = foot + Vec3(0.0, neck.y, 0.0);
  stage.add(name + ".head", skin,
            lathe(throat,
                  std::array{Vec2(neck.x, 0.0), Vec2(0.06 * size, 0.12 * top),
                             Vec2(0.085 * size, 0.4 * top), Vec2(0.082 * size, 0.68 * top),
                             Vec2(0.0, 0.82 * top)},
                  8));
  const Vec3 back{0.0, 0.0, (gaze == Gaze::front ? -0.055 : 0.055) * size};
  stage.add(
      name + ".hair", diffuse(name + ".hair", hair),
      lathe(throat + back,
            std::array{Vec2(0.0, 0.1 * top), Vec2(0.1 * size, 0.14 * top),
                       Vec2(0.112 * size, 0.5 * top), Vec2(0.1 * size, 0.8 * top), Vec2(0.0, top)},
            8));
}

void add_arms(Stage& stage, const Figure& figure, const Point3& left_hand,
              const Point3& right_hand) {
  const auto shoulder = figure.foot + Vec3(0.0, 0.74 * figure.height, 0.0);
  const Vec3 aside{0.1 * figure.height, 0.0, 0.0};
  const auto thickness = 0.055 * figure.height;
  stage.add(figure.name + ".arms", diffuse(figure.name + ".gown", figure.gown),
            merged(std::array{bar(shoulder - aside, left_hand, thickness),
                              bar(shoulder + aside, right_hand, thickness)}));
}

void add_dog(Stage& stage, const Point3& foot) {
  const auto coat = diffuse("dog", {0.38, 0.27, 0.16});
  const std::array body{Vec2(0.0, -0.3), Vec2(0.09, -0.24), Vec2(0.115, 0.0), Vec2(0.1, 0.22),
                        Vec2(0.0, 0.3)};
  const Point3 middle = foot + Vec3(0.0, 0.12, 0.0);
  stage.add("dog.body", coat, turned(lathe(middle, body, 8), middle, {0.0, 0.0, 1.0}, 90.0));
  const std::array head{Vec2(0.0, -0.12),  Vec2(0.035, -0.1), Vec2(0.05, -0.02),
                        Vec2(0.085, 0.02), Vec2(0.07, 0.1),   Vec2(0.0, 0.12)};
  const Point3 skull = foot + Vec3(-0.33, 0.25, 0.03);
  stage.add("dog.head", coat, turned(lathe(skull, head, 8), skull, {0.0, 0.0, 1.0}, -70.0));
  stage.add("dog.ears", diffuse("dog.ears", {0.2, 0.13, 0.08}),
            merged(std::array{
                bar(skull + Vec3(0.03, 0.06, 0.09), skull + Vec3(0.05, -0.06, 0.11), 0.03),
                bar(skull + Vec3(0.03, 0.06, -0.09), skull + Vec3(0.05, -0.06, -0.11), 0.03)}));
  stage.add("dog.paws", coat,
            merged(std::array{
                standing_box(foot + Vec3(-0.46, 0.0, 0.06), foot + Vec3(-0.2, 0.045, 0.11)),
                standing_box(foot + Vec3(-0.43, 0.0, -0.07), foot + Vec3(-0.17, 0.045, -0.02))}));
}

} // namespace meninas::gallery
