#include "radiosity/transport/face_clusters.h"

#include "radiosity/mesh/mesh_cells.h"
#include "radiosity/mesh/small_surfaces.h"
#include "radiosity/mesh/vertex_welder.h"
#include "scenes/rays/ray_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace meninas {

namespace {

constexpr std::size_t max_members = 32;
constexpr double max_turn = 25.0;       // degrees from the first face
constexpr double max_edge = 1.0 / 4.0;  // of a square as large as a cluster, in element sizes

bool may_join(const ElementMesh& mesh, const MeshSide& side) {
  return is_small(mesh, side) && side.coat == none<MaterialId>;
}

std::span<const ElementVertexId> corners_of(const ElementMesh& mesh, const MeshSide& side) {
  return std::span(mesh.corners[side.first_element]).first(side.triangle ? 3 : 4);
}

/// The places at which faces have corners, and the faces at each.
struct CornerPlaces {
  std::vector<std::array<std::uint32_t, 4>> of_side; ///< by SideId; a triangle repeats its third
  std::vector<std::uint32_t> begin;                  ///< by place, and the end
  std::vector<SideId> sides;
};

CornerPlaces corner_places(const ElementMesh& mesh, const SurfaceModel& surfaces) {
  CornerPlaces places;
  places.of_side.resize(mesh.sides.size());
  VertexWelder welder(vertex_grain(mesh, surfaces));
  std::vector<Point3> known;
  for (std::size_t s = 0; s < mesh.sides.size(); ++s)
    if (may_join(mesh, mesh.sides[s])) {
      const ElementCorners& corners = mesh.corners[mesh.sides[s].first_element];
      for (std::size_t c = 0; c < 4; ++c)
        places.of_side[s][c] = index(welder.vertex_at(0, mesh.vertices[index(corners[c])], known));
    }
  places.begin.assign(known.size() + 1, 0);
  const auto for_each_corner = [&](const auto& use) {
    for (std::uint32_t s = 0; s < mesh.sides.size(); ++s)
      if (may_join(mesh, mesh.sides[s]))
        for (std::size_t c = 0; c < corners_of(mesh, mesh.sides[s]).size(); ++c)
          use(places.of_side[s][c], SideId{s});
  };
  for_each_corner([&](std::uint32_t place, SideId) { ++places.begin[place + 1]; });
  std::partial_sum(places.begin.begin(), places.begin.end(), places.begin.begin());
  places.sides.resize(places.begin.back());
  std::vector<std::uint32_t> next = places.begin;
  for_each_corner([&](std::uint32_t place, SideId side) { places.sides[next[place]++] = side; });
  return places;
}

/// Grows clusters one after the other, breadth first.
class ClusterGrowth {
public:
  explicit ClusterGrowth(const LightScene& light)
      : mesh_(light.mesh), rays_(light.rays), places_(corner_places(light.mesh, light.surfaces)),
        taken_(light.mesh.sides.size(), 0) {}

  FaceClusters run() {
    for (std::uint32_t s = 0; s < mesh_.sides.size(); ++s) {
      if (taken_[s] != 0 || !may_join(mesh_, mesh_.sides[s]))
        continue;
      grow_from(SideId{s});
      if (members_.size() < 2)
        continue;
      clusters_.sides.insert(clusters_.sides.end(), members_.begin(), members_.end());
      clusters_.begin.push_back(static_cast<std::uint32_t>(clusters_.sides.size()));
    }
    return std::move(clusters_);
  }

private:
  Point3 middle_of(SideId side) const {
    const auto corners = corners_of(mesh_, mesh_.sides[index(side)]);
    Point3 sum(0.0);
    for (const ElementVertexId corner : corners)
      sum += mesh_.vertices[index(corner)];
    return sum / static_cast<double>(corners.size());
  }

  /// Whether nothing parts two faces: their middles both see a point above the curve between them. It is so high that
  /// its legs leave a curve that turns by max_turn: 27 degrees above the chord, which is half as much below the plane of a face.
  bool are_together(SideId a, SideId b) const {
    constexpr double height = 1.0 / 4.0; // of the distance
    const MeshSide &one = mesh_.sides[index(a)], &other = mesh_.sides[index(b)];
    const Point3 from = middle_of(a), to = middle_of(b);
    const Point3 top = 0.5 * (from + to) + height * glm::distance(from, to) * glm::normalize(one.normal + other.normal);
    return !occluded(rays_, Leg{from, top, one.plane_class}) && !occluded(rays_, Leg{to, top, other.plane_class});
  }

  double area_of(SideId side) const {
    return mesh_.area[mesh_.sides[index(side)].first_element];
  }

  void grow_from(SideId first) {
    static const double min_cosine = std::cos(max_turn * std::numbers::pi / 180.0);
    const MeshSide& begin = mesh_.sides[index(first)];
    const double edge = max_edge * begin.element_size;
    members_ = {first};
    taken_[index(first)] = 1;
    double area = area_of(first);
    for (std::size_t next = 0; next < members_.size(); ++next)
      for (const std::uint32_t place : places_.of_side[index(members_[next])])
        for (std::uint32_t k = places_.begin[place]; k < places_.begin[place + 1]; ++k) {
          const SideId other = places_.sides[k];
          const MeshSide& side = mesh_.sides[index(other)];
          if (members_.size() == max_members)
            return;
          if (taken_[index(other)] != 0 || glm::dot(side.normal, begin.normal) < min_cosine ||
              area + area_of(other) > edge * edge || !are_together(first, other))
            continue;
          taken_[index(other)] = 1;
          area += area_of(other);
          members_.push_back(other);
        }
  }

  const ElementMesh& mesh_;
  const RayScene& rays_;
  CornerPlaces places_;
  std::vector<std::uint8_t> taken_; ///< by SideId
  std::vector<SideId> members_;     ///< of the cluster that grows
  FaceClusters clusters_;
};

} // namespace

FaceClusters face_clusters(const LightScene& light) {
  return is_finely_tessellated(light.mesh) ? ClusterGrowth(light).run() : FaceClusters{};
}

} // namespace meninas
