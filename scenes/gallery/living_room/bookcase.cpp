// Shelves of books: a binding bent round each block of pages.
#include "scenes/gallery/living_room/pieces.h"
#include "scenes/gallery/living_room/textures.h"

#include <cmath>
#include <numbers>

namespace meninas::gallery {
namespace {

constexpr double board = 0.0025; ///< thickness of a binding

struct Book {
  double thickness, height, depth;
  int design;
};

/// The binding from above: out along one board, round the back, along the other; then inside.
struct Outline {
  std::vector<Vec2> outside, inside; ///< (x, z), the back towards +z
};
Outline binding_outline(const Book& book) {
  constexpr int arc = 8;
  const double half = 0.5 * book.thickness, bulge = 0.22 * book.thickness;
  Outline line;
  const auto row = [&](double inset) {
    std::vector<Vec2> points{{half - inset, -book.depth}};
    for (int k = 0; k <= arc; ++k) {
      const double angle = std::numbers::pi * k / arc;
      points.emplace_back((half - inset) * std::cos(angle),
                          (bulge - inset) * std::sin(angle) - bulge);
    }
    points.emplace_back(-half + inset, -book.depth);
    return points;
  };
  line.outside = row(0.0);
  line.inside = row(board);
  return line;
}

/// The strip between two rows of points, front to the left of the first; `u` of its texture.
void add_strip(Mesh& mesh, const std::vector<Point3>& low, const std::vector<Point3>& high,
               const std::vector<double>& u) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto n = static_cast<std::uint32_t>(low.size());
  for (std::uint32_t k = 0; k < n; ++k) {
    mesh.positions.insert(mesh.positions.end(), {low[k], high[k]});
    mesh.texcoords.insert(mesh.texcoords.end(), {{u[k], 0.98}, {u[k], 0.02}});
  }
  for (std::uint32_t k = 0; k + 1 < n; ++k) {
    const std::uint32_t a = first + 2 * k;
    mesh.triangles.push_back({a, a + 1, a + 3});
    mesh.triangles.push_back({a, a + 3, a + 2});
  }
}

Mesh binding(const Book& book) {
  const Outline line = binding_outline(book);
  const auto at = [](const std::vector<Vec2>& row, double y) {
    std::vector<Point3> points;
    for (const Vec2& p : row)
      points.emplace_back(p.x, y, p.y);
    return points;
  };
  std::vector<double> u, plain;
  for (const Vec2& p : line.outside) {
    // Boards have the colour of the back's rim.
    u.push_back((book.design + 0.5 - 0.8 * p.x / book.thickness) / book_designs);
    plain.push_back((book.design + 0.1) / book_designs);
  }
  const auto outside = at(line.outside, 0.0), outside_top = at(line.outside, book.height);
  const auto inside = at(line.inside, 0.0), inside_top = at(line.inside, book.height);
  Mesh curved;
  add_strip(curved, outside, outside_top, u);
  add_strip(curved, inside_top, inside, plain);
  Mesh rims;
  add_strip(rims, outside_top, inside_top, plain);
  add_strip(rims, inside, outside, plain);
  for (const std::size_t end : {std::size_t{0}, outside.size() - 1}) {
    const bool starts = end == 0;
    const std::vector<Point3> low{starts ? inside[end] : outside[end],
                                  starts ? outside[end] : inside[end]};
    const std::vector<Point3> high{starts ? inside_top[end] : outside_top[end],
                                   starts ? outside_top[end] : inside_top[end]};
    add_strip(rims, low, high, {plain[0], plain[0]});
  }
  return merged(std::array{smoothed(std::move(curved)), faceted(rims)});
}

Mesh pages(const Book& book) {
  const double half = 0.5 * book.thickness - board - 2e-4;
  const double back = -0.22 * book.thickness - board;
  return plain_box({-half, 0.004, -book.depth + 0.004}, {half, book.height - 0.004, back});
}

} // namespace

static std::vector<Mesh> boards_of_case(double width, double height, double depth, int shelves) {
  constexpr double plank = 0.025, gap = 0.0005;
  const double x = 0.5 * width;
  std::vector<Mesh> boards{
      plain_box({-x, 0.0, 0.0}, {-x + plank, height, depth}),
      plain_box({x - plank, 0.0, 0.0}, {x, height, depth}),
      plain_box({-x - 0.02, height + gap, -0.004}, {x + 0.02, height + 0.03, depth + 0.02}),
      plain_box({-x + plank + gap, 0.08, 0.0}, {x - plank - gap, height - gap, 0.01})};
  for (int k = 0; k < shelves; ++k) {
    const double y = 0.055 + k * (height - 0.08) / shelves;
    boards.push_back(
        plain_box({-x + plank + gap, y, 0.01 + gap}, {x - plank - gap, y + plank, depth - 0.004}));
  }
  return boards;
}

void add_bookcase(Stage& stage, const std::string& name, const Place& place, std::uint64_t seed) {
  constexpr double width = 1.3, height = 2.1, depth = 0.3;
  constexpr int shelves = 6;
  stage.add(name, dark_wood(),
            placed(merged(boards_of_case(width, height, depth, shelves)), place));

  std::uint64_t k = seed;
  for (int shelf = 0; shelf < shelves; ++shelf) {
    std::vector<Mesh> bindings, blocks;
    const double y = 0.0805 + shelf * (height - 0.08) / shelves;
    double x = -0.5 * width + 0.03;
    // Volumes of one edition are alike, and stand together.
    while (true) {
      const int volumes = chance(++k) < 0.3 ? 2 + static_cast<int>(5.0 * chance(++k)) : 1;
      Book book{0.016 + 0.028 * chance(++k), 0.17 + 0.12 * chance(++k), 0.13 + 0.07 * chance(++k),
                static_cast<int>(book_designs * chance(++k))};
      const bool ends = x + volumes * (book.thickness + 0.001) > 0.5 * width - 0.03;
      for (int volume = 0; volume < volumes && !ends; ++volume) {
        const Point3 at{x + 0.5 * book.thickness, y, 0.26 - 0.012 * chance(++k)};
        bindings.push_back(moved(binding(book), at));
        blocks.push_back(moved(pages(book), at));
        x += book.thickness + 0.001;
      }
      if (ends)
        break;
      if (chance(++k) < 0.04)
        x += 0.08;
    }
    const auto row = name + "-books-" + std::to_string(shelf + 1);
    stage.add(row, textured("bindings", book_backs()), placed(merged(bindings), place));
    stage.add(row + "-pages", diffuse("paper", {0.7, 0.66, 0.55}), placed(merged(blocks), place));
  }
}

} // namespace meninas::gallery
