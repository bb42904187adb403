// Plane classes, in two steps: regions are gathered around the widest one whose plane they may share, then the gathering
// is kept as far as one plane really holds all their vertices.
#include "scenes/neighbour_grid.h"
#include "scenes/regions.h"

#include <Eigen/Eigenvalues>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
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

/// Fixed, oblique to the planes people build: tells the two orientations of a plane apart.
const Direction orientation = glm::normalize(Vec3(0.5309, 0.6713, 0.5171));

/// Planes that are looked at per region: a bound on the time that scenes of very many nearly equal planes take.
constexpr int most_candidates = 256;

class PlaneClassifier {
public:
  PlaneClassifier(const Scene& scene, const std::vector<Region>& regions, double tolerance)
      : scene_(scene), regions_(regions), tolerance_(tolerance) {
    const Bounds bounds = bounds_of(scene);
    middle_ = 0.5 * bounds.low + 0.5 * bounds.high;
    reach_ = 0.5 * glm::distance(bounds.low, bounds.high);
    for (std::size_t r = 0; r < regions.size(); ++r) {
      pieces_.push_back(piece_of(static_cast<std::uint32_t>(r)));
    }
    tbb::parallel_sort(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) {
      return std::tie(b.width, a.region) < std::tie(a.width, b.region);
    });
  }

  PlaneClasses classify() {
    gather();
    PlaneClasses classes;
    classes.of_region.assign(regions_.size(), none<PlaneId>);
    for (const auto& members : gathered_) {
      settle(members, classes);
    }
    return classes;
  }

private:
  using Key = NeighbourGrid<4>::Point;

  Piece piece_of(std::uint32_t r) const {
    Bounds bounds;
    for (const TriangleId triangle : regions_[r].triangles) {
      for (const Point3& corner : corners(scene_, triangle)) {
        bounds.low = glm::min(bounds.low, corner);
        bounds.high = glm::max(bounds.high, corner);
      }
    }
    const double length = glm::distance(bounds.low, bounds.high);
    const double width = length > 0.0 ? regions_[r].area / length : 0.0;
    const double uncertainty = width > tolerance_ ? tolerance_ / width : 1.0;
    return {r, 0.5 * bounds.low + 0.5 * bounds.high, width, uncertainty};
  }

  /// Normal and offset from the middle of the scene, the offset in units of its reach: errors of both are alike.
  Key key_of(const Plane& plane, double sign) const {
    const Direction n = sign * plane.normal;
    return {n.x, n.y, n.z, sign * signed_distance(plane, middle_) / std::max(reach_, tolerance_)};
  }

  double canonical_sign(const Plane& plane) const {
    return glm::dot(plane.normal, orientation) < 0.0 ? -1.0 : 1.0;
  }

  /// The region may lie in the plane, given what the piece it was taken from knows of it there.
  bool may_share(const Piece& owner, std::uint32_t r) const {
    const Plane& plane = regions_[owner.region].plane;
    for (const TriangleId triangle : regions_[r].triangles) {
      for (const Point3& corner : corners(scene_, triangle)) {
        const double slack = tolerance_ + owner.uncertainty * glm::distance(corner, owner.centre);
        if (!(std::abs(signed_distance(plane, corner)) <= slack)) {
          return false;
        }
      }
    }
    return true;
  }

  /// Pieces from the most to the least certain, in levels of alike uncertainty, each with a grid as coarse as it needs.
  void gather() {
    std::vector<std::uint32_t> owners; // per gathering, the piece that began it
    std::size_t next = 0;
    while (next < pieces_.size()) {
      const double coarsest = std::max(16.0 * pieces_[next].uncertainty, 1e-15);
      // Both planes and their offsets from the middle err by their uncertainty.
      const double radius = 4.0 * coarsest;
      NeighbourGrid<4> grid(radius);
      for (std::uint32_t g = 0; g < owners.size(); ++g) {
        add(grid, owners[g], g);
      }
      for (; next < pieces_.size() && pieces_[next].uncertainty <= coarsest; ++next) {
        const auto found = find(grid, radius, pieces_[next], owners);
        if (found != nothing) {
          gathered_[found].push_back(static_cast<std::uint32_t>(next));
          continue;
        }
        const auto fresh = static_cast<std::uint32_t>(gathered_.size());
        owners.push_back(static_cast<std::uint32_t>(next));
        gathered_.push_back({static_cast<std::uint32_t>(next)});
        add(grid, owners.back(), fresh);
      }
    }
  }

  void add(NeighbourGrid<4>& grid, std::uint32_t piece, std::uint32_t gathering) const {
    const Plane& plane = regions_[pieces_[piece].region].plane;
    grid.add(key_of(plane, canonical_sign(plane)), gathering);
  }

  std::uint32_t find(const NeighbourGrid<4>& grid, double radius, const Piece& piece,
                     const std::vector<std::uint32_t>& owners) const {
    const Plane& plane = regions_[piece.region].plane;
    std::uint32_t found = nothing;
    int candidates = 0;
    const auto visit = [&](std::uint32_t gathering) {
      if (may_share(pieces_[owners[gathering]], piece.region)) {
        found = gathering;
      }
      return found == nothing && ++candidates < most_candidates;
    };
    const double sign = canonical_sign(plane);
    grid.visit_near(key_of(plane, sign), visit);
    // A plane nearly along the fixed direction may have been filed under its other orientation.
    if (found == nothing && std::abs(glm::dot(plane.normal, orientation)) <= 2.0 * radius) {
      grid.visit_near(key_of(plane, -sign), visit);
    }
    return found;
  }

  bool holds(const Plane& plane, std::uint32_t piece) const {
    for (const TriangleId triangle : regions_[pieces_[piece].region].triangles) {
      for (const Point3& corner : corners(scene_, triangle)) {
        if (!(std::abs(signed_distance(plane, corner)) <= tolerance_)) {
          return false;
        }
      }
    }
    return true;
  }

  /// Least squares over all corners: scattered pieces together know their plane better than the widest of them alone.
  Plane fit(const std::vector<std::uint32_t>& members) const {
    const Plane& rough = regions_[pieces_[members.front()].region].plane;
    const Point3& origin = pieces_[members.front()].centre;
    Vec3 sum(0.0);
    double count = 0.0;
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    const auto each_corner = [&](auto&& visit) {
      for (const std::uint32_t member : members) {
        for (const TriangleId triangle : regions_[pieces_[member].region].triangles) {
          for (const Point3& corner : corners(scene_, triangle)) {
            visit(corner - origin);
          }
        }
      }
    };
    each_corner([&](const Vec3& x) {
      sum += x;
      count += 1.0;
    });
    const Vec3 mean = sum / count;
    each_corner([&](const Vec3& x) {
      const Eigen::Vector3d d(x.x - mean.x, x.y - mean.y, x.z - mean.z);
      squares += d * d.transpose();
    });
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares);
    const Eigen::Vector3d least = solver.eigenvectors().col(0);
    Direction normal = glm::normalize(Vec3(least.x(), least.y(), least.z()));
    normal = glm::dot(normal, rough.normal) < 0.0 ? -normal : normal;
    return {normal, glm::dot(normal, origin) + glm::dot(normal, mean)};
  }

  void settle(const std::vector<std::uint32_t>& members, PlaneClasses& classes) const {
    const auto all_in = [&](const Plane& plane) {
      return std::all_of(members.begin(), members.end(), [&](std::uint32_t m) { return holds(plane, m); });
    };
    Plane plane = regions_[pieces_[members.front()].region].plane;
    if (members.size() > 1 && !all_in(plane)) {
      const Plane fitted = fit(members);
      plane = all_in(fitted) ? fitted : plane;
    }
    const auto shared = static_cast<PlaneId>(classes.planes.size());
    classes.planes.push_back(plane);
    for (const std::uint32_t member : members) {
      const std::uint32_t region = pieces_[member].region;
      if (member == members.front() || holds(plane, member)) {
        classes.of_region[region] = shared;
      } else {
        classes.of_region[region] = static_cast<PlaneId>(classes.planes.size());
        classes.planes.push_back(regions_[region].plane);
      }
    }
  }

  static constexpr std::uint32_t nothing = 0xffffffffU;
  const Scene& scene_;
  const std::vector<Region>& regions_;
  double tolerance_;
  Point3 middle_{0.0};
  double reach_ = 0.0;
  std::vector<Piece> pieces_; ///< by falling width
  std::vector<std::vector<std::uint32_t>> gathered_;
};

} // namespace

PlaneClasses classify_planes(const Scene& scene, const std::vector<Region>& regions, double tolerance) {
  return PlaneClassifier(scene, regions, tolerance).classify();
}

} // namespace meninas
