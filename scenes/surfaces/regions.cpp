#include "scenes/surfaces/regions.h"

#include "scenes/surfaces/disjoint_sets.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace meninas {
namespace {

/// Normals of neighbours in one wall may differ by this much before the distances of their vertices
/// are asked, in radians.
constexpr double angle_tolerance = 1e-4;

/// The plane of a growing region: its normal is the sum of the area vectors, to which only the
/// region's boundary contributes, so rounded vertices of a fine tessellation cancel; its offset is
/// the area-weighted mean.
class PlaneFit {
public:
  explicit PlaneFit(const Point3& origin) : origin_(origin) {}

  void add(const std::array<Point3, 3>& corners, const TriangleShape& shape) {
    area_vector_ += shape.area * shape.normal;
    moment_ += shape.area *
               ((corners[0] - origin_) + (corners[1] - origin_) + (corners[2] - origin_)) / 3.0;
    area_ += shape.area;
  }

  Plane plane() const {
    const Direction normal = glm::normalize(area_vector_);
    return {normal, glm::dot(normal, origin_) + glm::dot(normal, moment_) / area_};
  }

private:
  Point3 origin_;
  Vec3 area_vector_{0.0};
  Vec3 moment_{0.0};
  double area_ = 0.0;
};

/// What growing leaves at triangles and edges.
struct Marks {
  std::vector<std::uint8_t> taken;  ///< by triangle: it is in a region, or to be in none
  std::vector<std::uint32_t> asked; ///< by edge, the round in which it was asked last
};

/// Regions of triangles that are connected by edges. What is not can be grown at the same time.
class RegionGrower {
public:
  RegionGrower(const Scene& scene, const std::vector<TriangleShape>& shapes,
               const Topology& topology, std::span<const double> tolerances, Marks& marks)
      : scene_(scene), shapes_(shapes), topology_(topology), tolerances_(tolerances),
        taken_(marks.taken), asked_(marks.asked) {}

  /// The regions around the seeds that no region before has taken. Their triangles fill `members`
  /// from place `first` on.
  void grow(std::span<const TriangleId> seeds, std::uint32_t first,
            std::vector<TriangleId>& members) {
    for (const TriangleId seed : seeds) {
      if (is_taken(seed)) {
        continue;
      }
      Region& region = regions_.emplace_back(grow(seed));
      region.first = first;
      std::ranges::copy(triangles_, members.begin() + first);
      first += region.count;
    }
  }

  const std::vector<Region>& regions() const { return regions_; }

private:
  bool is_taken(TriangleId triangle) const { return taken_[index(triangle)] != 0; }

  /// The region around the seed, which is that of triangles_.
  Region grow(TriangleId seed) {
    region_ = {};
    triangles_.clear();
    const auto seed_corners = corners(scene_, seed);
    material_ = scene_.triangles[index(seed)].material;
    fit_ = PlaneFit(seed_corners[0]);
    const Direction normal = shapes_[index(seed)].normal;
    region_.plane = {normal, glm::dot(normal, seed_corners[0])};
    ++round_;
    take(seed);
    std::size_t next = 0;
    std::size_t fitted = 1;
    while (next < triangles_.size()) {
      expand(triangles_[next++]);
      const std::size_t size = triangles_.size();
      const bool stalled = next == size;
      // Fits at growing sizes only, so that all of them together cost no more than a few passes
      // over the region.
      if (size >= 2 * fitted || (stalled && size > fitted + fitted / 8)) {
        fitted = size;
        if (refit()) {
          // The better plane may fit triangles that the former one left out, so all edges are asked
          // again.
          ++round_;
          next = 0;
        }
      }
    }
    std::sort(triangles_.begin(), triangles_.end());
    region_.count = static_cast<std::uint32_t>(triangles_.size());
    return region_;
  }

  void take(TriangleId triangle) {
    const TriangleShape& shape = shapes_[index(triangle)];
    taken_[index(triangle)] = 1;
    fit_.add(corners(scene_, triangle), shape);
    triangles_.push_back(triangle);
    region_.area += shape.area;
    region_.tolerance = std::max(region_.tolerance, tolerances_[index(triangle)]);
  }

  void expand(TriangleId triangle) {
    for (const std::uint32_t edge : topology_.edge_of[index(triangle)]) {
      // An edge gives one answer per plane: edges of very many triangles are not asked by each of
      // them.
      if (edge == no_edge || asked_[edge] == round_) {
        continue;
      }
      asked_[edge] = round_;
      for (const EdgeUse& use : uses_of(topology_, edge)) {
        if (!is_taken(use.triangle) && belongs(use.triangle)) {
          take(use.triangle);
        }
      }
    }
  }

  bool belongs(TriangleId triangle) const {
    if (scene_.triangles[index(triangle)].material != material_) {
      return false;
    }
    const TriangleShape& shape = shapes_[index(triangle)];
    // Moving one corner by the tolerance turns the triangle about the opposite edge by tolerance /
    // height.
    const double angle =
        angle_tolerance + (shape.height > 0.0 ? tolerances_[index(triangle)] / shape.height : 2.0);
    const double sine = glm::length(glm::cross(shape.normal, region_.plane.normal));
    const bool same_front = glm::dot(shape.normal, region_.plane.normal) > 0.0;
    return same_front && sine <= angle && within(triangle, region_.plane);
  }

  bool within(TriangleId triangle, const Plane& plane) const {
    const double tolerance = tolerances_[index(triangle)];
    for (const Point3& corner : corners(scene_, triangle)) {
      if (!(std::abs(signed_distance(plane, corner)) <= tolerance)) {
        return false;
      }
    }
    return true;
  }

  /// Takes the fitted plane if all triangles follow it: a region that bends away slowly keeps the
  /// plane it began with.
  bool refit() {
    const Plane plane = fit_.plane();
    const bool all = std::all_of(triangles_.begin(), triangles_.end(),
                                 [&](TriangleId triangle) { return within(triangle, plane); });
    if (all) {
      region_.plane = plane;
    }
    return all;
  }

  const Scene& scene_;
  const std::vector<TriangleShape>& shapes_;
  const Topology& topology_;
  std::span<const double> tolerances_;
  std::vector<std::uint8_t>& taken_;
  std::vector<std::uint32_t>& asked_;
  std::uint32_t round_ = 0;
  MaterialId material_ = none<MaterialId>;
  PlaneFit fit_{Point3(0.0)};
  Region region_;
  std::vector<TriangleId> triangles_;
  std::vector<Region> regions_;
};

/// Triangles by what they are connected with over edges.
struct Components {
  std::vector<std::uint32_t> begin; ///< by component, and the end
  std::vector<TriangleId> members;  ///< ascending
};

Components components_of(const Topology& topology, std::size_t triangles) {
  DisjointSets sets(triangles);
  for (std::uint32_t edge = 0; edge + 1 < topology.first_use.size(); ++edge) {
    const auto uses = uses_of(topology, edge);
    for (const EdgeUse& use : uses.subspan(1)) {
      sets.join(index(uses[0].triangle), index(use.triangle));
    }
  }
  // A root is the first of its component.
  Components components{{0}, std::vector<TriangleId>(triangles)};
  std::vector<std::uint32_t> component_of(triangles);
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const std::uint32_t root = sets.root(t);
    if (root == t) {
      component_of[t] = static_cast<std::uint32_t>(components.begin.size() - 1);
      components.begin.push_back(0);
    }
    component_of[t] = component_of[root];
    ++components.begin[component_of[t] + 1];
  }
  std::partial_sum(components.begin.begin(), components.begin.end(), components.begin.begin());
  std::vector<std::uint32_t> next = components.begin;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    components.members[next[component_of[t]]++] = TriangleId{t};
  }
  return components;
}

/// Triangles by the certainty of their planes, the widest first; equal ones by their vertices, then
/// by index.
void sort_seeds(const Scene& scene, const std::vector<TriangleShape>& shapes,
                std::span<TriangleId> seeds) {
  tbb::parallel_sort(seeds.begin(), seeds.end(), [&](TriangleId a, TriangleId b) {
    const double height_a = shapes[index(a)].height;
    const double height_b = shapes[index(b)].height;
    return std::tie(height_b, scene.triangles[index(a)].vertices, a) <
           std::tie(height_a, scene.triangles[index(b)].vertices, b);
  });
}

/// No region begins at a triangle.
constexpr std::uint32_t no_region = std::numeric_limits<std::uint32_t>::max();

Regions in_order_of_triangles(const Regions& grown, std::size_t triangle_count) {
  std::vector<std::uint32_t> begun_at(triangle_count, no_region);
  for (std::size_t r = 0; r < grown.regions.size(); ++r) {
    begun_at[index(grown.members[grown.regions[r].first])] = static_cast<std::uint32_t>(r);
  }
  Regions ordered;
  ordered.regions.reserve(grown.regions.size());
  ordered.members.reserve(grown.members.size());
  for (const std::uint32_t r : begun_at) {
    if (r == no_region) {
      continue;
    }
    Region region = grown.regions[r];
    const auto triangles = triangles_of(grown, region);
    region.first = static_cast<std::uint32_t>(ordered.members.size());
    ordered.members.insert(ordered.members.end(), triangles.begin(), triangles.end());
    ordered.regions.push_back(region);
  }
  return ordered;
}

} // namespace

TriangleShape shape_of(const std::array<Point3, 3>& corners) {
  TriangleShape shape;
  const Vec3 twice = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double length = glm::length(twice);
  const double longest =
      std::max({glm::distance(corners[0], corners[1]), glm::distance(corners[1], corners[2]),
                glm::distance(corners[2], corners[0])});
  if (length > 0.0) {
    shape.normal = twice / length;
    shape.area = 0.5 * length;
    shape.height = length / longest;
  }
  return shape;
}

Regions grow_regions(const Scene& scene, const std::vector<TriangleShape>& shapes,
                     const Topology& topology, std::span<const double> tolerances) {
  Components components = components_of(topology, scene.triangles.size());
  Marks marks{std::vector<std::uint8_t>(scene.triangles.size()),
              std::vector<std::uint32_t>(topology.first_use.size(), 0)};
  std::ranges::transform(tolerances, marks.taken.begin(), [](double t) { return t < 0.0 ? 1 : 0; });
  Regions grown;
  grown.members.resize(scene.triangles.size());
  tbb::enumerable_thread_specific<RegionGrower> growers(
      [&] { return RegionGrower(scene, shapes, topology, tolerances, marks); });
  tbb::parallel_for(std::size_t{0}, components.begin.size() - 1, [&](std::size_t c) {
    const std::uint32_t first = components.begin[c];
    const std::span<TriangleId> seeds =
        std::span(components.members).subspan(first, components.begin[c + 1] - first);
    sort_seeds(scene, shapes, seeds);
    growers.local().grow(seeds, first, grown.members);
  });
  for (const RegionGrower& grower : growers) {
    grown.regions.insert(grown.regions.end(), grower.regions().begin(), grower.regions().end());
  }
  return in_order_of_triangles(grown, scene.triangles.size());
}

} // namespace meninas
