#include "radiosity/field/view/view_field.h"

#include "radiosity/field/vertex_places.h"
#include "radiosity/field/view/cell_light.h"
#include "radiosity/field/view/cell_lookup.h"
#include "radiosity/field/view/curve_places.h"
#include "radiosity/field/view/lattice_cells.h"
#include "radiosity/field/view/seen_cells.h"
#include "radiosity/field/view/view_receivers.h"
#include "radiosity/light/light_samples.h"
#include "radiosity/light/shared_light.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

namespace meninas {

namespace {

using Workspaces = tbb::enumerable_thread_specific<SharedLightWorkspace>;
using OccludersOfImages = std::unordered_map<std::uint64_t, ImageOccluders>;

/// The light at a vertex of the cells, W/m^2.
struct VertexLight {
  glm::vec3 direct{0.0F}, direct_mirrored{0.0F};
  glm::vec3 indirect{0.0F}, indirect_mirrored{0.0F};
  float punctual = 0.0F; ///< of D, its brightest channel
  float error = 0.0F;    ///< of D, about, by the choice of shadow rays, its brightest channel
  float surplus = 0.0F;  ///< as a share of what is there
};

/// Vertices in rows of one element each.
struct VertexRows {
  std::vector<std::uint32_t> vertices;
  std::vector<std::size_t> begin; ///< rows + 1
};

VertexRows rows_of(std::vector<std::uint32_t> vertices, const std::vector<LatticeVertex>& all) {
  VertexRows rows{std::move(vertices), {}};
  const auto element_of = [&](std::uint32_t v) { return index(all[v].element); };
  std::ranges::stable_sort(rows.vertices, {}, element_of);
  for (std::size_t k = 0; k < rows.vertices.size(); ++k)
    if (k == 0 || element_of(rows.vertices[k]) != element_of(rows.vertices[k - 1]))
      rows.begin.push_back(k);
  rows.begin.push_back(rows.vertices.size());
  return rows;
}

class ViewRefiner {
public:
  ViewRefiner(const IrradianceField& field, SeenCells seen, const ViewRefinement& how, const Progress& progress)
      : progress_(progress), field_(field), mesh_(field.mesh()), light_(*field.scene), how_(how), seen_(std::move(seen)),
        cells_(seen_.lattice()), blockers_(seen_.roots()),
        places_(light_, cells_) {}

  ViewField refined() {
    light_from(0);
    dark_ = darkness();
    for (std::size_t new_cells = 0, new_vertices = 0;;) {
      const std::vector<std::uint32_t> divide = to_divide(new_cells, new_vertices);
      if (divide.empty())
        break;
      new_cells = cells_.cells().size();
      new_vertices = cells_.vertices().size();
      for (const std::uint32_t cell : divide)
        seen_.divide(cell);
      light_from(new_vertices);
    }
    filter_edges();
    settle();
    return result();
  }

private:
  /// Light at the vertices from that number on.
  void light_from(std::size_t first) {
    const auto& vertices = cells_.vertices();
    lights_.resize(vertices.size());
    places_.find_new();
    std::vector<std::uint32_t> lit;
    for (auto v = static_cast<std::uint32_t>(first); v < vertices.size(); ++v)
      if (places_.first_of(v) == v)
        lit.push_back(v);
    const VertexRows rows = rows_of(std::move(lit), vertices);
    light_rows(rows, [&](std::uint32_t v, SharedLightWorkspace& work) {
      return direct_at(light_, {cells_, v}, seen_.pixels_of_vertex(v), how_, work);
    });
    tbb::parallel_for(first, vertices.size(), [&](std::size_t v) {
      if (const std::uint32_t other = places_.first_of(v); other != v)
        take_direct(lights_[other], lights_[v]);
      take_indirect(vertices[v], lights_[v]);
    });
    tbb::parallel_for(first, vertices.size(),
                      [&](std::size_t v) { find_surplus(static_cast<std::uint32_t>(v)); });
    forget_but(rows);
  }

  /// Direct light, row by row. Occluders met by rays to an element's vertices are cached for
  /// later vertices of the same element, in their order.
  template <typename DirectAt> void light_rows(const VertexRows& rows, const DirectAt& direct) {
    constexpr std::size_t max_kept = 64;
    tbb::parallel_for(std::size_t{0}, rows.begin.size() - 1, [&](std::size_t row) {
      SharedLightWorkspace& work = workspaces_.local();
      const std::size_t begin = rows.begin[row], end = rows.begin[row + 1];
      OccludersOfImages& known = blockers_[seen_.root_of(cells_.vertices()[rows.vertices[begin]].element)];
      std::swap(work.blockers_of, known);
      for (std::size_t k = begin; k < end; ++k) {
        constexpr std::size_t often = 16;
        if (progress_ && (k - begin) % often == 0)
          progress_("render", 0.0);
        const std::uint32_t v = rows.vertices[k];
        const ArrivingLight d = direct(v, work);
        lights_[v].direct = glm::vec3(d.total);
        lights_[v].direct_mirrored = glm::vec3(d.mirrored);
        lights_[v].punctual = static_cast<float>(largest(d.punctual));
        lights_[v].error = static_cast<float>(work.shadow_error);
      }
      // Images without a cached occluder only take room, and so do more images than few vertices need.
      std::erase_if(work.blockers_of, [](const auto& image) { return image.second.learned == 0; });
      if (work.blockers_of.size() > max_kept)
        work.blockers_of.clear();
      std::swap(work.blockers_of, known);
    });
  }

  /// Where edges end in cells within a pixel, their corners take the mean of what they stand for. The corners of larger
  /// cells stay what they are: these would show it over all of their width.
  void filter_edges() {
    std::vector<std::uint8_t> levels(lights_.size(), 0); // of the smallest cell about a vertex that an edge ends in
    std::vector<std::uint8_t> coarsest(lights_.size(), LatticeCells::finest);
    for (std::uint32_t c = 0; c < cells_.cells().size(); ++c) {
      const LatticeCell& cell = cells_.cells()[c];
      const double pixels = seen_.pixels(c);
      if (cell.first_child != LatticeCell::leaf || !(pixels > 0.0))
        continue;
      const bool has_edge = pixels <= 0.5 && pixels * double{spread_of(cell)} > how_.tolerance;
      for (const std::uint32_t v : cell.corners) {
        // Of the facets of a curve each has a lattice of its own, and the light of the first one's vertex.
        const std::uint32_t first = places_.first_of(v);
        const bool same_lattice = is_on_side_of(cell, first);
        coarsest[first] = std::min(coarsest[first], same_lattice ? cell.level : std::uint8_t{0});
        if (has_edge && same_lattice)
          levels[first] = std::max(levels[first], cell.level);
      }
    }
    for (std::uint32_t v = 0; v < levels.size(); ++v)
      if (levels[v] > coarsest[v])
        levels[v] = 0;
    std::vector<std::uint32_t> at_edges;
    for (std::uint32_t v = 0; v < levels.size(); ++v)
      if (levels[v] > 0)
        at_edges.push_back(v);
    light_rows(rows_of(std::move(at_edges), cells_.vertices()), [&](std::uint32_t v, SharedLightWorkspace& work) {
      return mean_direct_around(light_, {cells_, v}, levels[v], how_, work);
    });
    for (std::uint32_t v = 0; v < levels.size(); ++v)
      if (const std::uint32_t other = places_.first_of(v); other != v && levels[other] > 0)
        take_direct(lights_[other], lights_[v]);
  }

  bool is_on_side_of(const LatticeCell& cell, std::uint32_t vertex) const {
    const auto& side_of = mesh_.side_of_element;
    return side_of[index(cell.element)] == side_of[index(cells_.vertices()[vertex].element)];
  }

  static void take_direct(const VertexLight& from, VertexLight& light) {
    std::tie(light.direct, light.direct_mirrored, light.punctual, light.error) =
        std::tie(from.direct, from.direct_mirrored, from.punctual, from.error);
  }

  void take_indirect(const LatticeVertex& vertex, VertexLight& light) const {
    const ElementPoint at{vertex.element, cells_.place_in_element(vertex)};
    light.indirect = value_in(mesh_, field_.indirect, at);
    if (!field_.indirect_mirrored.empty())
      light.indirect_mirrored = value_in(mesh_, field_.indirect_mirrored, at);
  }

  /// Elements to which nothing was added will hardly be divided again.
  void forget_but(const VertexRows& rows) {
    std::vector<std::uint8_t> is_active(blockers_.size(), 0);
    for (const std::size_t k : std::span(rows.begin).first(rows.begin.size() - 1))
      is_active[seen_.root_of(cells_.vertices()[rows.vertices[k]].element)] = 1;
    for (std::size_t root = 0; root < blockers_.size(); ++root)
      if (is_active[root] == 0)
        OccludersOfImages().swap(blockers_[root]);
  }

  /// The surplus of D at a vertex over the mean of its neighbours, beyond twice the error of the difference.
  void find_surplus(std::uint32_t v) {
    const auto [a, b, c, e] = cells_.vertices()[v].between;
    if (a == v)
      return;
    VertexLight& light = lights_[v];
    glm::vec3 expected(0.0F);
    float variance = light.error * light.error;
    for (const std::uint32_t other : {a, b, c, e}) {
      expected += 0.25F * lights_[other].direct;
      variance += 0.125F * lights_[other].error * lights_[other].error;
    }
    const float off = largest(glm::abs(light.direct - expected)) - 2.0F * std::sqrt(variance);
    const float all =
        largest(glm::max(light.direct, expected) + glm::max(light.indirect, glm::vec3(0.0F))) +
        dark_;
    light.surplus = off > 0.0F && all > 0.0F ? off / all : 0.0F;
  }

  /// H_dark, by what is seen.
  float darkness() const {
    double sum = 0.0, points = 0.0;
    for (std::uint32_t c = 0; c < seen_.roots(); ++c) {
      for (const std::uint32_t v : cells_.cells()[c].corners)
        sum += 0.25 * double(seen_.points(c)) *
               double{largest(lights_[v].direct + lights_[v].indirect)};
      points += double(seen_.points(c));
    }
    return points > 0.0 ? dark_share * static_cast<float>(sum / points) : 0.0F;
  }

  /// The most light at its corners.
  float brightest_of(const LatticeCell& cell) const {
    float most = 0.0F;
    for (const std::uint32_t v : cell.corners)
      most = std::max(most, largest(lights_[v].direct + lights_[v].indirect));
    return most;
  }

  /// The largest difference of D at its corners, as a share of what is there.
  float spread_of(const LatticeCell& cell) const {
    glm::vec3 low(std::numeric_limits<float>::infinity()), high(0.0F);
    for (const std::uint32_t v : cell.corners) {
      low = glm::min(low, lights_[v].direct);
      high = glm::max(high, lights_[v].direct);
    }
    return largest(high - low) / (brightest_of(cell) + dark_);
  }

  /// Whether the points in a cell, and its corners, receive different light from punctual lights.
  bool has_edge_of_points(std::uint32_t number, float alike) const {
    float least = seen_.min_lit(number), most = seen_.max_lit(number);
    if (least > most)
      return false;
    const LatticeCell& cell = cells_.cells()[number];
    for (const std::uint32_t v : cell.corners) {
      least = std::min(least, lights_[v].punctual);
      most = std::max(most, lights_[v].punctual);
    }
    return most - least > alike * (std::max(most, brightest_of(cell)) + dark_);
  }

  /// Whether a vertex of that level tells to divide a cell of so many pixels.
  bool stands_out(std::uint32_t v, int level, double pixels) const {
    return cells_.vertices()[v].level == level && double{lights_[v].surplus} > surplus_bound(how_, pixels) &&
           pixels > how_.finest;
  }

  /// Whether a cell that was made with the last vertices is to be divided.
  bool tells_to_divide(std::uint32_t number, bool first) const {
    const double narrow_shadow = 0.5 * std::min(seen_.apart(), 1.0); // pixels
    const LatticeCell& cell = cells_.cells()[number];
    const double pixels = seen_.pixels(number);
    const float alike = spread_to_surplus * static_cast<float>(how_.tolerance);
    return pixels > how_.coarse || (first && pixels > 1.0 && spread_of(cell) > alike) ||
           (pixels > narrow_shadow && has_edge_of_points(number, alike)) ||
           std::ranges::any_of(
               cell.corners, [&](std::uint32_t v) { return stands_out(v, cell.level, pixels); }) ||
           is_told_to_divide(number, true);
  }

  /// By vertices in the middle of its edges: all that there are, or those of the last round.
  bool is_told_to_divide(std::uint32_t number, bool by_all) const {
    const LatticeCell& cell = cells_.cells()[number];
    const std::size_t count = cells_.is_triangle(cell) ? 3 : 4;
    for (std::size_t c = 0; c < count; ++c) {
      const std::uint32_t a = cell.corners[c], b = cell.corners[(c + 1) % count];
      if (!by_all && (ends_[a] == 0 || ends_[b] == 0))
        continue;
      const std::uint32_t middle = cells_.middle_of(a, b);
      if (middle != LatticeCells::no_vertex &&
          stands_out(middle, cell.level + 1, seen_.pixels(number)))
        return true;
    }
    return false;
  }

  /// Cells from `new_cells` on, and vertices from `new_vertices` on, are of the last round.
  std::vector<std::uint32_t> to_divide(std::size_t new_cells, std::size_t new_vertices) {
    ends_.assign(lights_.size(), 0);
    for (std::size_t v = new_vertices; v < lights_.size(); ++v)
      if (double{lights_[v].surplus} > how_.tolerance)
        for (const std::uint32_t end : cells_.vertices()[v].between)
          ends_[end] = 1;
    std::vector<std::uint8_t> marked(cells_.cells().size(), 0);
    tbb::parallel_for(std::size_t{0}, marked.size(), [&](std::size_t c) {
      const LatticeCell& cell = cells_.cells()[c];
      const auto number = static_cast<std::uint32_t>(c);
      if (cell.first_child == LatticeCell::leaf && cell.level + 1 < LatticeCells::finest)
        marked[c] = c >= new_cells ? tells_to_divide(number, new_cells == 0)
                                   : is_told_to_divide(number, false);
    });
    std::vector<std::uint32_t> divide;
    for (std::uint32_t c = 0; c < marked.size(); ++c)
      if (marked[c] != 0)
        divide.push_back(c);
    return divide;
  }

  /// Vertices on the edge of a larger cell take what that has there: no crack is left. Where
  /// nobody looks there is none to be seen, and the edge of what is seen stays as fine as it is.
  void settle() {
    std::vector<std::uint32_t> seen;
    for (std::uint32_t c = 0; c < cells_.cells().size(); ++c)
      if (cells_.cells()[c].first_child == LatticeCell::leaf && seen_.pixels(c) > 0.0)
        seen.push_back(c);
    for (const auto& [vertex, a, b] : hanging_corners(cells_, std::move(seen))) {
      VertexLight& light = lights_[vertex];
      light.direct = 0.5F * (lights_[a].direct + lights_[b].direct);
      light.direct_mirrored = 0.5F * (lights_[a].direct_mirrored + lights_[b].direct_mirrored);
    }
  }

  ViewField result() {
    ViewField result{field_, 0};
    IrradianceField& field = result.field;
    field.cells = std::make_shared<const FieldCells>(
        cell_lookup(mesh_, cells_, seen_.roots(), field.irradiance.size()));
    const bool mirrored = !field.mirrored.empty() && !field.indirect_mirrored.empty();
    for (const VertexLight& light : lights_) {
      field.irradiance.push_back(light.direct + light.indirect);
      field.indirect.push_back(light.indirect);
      if (!mirrored)
        continue;
      field.mirrored.push_back(light.direct_mirrored + light.indirect_mirrored);
      field.indirect_mirrored.push_back(light.indirect_mirrored);
    }
    for (const SharedLightWorkspace& work : workspaces_)
      result.shadow_rays += work.point.shadow_rays;
    return result;
  }

  const Progress& progress_;
  const IrradianceField& field_;
  const ElementMesh& mesh_;
  const LightScene& light_;
  const ViewRefinement& how_;
  SeenCells seen_;
  const LatticeCells& cells_;               ///< of what is seen
  std::vector<OccludersOfImages> blockers_; ///< by root
  CurvePlaces places_;
  std::vector<VertexLight> lights_;         ///< by vertex of the cells
  std::vector<std::uint8_t> ends_;          ///< likewise
  float dark_ = 0.0F;                       ///< H_dark
  Workspaces workspaces_;
};

} // namespace

ViewField view_field(const IrradianceField& field, std::vector<SeenPoint> seen, double apart,
                     const ViewRefinement& how, const Progress& progress) {
  expects(field.indirect.size() == field.irradiance.size(), "the field knows its indirect part");
  const LightScene& light = *field.scene;
  Workspaces workspaces;
  std::function<float(const SeenPoint&)> lit;
  if (!light.punctual.empty())
    lit = [&](const SeenPoint& point) {
      SharedLightWorkspace& work = workspaces.local();
      punctual_arrivals(light, receiver_of(light, point), work.point, work.arrivals);
      Rgb sum(0.0);
      for (const PunctualArrival& arrival : work.arrivals)
        sum += arrival.irradiance;
      return static_cast<float>(largest(sum));
    };
  const float dark = dark_share * mean_light(field);
  const auto has_edge = [&](ElementId element, double pixels) {
    return has_edge_of_light(field, element, pixels, dark, how);
  };
  ViewField result =
      ViewRefiner(field, SeenCells(light.mesh, std::move(seen), apart, has_edge, lit), how, progress).refined();
  for (const SharedLightWorkspace& work : workspaces)
    result.shadow_rays += work.point.shadow_rays;
  return result;
}

} // namespace meninas
