// Plane classes, in two steps: regions are gathered around the widest one whose plane they may
// share, then the gathering is kept as far as one plane really holds all their vertices.
#include "scenes/surfaces/plane_search.h"
#include "scenes/surfaces/principal_axes.h"
#include "scenes/surfaces/regions.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

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

class PlaneClassifier {
public:
  PlaneClassifier(const Scene& scene, const Regions& regions, const Precision& precision)
      : scene_(scene), regions_(regions), tolerance_(precision.in_detail()) {
    const Bounds bounds = bounds_of(scene);
    middle_ = 0.5 * bounds.low + 0.5 * bounds.high;
    reach_ = 0.5 * glm::distance(bounds.low, bounds.high);
    pieces_.reserve(regions.regions.size());
    for (std::size_t r = 0; r < regions.regions.size(); ++r) {
      pieces_.push_back(piece_of(static_cast<std::uint32_t>(r)));
    }
    tbb::parallel_sort(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) {
      return std::tie(b.width, a.region) < std::tie(a.width, b.region);
    });
  }

  PlaneClasses classify() const {
    const std::vector<std::uint32_t> gathering = gather();
    // Pieces by gathering, the widest of each first as before.
    std::vector<std::uint32_t> first(gathering.size() + 1, 0);
    for (const std::uint32_t g : gathering) {
      ++first[g + 1];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> members(gathering.size());
    std::vector<std::uint32_t> next = first;
    for (std::uint32_t piece = 0; piece < gathering.size(); ++piece) {
      members[next[gathering[piece]]++] = piece;
    }
    PlaneClasses classes;
    classes.of_region.assign(regions_.regions.size(), none<PlaneId>);
    for (std::size_t g = 0; g < gathering.size() && first[g] < first[g + 1]; ++g) {
      settle(std::span(members).subspan(first[g], first[g + 1] - first[g]), classes);
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

  /// The gathering of each piece.
  ///
  /// Pieces come from the widest to the narrowest, and join the first gathering that may share its
  /// plane with them.
  std::vector<std::uint32_t> gather() const {
    std::vector<std::uint32_t> gathering(pieces_.size());
    PlaneSearch planes(middle_, std::max(reach_, tolerance_));
    std::vector<std::uint32_t> gathering_of_plane;
    std::uint32_t gatherings = 0;
    for (std::uint32_t k = 0; k < pieces_.size(); ++k) {
      const Piece& piece = pieces_[k];
      const bool is_vague = piece.uncertainty >= vaguest;
      const auto found = is_vague ? std::nullopt : find(planes, piece);
      if (found) {
        gathering[k] = gathering_of_plane[*found];
        continue;
      }
      gathering[k] = gatherings++;
      if (!is_vague) {
        planes.add({region_of(k).plane, piece.centre, piece.uncertainty});
        gathering_of_plane.push_back(gathering[k]);
      }
    }
    return gathering;
  }

  std::optional<std::uint32_t> find(const PlaneSearch& planes, const Piece& piece) const {
    const Region& region = regions_.regions[piece.region];
    return planes.first({.plane = region.plane,
                         .points = corners(scene_, triangles_of(regions_, region).front()),
                         .tolerance = region.tolerance,
                         .radius = look_up_radius(piece.uncertainty)},
                        [&](std::uint32_t k) { return may_share(planes[k], region); });
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

  void settle(Members members, PlaneClasses& classes) const {
    const auto holds_all = [&](const Plane& plane) {
      return std::all_of(members.begin(), members.end(),
                         [&](std::uint32_t member) { return holds(plane, region_of(member)); });
    };
    Plane plane = region_of(members.front()).plane;
    if (members.size() > 1 && !holds_all(plane)) {
      const Plane fitted = fit(members);
      plane = holds_all(fitted) ? fitted : plane;
    }
    const auto shared = static_cast<PlaneId>(classes.planes.size());
    classes.planes.push_back(plane);
    for (const std::uint32_t member : members) {
      PlaneId& of_region = classes.of_region[pieces_[member].region];
      if (member == members.front() || holds(plane, region_of(member))) {
        of_region = shared;
      } else {
        of_region = static_cast<PlaneId>(classes.planes.size());
        classes.planes.push_back(region_of(member).plane);
      }
    }
  }

  const Scene& scene_;
  const Regions& regions_;
  double tolerance_;
  Point3 middle_{0.0};
  double reach_ = 0.0;
  std::vector<Piece> pieces_; ///< by falling width
};

} // namespace

PlaneClasses classify_planes(const Scene& scene, const Regions& regions,
                             const Precision& precision) {
  return PlaneClassifier(scene, regions, precision).classify();
}

} // namespace meninas
