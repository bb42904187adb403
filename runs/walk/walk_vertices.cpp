#include "runs/walk/walk_vertices.h"

#include "runs/walk/walk_lamps.h"
#include "scenes/content_hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <unordered_set>

namespace meninas {

namespace {

/// By vertex.
struct VertexTable {
  std::string name;
  std::size_t columns = 1;
  std::vector<std::uint32_t> values = {};
  std::optional<std::uint32_t> usual = {}; ///< a table with this everywhere is left out

  std::span<const std::uint32_t> row(std::uint32_t v) const {
    return std::span(values).subspan(v * columns, columns);
  }
};

std::array<std::uint32_t, 2> octahedral(const glm::vec3& n) {
  const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  if (!(sum > 0.0F))
    return {0, 0};
  glm::vec2 p(n.x / sum, n.y / sum);
  if (n.z < 0.0F)
    p = glm::vec2((1.0F - std::abs(p.y)) * (p.x >= 0.0F ? 1.0F : -1.0F),
                  (1.0F - std::abs(p.x)) * (p.y >= 0.0F ? 1.0F : -1.0F));
  return {in_steps(double{p.x}, 0x1p-14), in_steps(double{p.y}, 0x1p-14)};
}

double position_step(const WalkRoom& room) {
  float most = 0.0F;
  for (const WalkVertex& v : room.vertices)
    most = std::max(most, largest(glm::abs(v.position)));
  return most > 0.0F ? double{most} * 0x1p-20 : 1.0;
}

/// Where the vertices are, and what they are made of.
std::vector<VertexTable> tables_without_light(const WalkRoom& room, double step) {
  constexpr double texture_step = 0x1p-16, colour_step = 1.0 / 65535.0;
  constexpr std::uint32_t white = 65535;
  VertexTable position{"position", 3}, normal{"normal", 2, {}, 0U}, place{"place", 4, {}, 0U},
      colour{"colour", 4, {}, white}, look{"look"};
  for (const WalkVertex& v : room.vertices) {
    for (int k = 0; k < 3; ++k)
      position.values.push_back(in_steps(double{v.position[k]}, step));
    for (const std::uint32_t n : octahedral(v.normal))
      normal.values.push_back(n);
    for (const glm::vec2& uv : {v.colour_place, v.emission_place})
      for (int k = 0; k < 2; ++k)
        place.values.push_back(in_steps(double{uv[k]}, texture_step));
    for (int k = 0; k < 4; ++k)
      colour.values.push_back(in_steps(double{std::clamp(v.colour[k], 0.0F, 1.0F)}, colour_step));
    look.values.push_back(v.look);
  }
  return {std::move(position), std::move(normal), std::move(place), std::move(colour), std::move(look)};
}

/// The vertices of the room that the page keeps, and its triangles by their number there.
struct KeptVertices {
  std::vector<std::uint32_t> vertices, triangles;
};

KeptVertices all_vertices(const WalkRoom& room) {
  KeptVertices kept{std::vector<std::uint32_t>(room.vertices.size()), room.indices};
  std::iota(kept.vertices.begin(), kept.vertices.end(), 0U);
  return kept;
}

KeptVertices joined_vertices(const WalkRoom& room, std::span<const VertexTable> tables) {
  constexpr std::uint32_t not_met = ~std::uint32_t{0};
  const auto hash = [&](std::uint32_t v) {
    std::size_t sum = 0;
    for (const VertexTable& table : tables)
      sum = 31 * sum + hash_of_bytes(std::as_bytes(table.row(v)));
    return sum;
  };
  const auto alike = [&](std::uint32_t a, std::uint32_t b) {
    return std::ranges::all_of(tables, [&](const VertexTable& table) {
             return std::ranges::equal(table.row(a), table.row(b));
           });
  };
  std::vector<std::uint32_t> numbers(room.vertices.size(), not_met);
  KeptVertices kept;
  for (const WalkBatch& batch : room.batches) {
    std::unordered_set<std::uint32_t, decltype(hash), decltype(alike)> known(0, hash, alike);
    for (const std::uint32_t v : std::span(room.indices).subspan(3 * std::size_t{batch.first}, 3 * std::size_t{batch.count})) {
      if (numbers[v] == not_met) {
        const auto [first, is_new] = known.insert(v);
        if (is_new) {
          numbers[v] = static_cast<std::uint32_t>(kept.vertices.size());
          kept.vertices.push_back(v);
        } else
          numbers[v] = numbers[*first];
      }
      kept.triangles.push_back(numbers[v]);
    }
  }
  return kept;
}

} // namespace

PageVertices page_vertices(const WalkRoom& room, std::size_t lamps, VertexNumbering numbering) {
  PageVertices page;
  page.step = position_step(room);
  std::vector<VertexTable> tables = tables_without_light(room, page.step);
  const auto add_light = [&](std::string name, std::span<const glm::vec3> irradiance) {
    const float scale = scale_of_halves(irradiance);
    tables.push_back({std::move(name), 3, halves_by_green(irradiance, scale)});
    return scale;
  };
  page.light = add_light("irradiance", irradiance_of(room));
  for (std::size_t l = 0; l < lamps; ++l)
    page.lamp_lights.push_back(add_light(fmt::format("lamp{}", l), room.irradiance_by_lamp[l]));

  const KeptVertices kept = numbering == VertexNumbering::joined ? joined_vertices(room, tables) : all_vertices(room);
  for (const VertexTable& table : tables) {
    if (table.usual && std::ranges::all_of(table.values, [&](std::uint32_t x) { return x == *table.usual; }))
      continue;
    std::vector<std::uint32_t> rows;
    rows.reserve(table.columns * kept.vertices.size());
    for (const std::uint32_t v : kept.vertices)
      rows.insert(rows.end(), table.row(v).begin(), table.row(v).end());
    add_table(page.packed, table.name, rows, table.columns);
  }
  add_table(page.packed, "triangles", kept.triangles, 3);
  add_table(page.packed, "elementEnds", room.element_ends, 1);
  return page;
}

} // namespace meninas
