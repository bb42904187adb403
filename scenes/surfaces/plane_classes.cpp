// Plane classes, in two steps: regions are gathered around the widest one whose plane they may
// share, then the gathering is kept as far as one plane really holds all their vertices.
#include "scenes/surfaces/plane_classes.h"

#include "scenes/surfaces/patches.h"
#include "scenes/surfaces/plane_search.h"
#include "scenes/surfaces/principal_axes.h"
#include "scenes/surfaces/regions.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace meninas {
namespace {

/// A region as a piece of evidence for a plane.
struct Piece {
  std::uint32_t region = 0;
  Point3 centre{0.0};
  double width = 0.0;       ///< the narrower extent
  double uncertainty = 0.0; ///< of its normal, in radians
};

/// Pieces that know their normals less well than this, in radians, say nothing about the planes of
/// others.
constexpr double vaguest = 0.1;

/// Normals of doubles are not more certain than this.
constexpr double finest = 1e-15;

/// How far the keys of two pieces of one plane may be apart: the normals of both err by the
/// uncertainty, the offsets from the middle of the scene by that times up to two reaches each.
double look_up_radius(double uncertainty) { return 4.0 * std::max(uncertainty, finest); }

/// Pieces that are looked up together among the planes of those before them all.
constexpr std::size_t batch = 512;

struct PlaneClasses {
  std::vector<Plane> planes;
  std::vector<PlaneId> of_region;
};

class PlaneClassifier {
public:
  PlaneClassifier(const Scene& scene, const Regions& regions, double tolerance)
      : scene_(scene), regions_(regions), tolerance_(tolerance) {
    const Bounds bounds = bounds_of(scene);
    middle_ = 0.5 * bounds.low + 0.5 * bounds.high;
    reach_ = 0.5 * glm::distance(bounds.low, bounds.high);
    pieces_.resize(regions.regions.size());
    tbb::parallel_for(std::size_t{0}, pieces_.size(), [&](std::size_t r) {
      pieces_[r] = piece_of(static_cast<std::uint32_t>(r));
    });
    tbb::parallel_sort(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) {
      return std::tie(b.width, a.region) < std::tie(a.width, b.region);
    });
  }

  PlaneClasses classify() const {
    const Gatherings gatherings = gather();
    // Pieces by gathering, the widest of each first as before.
    std::vector<std::uint32_t> first(gatherings.count + 1, 0);
    for (const std::uint32_t g : gatherings.of_piece) {
      ++first[g + 1];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> members(pieces_.size());
    std::vector<std::uint32_t> next = first;
    for (std::uint32_t piece = 0; piece < pieces_.size(); ++piece) {
      members[next[gatherings.of_piece[piece]]++] = piece;
    }
    const auto members_of = [&](std::size_t g) {
      return std::span(members).subspan(first[g], first[g + 1] - first[g]);
    };
    std::vector<Plane> shared(gatherings.count);
    std::vector<std::uint8_t> shares(pieces_.size());
    tbb::parallel_for(std::size_t{0}, shared.size(),
                      [&](std::size_t g) { shared[g] = settle(members_of(g), shares); });
    PlaneClasses classes;
    classes.of_region.resize(pieces_.size());
    for (std::size_t g = 0; g < shared.size(); ++g) {
      const auto common = static_cast<PlaneId>(classes.planes.size());
      classes.planes.push_back(shared[g]);
      for (const std::uint32_t member : members_of(g)) {
        const auto own = static_cast<PlaneId>(classes.planes.size());
        classes.of_region[pieces_[member].region] = shares[member] != 0 ? common : own;
        if (shares[member] == 0) {
          classes.planes.push_back(region_of(member).plane);
        }
      }
    }
    return classes;
  }

private:
  using Members = std::span<const std::uint32_t>; ///< pieces

  const Region& region_of(std::uint32_t piece) const {
    return regions_.regions[pieces_[piece].region];
  }

  template <typename Test>
  bool every_corner(const Region& region, Test&& test) const {
    for (const TriangleId triangle : triangles_of(regions_, region)) {
      for (const Point3& corner : corners(scene_, triangle)) {
        if (!test(corner)) {
          return false;
        }
      }
    }
    return true;
  }

  Piece piece_of(std::uint32_t r) const {
    const Region& region = regions_.regions[r];
    Bounds bounds;
    every_corner(region, [&](const Point3& corner) {
      bounds.low = glm::min(bounds.low, corner);
      bounds.high = glm::max(bounds.high, corner);
      return true;
    });
    const double length = glm::distance(bounds.low, bounds.high);
    const double width = length > 0.0 ? region.area / length : 0.0;
    const double uncertainty = width > region.tolerance ? region.tolerance / width : 1.0;
    return {r, 0.5 * bounds.low + 0.5 * bounds.high, width, uncertainty};
  }

  /// The region may lie in the plane, given what its owner knows of it there.
  bool may_share(const KnownPlane& owner, const Region& region) const {
    return every_corner(region, [&](const Point3& corner) {
      const double slack =
          region.tolerance + owner.uncertainty * glm::distance(corner, owner.centre);
      return std::abs(signed_distance(owner.plane, corner)) <= slack;
    });
  }

  bool holds(const Plane& plane, const Region& region) const {
    return every_corner(region, [&](const Point3& corner) {
      return std::abs(signed_distance(plane, corner)) <= region.tolerance;
    });
  }

  struct Gatherings {
    std::vector<std::uint32_t> of_piece;
    std::uint32_t count = 0;
  };

  /// Pieces come from the widest to the narrowest, and join the first gathering that may share its
  /// plane with them. A batch of them is looked up at once among the planes of those before it all,
  /// which go before the planes of the batch.
  Gatherings gather() const {
    Gatherings gatherings{std::vector<std::uint32_t>(pieces_.size())};
    PlaneSearch planes(middle_, std::max(reach_, tolerance_));
    std::vector<std::uint32_t> gathering_of_plane;
    std::array<std::optional<std::uint32_t>, batch> settled;
    for (std::size_t begin = 0; begin < pieces_.size(); begin += batch) {
      const std::size_t end = std::min(begin + batch, pieces_.size());
      tbb::parallel_for(begin, end, [&](std::size_t k) {
        settled[k - begin] = is_vague(k) ? std::nullopt : find(planes, k, &PlaneSearch::first_settled);
      });
      for (std::size_t k = begin; k < end; ++k) {
        auto found = settled[k - begin];
        if (!found && !is_vague(k)) {
          found = find(planes, k, &PlaneSearch::first_recent);
        }
        gatherings.of_piece[k] = found ? gathering_of_plane[*found] : gatherings.count++;
        if (!found && !is_vague(k)) {
          const Piece& piece = pieces_[k];
          planes.add({regions_.regions[piece.region].plane, piece.centre, piece.uncertainty});
          gathering_of_plane.push_back(gatherings.of_piece[k]);
        }
      }
      planes.settle();
    }
    return gatherings;
  }

  bool is_vague(std::size_t piece) const { return pieces_[piece].uncertainty >= vaguest; }

  /// `first_of`: in which part of the planes it is looked for.
  std::optional<std::uint32_t> find(const PlaneSearch& planes, std::size_t k,
                                    decltype(&PlaneSearch::first) first_of) const {
    const Piece& piece = pieces_[k];
    const Region& region = regions_.regions[piece.region];
    const PlaneQuery query{.plane = region.plane,
                           .points = corners(scene_, triangles_of(regions_, region).front()),
                           .tolerance = region.tolerance,
                           .radius = look_up_radius(piece.uncertainty)};
    return (planes.*first_of)(query,
                              [&](std::uint32_t p) { return may_share(planes[p], region); });
  }

  /// Least squares over all corners: scattered pieces together know their plane better than the
  /// widest of them alone.
  Plane fit(Members members) const {
    const Plane& rough = region_of(members.front()).plane;
    const Point3& origin = pieces_[members.front()].centre;
    std::vector<Vec3> offsets;
    for (const std::uint32_t member : members) {
      every_corner(region_of(member), [&](const Point3& corner) {
        offsets.push_back(corner - origin);
        return true;
      });
    }
    return fitted_plane(offsets, origin, rough.normal);
  }

  /// The plane of a gathering, and which of its members it holds.
  Plane settle(Members members, std::vector<std::uint8_t>& shares) const {
    const auto holds_all = [&](const Plane& plane) {
      return std::all_of(members.begin(), members.end(),
                         [&](std::uint32_t member) { return holds(plane, region_of(member)); });
    };
    Plane plane = region_of(members.front()).plane;
    if (members.size() > 1 && !holds_all(plane)) {
      const Plane fitted = fit(members);
      plane = holds_all(fitted) ? fitted : plane;
    }
    for (const std::uint32_t member : members) {
      shares[member] = member == members.front() || holds(plane, region_of(member)) ? 1 : 0;
    }
    return plane;
  }

  const Scene& scene_;
  const Regions& regions_;
  double tolerance_;
  Point3 middle_{0.0};
  double reach_ = 0.0;
  std::vector<Piece> pieces_; ///< by falling width
};

/// The surfaces as regions again, with their triangles in ascending order.
Regions regions_of(const SurfaceModel& model) {
  Regions regions;
  for (const Surface& surface : model.surfaces) {
    regions.regions.push_back({surface.plane, surface.area, surface.tolerance, 0, 0});
  }
  const auto region_of = [&](PatchId patch) -> Region& {
    return regions.regions[index(model.patches[index(patch)].surface)];
  };
  for (const PatchId patch : model.patch_of_triangle) {
    ++region_of(patch).count;
  }
  std::uint32_t first = 0;
  for (Region& region : regions.regions) {
    region.first = first;
    first += std::exchange(region.count, 0);
  }
  regions.members.resize(first);
  for (std::uint32_t t = 0; t < model.patch_of_triangle.size(); ++t) {
    Region& region = region_of(model.patch_of_triangle[t]);
    regions.members[region.first + region.count++] = TriangleId{t};
  }
  return regions;
}

} // namespace

void find_plane_classes(const Scene& scene, SurfaceModel& model) {
  if (model.surfaces.empty()) {
    return;
  }
  const Regions regions = regions_of(model);
  PlaneClasses classes = PlaneClassifier(scene, regions, model.tolerance).classify();
  model.planes = std::move(classes.planes);
  for (std::size_t s = 0; s < model.surfaces.size(); ++s) {
    model.surfaces[s].plane_class = classes.of_region[s];
    for (const TriangleId triangle : triangles_of(regions, regions.regions[s])) {
      model.plane_of_triangle[index(triangle)] = classes.of_region[s];
    }
  }
}

SurfaceModel find_surfaces(const Scene& scene) {
  SurfaceModel model = find_patches(scene);
  find_plane_classes(scene, model);
  return model;
}

} // namespace meninas
