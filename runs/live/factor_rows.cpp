#include "runs/live/factor_rows.h"

#include "radiosity/queries/element_factors.h"
#include "runs/walk/packed_numbers.h"
#include "scenes/errors.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace meninas {

namespace {

double mean_channel(const glm::vec3& x) { return double{x.r + x.g + x.b} / 3.0; }

/// By ElementId: which of the page.
std::vector<std::uint32_t> page_numbers(const ShownMesh& mesh) {
  std::vector<std::uint32_t> numbers(element_count(mesh.light->mesh), 0);
  for (std::uint32_t k = 0; k < mesh.elements.size(); ++k)
    if (mesh.elements[k] != none<ElementId>)
      numbers[index(mesh.elements[k])] = k;
  return numbers;
}

} // namespace

std::string FactorRows::row(const ShownMesh& mesh, std::size_t page_element) {
  if (!mesh.light || page_element >= mesh.elements.size())
    throw UsageError("element", "there is none of that number");
  const ElementId element = mesh.elements[page_element];
  if (element == none<ElementId>)
    throw UsageError("element", "what mirrors, passes or swallows all light has no form factors");
  FormFactorSettings settings = mesh.form_factors;
  settings.rays = std::max(settings.rays, rays_of_shown_row);
  ElementFactors factors;
  {
    const std::scoped_lock lock(mutex_);
    factors = element_factors(*mesh.light, element, settings);
  }
  const auto numbers = page_numbers(mesh);
  constexpr double brightest = 60000.0;
  double most = 0.0, direct = 0.0, mirrored = 0.0;
  for (const ElementFactor& factor : factors.row) {
    most = std::max({most, factor.direct, factor.mirrored});
    direct += factor.direct;
    mirrored += factor.mirrored;
  }
  const double scale = most > 0.0 ? most / brightest : 1.0;
  std::vector<std::uint32_t> bits(2 * mesh.elements.size(), 0);
  for (const ElementFactor& factor : factors.row) {
    const std::size_t at = 2 * std::size_t{numbers[index(factor.to)]};
    bits[at] = half_bits(static_cast<float>(factor.direct / scale));
    bits[at + 1] = half_bits(static_cast<float>(factor.mirrored / scale));
  }
  PackedNumbers packed;
  add_table(packed, "factors", bits, 2);
  const PackedTable& table = packed.tables.front();
  const RowClosure& ends = factors.closure;
  const nlohmann::json head{{"room", mesh.room},
                            {"element", page_element},
                            {"scale", scale},
                            {"direct", direct},
                            {"mirrored", mirrored},
                            {"escaped", mean_channel(ends.escaped_light)},
                            {"absorbed", mean_channel(ends.mirror_absorbed)},
                            {"black", mean_channel(ends.black_light)},
                            {"rows", table.rows},
                            {"columns", table.columns},
                            {"bytes", table.bytes_each}};
  return joined_message(head.dump(), deflated(packed.bytes, PackedSize::quick));
}

} // namespace meninas
