#include "form_factors/clear_form_factors.h"

#include "form_factors/area_form_factor.h"

#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>

namespace meninas {

namespace {

/// Whether nothing can stand between two faces.
bool is_clear(const WorldView& view, const Face& a, const Face& b) {
  const ConvexPolygon lit = clip(a.polygon, b.polygon.vertices[0], b.plane.normal);
  const ConvexPolygon seen = clip(b.polygon, a.polygon.vertices[0], a.plane.normal);
  if (lit.empty() || seen.empty())
    return true;
  return std::all_of(view.blockers.begin(), view.blockers.end(), [&](const Face& blocker) {
    return blocker.plane_class == a.plane_class || blocker.plane_class == b.plane_class ||
           holds_apart(lit, seen, blocker.polygon, view.tolerance);
  });
}

} // namespace

ClearFormFactors clear_form_factors(const WorldView& view, const std::vector<Face>& from,
                                    std::size_t group_count) {
  // Beyond this many triples of faces the search for clear
  // pairs would take longer than the points it saves.
  constexpr double max_triples = 2e7;
  ClearFormFactors clear;
  clear.known.assign(from.size(), std::vector<std::uint8_t>(view.targets.size(), 0));
  clear.factors.assign(group_count, {});
  const double triples = static_cast<double>(from.size() * view.targets.size()) *
                         static_cast<double>(view.blockers.size());
  if (triples > max_triples)
    return clear;
  double area = 0.0;
  for (const Face& face : from)
    area += face.area;
  std::vector<std::vector<Estimate>> factors(from.size(),
                                             std::vector<Estimate>(view.targets.size()));
  // The loop is isolated from a caller's cancellation, because half of the result would be read.
  tbb::task_group_context alone(tbb::task_group_context::isolated);
  tbb::parallel_for(std::size_t{0}, from.size() * view.targets.size(), [&](std::size_t k) {
    const std::size_t a = k / view.targets.size(), b = k % view.targets.size();
    const Face& target = view.targets[b];
    if (!is_clear(view, from[a], target))
      return;
    clear.known[a][b] = 1;
    if (from[a].plane_class != target.plane_class)
      factors[a][b] = area_form_factor(from[a].polygon, target.polygon);
  }, alone);
  for (std::size_t a = 0; a < from.size(); ++a)
    for (std::size_t b = 0; b < view.targets.size(); ++b)
      clear.factors[view.groups[b]] =
          clear.factors[view.groups[b]] + from[a].area / area * factors[a][b];
  return clear;
}

} // namespace meninas
