#include "radiosity/transport/translucency.h"

#include "radiosity/transport/linear_system.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace meninas {

namespace {

/// An element of the front and one of the back, and how much of the translucent surface is in both, m^2.
using Overlaps = std::map<std::pair<std::uint32_t, std::uint32_t>, double>;

class BackToBack {
public:
  BackToBack(const ElementMesh& mesh, SideId front, SideId back)
      : mesh_(mesh), front_(front), back_(back) {
    const MeshSide& a = mesh.sides[index(front)];
    const MeshSide& b = mesh.sides[index(back)];
    for (std::uint32_t k = 0; k < a.root_count; ++k)
      meet(a.first_cell + k, b.first_cell + k);
  }
  const Overlaps& overlaps() const { return overlaps_; }

private:
  /// Cells of both sides, one of which lies over all of the other.
  void meet(std::uint32_t a, std::uint32_t b) {
    const MeshCell& front = mesh_.cells[a];
    const MeshCell& back = mesh_.cells[b];
    if (is_leaf(front) && is_leaf(back))
      return meet_leaves(front, back);
    for (std::uint32_t k = 0; k < 4; ++k)
      meet(is_leaf(front) ? a : index(front.first_child) + k,
           is_leaf(back) ? b : index(back.first_child) + k);
  }

  bool is_cut(const MeshCell& leaf) const {
    return leaf.element_count != 1 || region_of(mesh_, ElementId{leaf.first_element}) != nullptr;
  }

  void meet_leaves(const MeshCell& front, const MeshCell& back) {
    constexpr std::uint32_t points = 256;
    const MeshCell& smaller = front.level > back.level ? front : back;
    if (!is_cut(front) && !is_cut(back)) {
      overlaps_[{front.first_element, back.first_element}] += smaller.area;
      return;
    }
    const bool triangle = mesh_.sides[index(front_)].triangle;
    for (std::uint32_t k = 0; k < points; ++k) {
      const auto sample = sobol4(k, 0x5ee7);
      Vec2 st(sample[0], sample[1]);
      if (triangle && st.x + st.y > 1.0)
        st = 1.0 - st;
      const Vec2 uv = patch_uv_of(mesh_, smaller, st);
      overlaps_[{index(locate(mesh_, front_, uv).element),
                 index(locate(mesh_, back_, uv).element)}] += smaller.area / points;
    }
  }

  const ElementMesh& mesh_;
  SideId front_, back_;
  Overlaps overlaps_;
};

/// The elements behind others, with the area, m^2, over which they overlap.
struct Behind {
  std::uint32_t element, behind;
  double area;
};

/// In the order of the elements.
std::vector<Behind> all_behind(const ElementMesh& mesh) {
  std::vector<Behind> all;
  for (const auto& [front, back] : mesh.sides_of_patch) {
    if (front == none<SideId> || back == none<SideId> || side_behind(mesh, front) == none<SideId>)
      continue;
    const BackToBack sides(mesh, front, back);
    for (const auto& [pair, area] : sides.overlaps()) {
      all.push_back({pair.first, pair.second, area});
      all.push_back({pair.second, pair.first, area});
    }
  }
  std::ranges::sort(all, {}, [](const Behind& b) { return std::pair(b.element, b.behind); });
  return all;
}

/// c_j
double uncovered(const ElementMesh& mesh, std::span<const float> exposed, std::uint32_t element) {
  if (exposed.empty() || mesh.solid[element] == 0.0F)
    return 1.0;
  return std::min(1.0, double{exposed[element]} / double{mesh.solid[element]});
}

/// Sums rows of a transport, each with a weight.
class RowSum {
public:
  explicit RowSum(const Transport& transport)
      : transport_(transport), sums_(transport.size, Rgb(0.0)), has_(transport.size, 0) {}

  void add(std::size_t row, const Rgb& share) {
    for (auto k = transport_.row_begin[row]; k < transport_.row_begin[row + 1]; ++k) {
      const std::uint32_t column = transport_.columns[k];
      if (has_[column] == 0)
        columns_.push_back(column);
      has_[column] = 1;
      const float* w = &transport_.weights[k * static_cast<std::size_t>(transport_.bands)];
      sums_[column] += share * (transport_.bands == 1 ? Rgb(double{w[0]}) : Rgb(w[0], w[1], w[2]));
    }
  }

  /// Appends what has been added, and forgets it.
  void append_to(Transport& rows) {
    std::ranges::sort(columns_);
    for (const std::uint32_t column : columns_) {
      rows.columns.push_back(column);
      for (int band = 0; band < rows.bands; ++band)
        rows.weights.push_back(static_cast<float>(sums_[column][band]));
      sums_[column] = Rgb(0.0);
      has_[column] = 0;
    }
    columns_.clear();
  }

private:
  const Transport& transport_;
  std::vector<Rgb> sums_;
  std::vector<std::uint8_t> has_;
  std::vector<std::uint32_t> columns_;
};

Rgb share_of_total(const Rgb& part, const Rgb& total) {
  Rgb share(0.0);
  for (int band = 0; band < 3; ++band)
    if (total[band] > 0.0)
      share[band] = part[band] / total[band];
  return share;
}

bool has_no_colour(const Rgb& share) { return share.r == share.g && share.g == share.b; }

} // namespace

TranslucentLinks translucent_links(const ElementMesh& mesh, std::span<const float> exposed) {
  TranslucentLinks links;
  if (mesh.transmittance.empty())
    return links;
  const std::vector<Behind> all = all_behind(mesh);
  std::vector<double> over(element_count(mesh), 0.0);
  for (const Behind& pair : all)
    over[pair.element] += pair.area;
  links.row_begin.assign(over.size() + 1, 0);
  for (const Behind& pair : all) {
    ++links.row_begin[pair.element + 1];
    links.columns.push_back(pair.behind);
    links.transmittance.push_back(
        mesh.transmittance[pair.element] *
        (pair.area / over[pair.element] * uncovered(mesh, exposed, pair.behind)));
  }
  for (std::size_t e = 0; e < over.size(); ++e)
    links.row_begin[e + 1] += links.row_begin[e];
  return links;
}

TranslucentLinks transposed(const TranslucentLinks& links) {
  TranslucentLinks columns;
  if (links.empty())
    return columns;
  const std::size_t rows = links.row_begin.size() - 1;
  columns.row_begin.assign(rows + 1, 0);
  for (const std::uint32_t column : links.columns)
    ++columns.row_begin[column + 1];
  for (std::size_t j = 0; j < rows; ++j)
    columns.row_begin[j + 1] += columns.row_begin[j];
  columns.columns.resize(links.columns.size());
  columns.transmittance.resize(links.columns.size());
  std::vector<std::uint32_t> place = columns.row_begin;
  for (std::uint32_t i = 0; i < rows; ++i)
    for (std::uint32_t k = links.row_begin[i]; k < links.row_begin[i + 1]; ++k) {
      const std::uint32_t at = place[links.columns[k]]++;
      columns.columns[at] = i;
      columns.transmittance[at] = links.transmittance[k];
    }
  return columns;
}

Rgb passed_from_behind(const TranslucentLinks& links, std::size_t row,
                       const std::vector<Rgb>& irradiance) {
  Rgb sum(0.0);
  if (links.empty())
    return sum;
  for (std::uint32_t k = links.row_begin[row]; k < links.row_begin[row + 1]; ++k)
    sum += links.transmittance[k] * irradiance[links.columns[k]];
  return sum;
}

std::vector<Rgb> scattered(const std::vector<Rgb>& reflectance, const TranslucentLinks& links,
                           const std::vector<Rgb>& irradiance) {
  std::vector<Rgb> light;
  light.reserve(irradiance.size());
  for (std::size_t i = 0; i < irradiance.size(); ++i)
    light.push_back(reflectance[i] * irradiance[i]);
  for (std::size_t i = 0; !links.empty() && i < light.size(); ++i)
    light[i] += passed_from_behind(links, i, irradiance);
  return light;
}

std::vector<Rgb> total_shares(const std::vector<Rgb>& reflectance, const TranslucentLinks& links) {
  std::vector<Rgb> totals = reflectance;
  for (std::size_t i = 0; !links.empty() && i < totals.size(); ++i)
    for (std::uint32_t k = links.row_begin[i]; k < links.row_begin[i + 1]; ++k)
      totals[i] += links.transmittance[k];
  return totals;
}

std::vector<Rgb> passed_on(const TranslucentLinks& links, std::span<const double> areas,
                           const std::vector<Rgb>& worth) {
  std::vector<Rgb> passed(areas.size(), Rgb(0.0));
  for (std::size_t i = 0; !links.empty() && i < areas.size(); ++i)
    for (std::uint32_t k = links.row_begin[i]; k < links.row_begin[i + 1]; ++k)
      if (const std::uint32_t j = links.columns[k]; areas[j] > 0.0)
        passed[j] += areas[i] / areas[j] * links.transmittance[k] * worth[i];
  return passed;
}

MixedRows mixed_rows(const Transport& transport, const std::vector<Rgb>& reflectance,
                     const TranslucentLinks& links) {
  MixedRows mixed;
  mixed.total = total_shares(reflectance, links);
  mixed.transport.size = transport.size;
  bool grey = true;
  for (std::size_t i = 0; i < transport.size; ++i)
    grey = grey && (links.row_begin[i] == links.row_begin[i + 1] ||
                    has_no_colour(share_of_total(reflectance[i], mixed.total[i])));
  mixed.transport.bands = grey ? transport.bands : 3;
  RowSum sum(transport);
  mixed.transport.row_begin.push_back(0);
  mixed.transport.columns.reserve(transport.columns.size());
  mixed.transport.weights.reserve(transport.columns.size() * static_cast<std::size_t>(mixed.transport.bands));
  for (std::size_t i = 0; i < transport.size; ++i) {
    const bool own_alone = links.row_begin[i] == links.row_begin[i + 1];
    if (own_alone && mixed.transport.bands == transport.bands) {
      append_row(transport, i, mixed.transport);
      continue;
    }
    sum.add(i, own_alone ? Rgb(1.0) : share_of_total(reflectance[i], mixed.total[i]));
    for (std::uint32_t k = links.row_begin[i]; k < links.row_begin[i + 1]; ++k)
      sum.add(links.columns[k], share_of_total(links.transmittance[k], mixed.total[i]));
    sum.append_to(mixed.transport);
    mixed.transport.row_begin.push_back(mixed.transport.columns.size());
  }
  return mixed;
}

} // namespace meninas
