// Rooms without mirrors:
// an ordinary furnished one, and the furnace whose solution is known in closed form.
#include "scenes/gallery/generator/furniture.h"
#include "scenes/gallery/generator/stages.h"

#include <numbers>

namespace meninas::gallery {

static const Paint wood = diffuse("wood", {0.42, 0.28, 0.16});

/// Seat, legs and back rest; the back rest is towards -z, `middle` on the floor.
static Mesh chair(const Point3& middle, double degrees) {
  const auto seat =
      table(middle + Vec3(-0.22, 0.0, -0.22), middle + Vec3(0.22, 0.46, 0.22), 0.04, 0.04);
  const auto rest = box(middle + Vec3(-0.22, 0.46, -0.22), middle + Vec3(0.22, 0.95, -0.18),
                        std::array{Face::y0});
  return turned(merged(std::array{seat, rest}), middle, {0.0, 1.0, 0.0}, degrees);
}

static void add_window(Stage& stage, const Point3& high, const Paint& plaster) {
  const Sheet left{{0.0, 0.0, high.z}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}};
  const Rect opening{{1.1, 0.9}, {2.9, 2.2}};
  stage.add("left", plaster, wall(left, {{0.0, 0.0}, {high.z, high.y}}, std::array{opening}));
  stage.add("window-reveal", plaster, reveal(left, opening, 0.2));
  stage.add("window", light("window", {4.0, 4.5, 5.2}), panel(left, opening, -0.2));
}

static void add_lamp(Stage& stage, const Point3& high, const Paint& plaster) {
  const Sheet ceiling{{0.0, high.y, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  const Rect opening{{3.3, 2.0}, {3.7, 2.4}};
  stage.add("ceiling", plaster, wall(ceiling, {{0.0, 0.0}, {high.x, high.z}}, std::array{opening}));
  stage.add("lamp", light("lamp", {16.0, 12.0, 7.5}), panel(ceiling, opening, 0.0));
}

Stage no_mirror() {
  Stage stage{"no-mirror",
              {},
              {{"main", {4.75, 1.6, 3.85}, {1.7, 0.85, 1.0}, 58.0, 4.0 / 3.0},
               {"window", {0.4, 1.5, 0.3}, {3.4, 0.8, 2.6}, 60.0, 4.0 / 3.0}}};
  const Point3 high{5.0, 2.7, 4.0};
  const auto plaster = diffuse("plaster", {0.78, 0.76, 0.7});
  add_room(stage, {0.0, 0.0, 0.0}, high, plaster, diffuse("boards", {0.46, 0.33, 0.22}),
           std::array{Face::x0, Face::y1});
  add_window(stage, high, plaster);
  add_lamp(stage, high, plaster);

  stage.add("table", wood, table({1.6, 0.0, 1.2}, {3.0, 0.74, 2.0}, 0.04, 0.06));
  stage.add("chair-a", diffuse("oak", {0.5, 0.36, 0.22}), chair({2.0, 0.0, 0.85}, 8.0));
  stage.add("chair-b", diffuse("oak", {0.5, 0.36, 0.22}), chair({2.6, 0.0, 2.45}, 170.0));
  stage.add("vase", diffuse("clay", {0.6, 0.25, 0.14}),
            lathe({2.2, 0.74, 1.6},
                  std::array{Vec2(0.06, 0.0), Vec2(0.13, 0.14), Vec2(0.05, 0.3), Vec2(0.09, 0.36)},
                  14));

  const auto green = diffuse("green", {0.2, 0.36, 0.22});
  stage.add("sofa", green,
            merged(std::array{standing_box({4.1, 0.0, 0.6}, {4.75, 0.42, 2.4}),
                              standing_box({4.78, 0.0, 0.6}, {4.98, 0.85, 2.4})}));
  std::vector<Mesh> shelves;
  for (const auto y : {0.4, 0.9, 1.4, 1.9})
    shelves.push_back(box({3.2, y, 0.01}, {4.0, y + 0.03, 0.3}));
  stage.add("shelves", wood, merged(shelves));
  std::vector<Mesh> books;
  for (int k = 0; k < 6; ++k)
    books.push_back(standing_box({3.26 + 0.07 * k, 0.93, 0.03},
                                 {3.31 + 0.07 * k, 1.14 + 0.02 * (k % 3), 0.22}));
  stage.add("books", diffuse("books", {0.5, 0.12, 0.1}), merged(books));
  return stage;
}

Stage furnace() {
  Stage stage{"furnace", {}, {{"main", {0.5, 0.5, 0.95}, {0.5, 0.5, 0.0}, 60.0, 1.0}}};

  // E = pi L = 1 and rho = 1/2 everywhere: B = E / (1 - rho) = 2.
  const Paint wall{"wall", Rgb(0.5), Finish::diffuse, Rgb(std::numbers::inv_pi)};
  add_room(stage, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, wall, wall);
  return stage;
}

} // namespace meninas::gallery
