#include "radiosity/light/secondary_emitters.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace meninas {

namespace {

/// Root cells i0 .. i1 - 1 by j0 .. j1 - 1 of a quad side, or one cell of any side.
struct Block {
  std::uint32_t side;
  int i0, i1, j0, j1;
  CellId cell = none<CellId>;
};

struct BrightBlock {
  Block block;
  Rgb radiosity{0.0};
  double noise =
      0.0; ///< what gathering it by chance would cost: radiosity times the root of the area
};

/// The state of the recursion over the blocks.
struct ClusterSearch {
  const ElementMesh& mesh;
  const std::vector<Rgb>& sent; ///< by ElementId: the reflected radiosity, over holes too
  double threshold;
  double evenness;
  std::vector<BrightBlock> found;
};

CellId root_at(const MeshSide& side, int i, int j) {
  return static_cast<CellId>(side.first_cell + static_cast<std::uint32_t>(j * side.nu + i));
}

/// Calls visit(element) for every element of the block.
template <typename Visit>
void for_each_element(const ElementMesh& mesh, const Block& block, Visit&& visit) {
  const auto visit_cell = [&](CellId id) {
    const MeshCell& cell = mesh.cells[index(id)];
    for (std::uint32_t k = 0; k < cell.element_count; ++k)
      visit(cell.first_element + k);
  };
  if (block.cell != none<CellId>) {
    visit_cell(block.cell);
    return;
  }
  for (int j = block.j0; j < block.j1; ++j)
    for (int i = block.i0; i < block.i1; ++i)
      visit_cell(root_at(mesh.sides[block.side], i, j));
}

/// Calls visit(block) for the parts of a block, none for an element.
template <typename Visit>
void for_each_part(const ElementMesh& mesh, const Block& block, Visit&& visit) {
  const int width = block.i1 - block.i0, height = block.j1 - block.j0;
  if (block.cell == none<CellId> && width * height > 1) {
    const int im = width > 1 ? block.i0 + width / 2 : block.i1,
              jm = height > 1 ? block.j0 + height / 2 : block.j1;
    visit({block.side, block.i0, im, block.j0, jm});
    if (im < block.i1)
      visit({block.side, im, block.i1, block.j0, jm});
    if (jm < block.j1)
      visit({block.side, block.i0, im, jm, block.j1});
    if (im < block.i1 && jm < block.j1)
      visit({block.side, im, block.i1, jm, block.j1});
    return;
  }
  const CellId cell =
      block.cell == none<CellId> ? root_at(mesh.sides[block.side], block.i0, block.j0) : block.cell;
  const CellId child = mesh.cells[index(cell)].first_child;
  for (std::uint32_t k = 0; child != none<CellId> && k < 4; ++k)
    visit({block.side, 0, 0, 0, 0, static_cast<CellId>(index(child) + k)});
}

/// Takes the block as one cluster if all of it is bright and alike; otherwise looks into its parts.
void search(ClusterSearch& context, const Block& block) {
  double low = std::numeric_limits<double>::infinity(), high = 0.0, area = 0.0;
  Rgb sum(0.0);
  for_each_element(context.mesh, block, [&](std::uint32_t element) {
    const double value = largest(context.sent[element]);
    low = std::min(low, value);
    high = std::max(high, value);
    area += context.mesh.area[element];
    sum += context.mesh.area[element] * context.sent[element];
  });
  if (high < context.threshold || area <= 0.0)
    return;
  if (low >= context.threshold && high <= context.evenness * low) {
    context.found.push_back({block, sum / area, largest(sum) / std::sqrt(area)});
    return;
  }
  for_each_part(context.mesh, block, [&](const Block& part) { search(context, part); });
}

void search_sides(ClusterSearch& context) {
  for (std::uint32_t s = 0; s < context.mesh.sides.size(); ++s) {
    const MeshSide& side = context.mesh.sides[s];
    if (!side.triangle) {
      search(context, {s, 0, side.nu, 0, side.nv});
      continue;
    }
    for (std::uint32_t k = 0; k < side.root_count; ++k)
      search(context, {s, 0, 0, 0, 0, static_cast<CellId>(side.first_cell + k)});
  }
}

Emitter make_emitter(const LightScene& light, const BrightBlock& candidate) {
  const MeshSide& side = light.mesh.sides[candidate.block.side];
  const Patch& patch = light.surfaces.patches[index(side.patch)];
  const Block& block = candidate.block;
  std::vector<Point3> corners;
  if (block.cell != none<CellId>) {
    const MeshCell& cell = light.mesh.cells[index(block.cell)];
    for (const Vec2 st : {Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(1.0, 1.0), Vec2(0.0, 1.0)})
      if (!side.triangle || st != Vec2(1.0))
        corners.push_back(point_at(patch, patch_uv_of(light.mesh, cell, st)));
  } else {
    const auto corner = [&](int i, int j) {
      return point_at(patch, Vec2(double(i) / side.nu, double(j) / side.nv));
    };
    corners = {corner(block.i0, block.j0), corner(block.i1, block.j0), corner(block.i1, block.j1),
               corner(block.i0, block.j1)};
  }
  if (side.facing == Facing::back)
    std::reverse(corners.begin(), corners.end());
  Emitter emitter;
  emitter.corners = corners;
  emitter.plane = side.plane;
  emitter.plane_class = side.plane_class;
  emitter.coat = side.coat;
  emitter.radiosity = candidate.radiosity;
  emitter.area = glm::length(area_vector(emitter.corners));
  return emitter;
}

/// The radiosity of elements spread over their holes, since only the solid part reflects:
/// shadow rays go to the holes of a cluster as well, and nothing there stops them.
std::vector<Rgb> spread_over_holes(const ElementMesh& mesh, const std::vector<Rgb>& reflected) {
  std::vector<Rgb> sent(reflected.size());
  for (std::size_t e = 0; e < sent.size(); ++e)
    sent[e] = double{mesh.solid[e]} * reflected[e];
  return sent;
}

/// Half of the lit area is darker than this.
/// (A mean would follow the few bright elements that are looked for.)
double area_median(const ElementMesh& mesh, const std::vector<Rgb>& reflected) {
  std::vector<std::pair<double, double>> values; // radiosity and area
  double area = 0.0;
  for (std::size_t i = 0; i < mesh.area.size(); ++i) {
    const double value = largest(reflected[i]);
    if (value <= 0.0)
      continue;
    values.emplace_back(value, mesh.area[i]);
    area += mesh.area[i];
  }
  std::sort(values.begin(), values.end());
  double below = 0.0;
  for (const auto& [value, share] : values)
    if ((below += share) >= 0.5 * area)
      return value;
  return 0.0;
}

/// The real world, and the worlds of single mirrors while they are few,
/// without coats if there are more with them.
WorldTree first_worlds(const WorldTree& tree, const MirrorSet& mirrors) {
  constexpr std::size_t few = 4;
  std::size_t kept = 1, of_mirrors = 1;
  for (; kept < tree.worlds.size() && tree.worlds[kept].depth == 1; ++kept)
    of_mirrors += mirrors.mirrors[index(tree.worlds[kept].mirror)].is_coat ? 0 : 1;
  if (kept > few)
    kept = of_mirrors > few ? 1 : of_mirrors;
  WorldTree first;
  first.worlds.assign(tree.worlds.begin(), tree.worlds.begin() + static_cast<std::ptrdiff_t>(kept));
  first.children.assign(tree.children.begin(),
                        tree.children.begin() + static_cast<std::ptrdiff_t>(kept));
  for (auto& children : first.children)
    for (auto& child : children)
      if (child != none<WorldId> && index(child) >= kept)
        child = none<WorldId>;
  return first;
}

/// By ElementId: whether one of the clusters has it.
std::vector<std::uint8_t> owned_by(const ElementMesh& mesh, const std::vector<BrightBlock>& found) {
  std::vector<std::uint8_t> owned(mesh.area.size(), 0);
  for (const BrightBlock& candidate : found)
    for_each_element(mesh, candidate.block, [&](std::uint32_t element) { owned[element] = 1; });
  return owned;
}

/// Leaves to rays all but the noisiest,
/// and of these the ones that together add no more than a share to the noise that rays have anyway:
/// the sum of A B^2 over what they find, which the variance of a mean over directions goes by.
void keep_noisiest(const ElementMesh& mesh, const std::vector<Rgb>& sent,
                   const ClusterSettings& settings, std::size_t most,
                   std::vector<BrightBlock>& found) {
  const std::vector<std::uint8_t> owned = owned_by(mesh, found);
  double of_rays = 0.0, added = 0.0;
  for (std::size_t e = 0; e < sent.size(); ++e)
    of_rays += owned[e] != 0 ? 0.0 : mesh.area[e] * std::pow(largest(sent[e]), 2.0);
  std::ranges::stable_sort(found, std::greater{}, &BrightBlock::noise);
  found.resize(std::min(found.size(), most));
  for (; !found.empty(); found.pop_back()) {
    added += found.back().noise * found.back().noise;
    if (added > settings.spared * of_rays)
      return;
  }
}

} // namespace

SecondaryEmitters find_secondary_emitters(const LightScene& light, const std::vector<Rgb>& reflected,
                                    const ClusterSettings& settings) {
  const ElementMesh& mesh = light.mesh;
  SecondaryEmitters clusters;
  clusters.owned.assign(mesh.area.size(), 0);
  const double usual = area_median(mesh, reflected);
  if (usual <= 0.0)
    return clusters;

  // If there are too many, the noisiest are kept. Uneven clusters would be fewer,
  // but the brightness of a wall beside a point is not that of its mean.
  clusters.worlds = first_worlds(light.worlds, light.mirrors);
  const std::size_t most = settings.most / clusters.worlds.worlds.size();
  const std::vector<Rgb> sent = spread_over_holes(mesh, reflected);
  ClusterSearch context{mesh, sent, settings.contrast * usual, settings.evenness, {}};
  search_sides(context);
  if (context.found.size() > most || settings.spared > 0.0)
    keep_noisiest(mesh, sent, settings, most, context.found);
  clusters.owned = owned_by(mesh, context.found);
  for (const auto& candidate : context.found) {
    clusters.emitters.push_back(make_emitter(light, candidate));
    auto& elements = clusters.elements.emplace_back();
    for_each_element(mesh, candidate.block, [&](std::uint32_t e) { elements.push_back(e); });
  }
  return clusters;
}

} // namespace meninas
