#include "scenes/repair/hairline_gaps.h"

#include "scenes/repair/common_place.h"
#include "scenes/rays/ray_contacts.h"
#include "scenes/surfaces/point_tree.h"
#include "scenes/surfaces/regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace meninas {
namespace {

constexpr double widest_gap = 4e-4;  ///< of the radius of the detail
constexpr double longer = 20.0;  ///< than wide
constexpr double steepest = 0.5; ///< sine of the angle between the faces, at least
/// Of edges beside faces; in scenes of very many loose faces the first ones are closed.
constexpr std::size_t max_tried = 20'000'000;

bool is_opaque(const Material& material) {
  return material.alpha_mode == AlphaMode::opaque && !is_glass(material);
}

Plane plane_of(const std::array<Point3, 3>& p) {
  const Direction normal = shape_of(p).normal;
  return {normal, glm::dot(normal, p[0])};
}

/// The side of a plane on which corners are more than `far` away, -1 or 1; 0 where none are, or some on each.
double side_of(const std::array<Point3, 3>& p, const Plane& plane, double far) {
  double side = 0.0;
  for (const Point3& x : p) {
    const double height = signed_distance(plane, x);
    if (std::abs(height) <= far)
      continue;
    const double here = height < 0.0 ? -1.0 : 1.0;
    if (side * here < 0.0)
      return 0.0;
    side = here;
  }
  return side;
}

struct LooseEdge {
  TriangleId triangle = none<TriangleId>;
  VertexId from = none<VertexId>, to = none<VertexId>; ///< welded
};

/// Edges of the same two walls make one joint.
struct Joint {
  ClosedJoint said;
  Plane own, other;
};

class GapCloser {
public:
  explicit GapCloser(Scene& scene)
      : scene_(scene), precision_(scene), topology_(find_topology(scene, precision_)),
        widest_(widest_gap * precision_.detail().radius) {}

  std::vector<ClosedJoint> close() {
    find_loose_edges();
    if (loose_.empty())
      return {};
    find_gaps();
    move_ends();
    std::vector<ClosedJoint> said;
    for (const Joint& joint : joints_)
      said.push_back(joint.said);
    return said;
  }

private:
  void find_loose_edges() {
    for (std::uint32_t e = 0; e + 1 < topology_.first_use.size(); ++e) {
      const auto uses = uses_of(topology_, e);
      if (uses.size() == 1 && is_opaque(material_of(scene_, uses[0].triangle)))
        loose_.push_back({uses[0].triangle, uses[0].low, uses[0].high});
    }
    std::ranges::stable_sort(loose_, {}, &LooseEdge::triangle);
  }

  Point3 middle_of(const LooseEdge& edge) const {
    return 0.5 * (position(scene_, edge.from) + position(scene_, edge.to));
  }

  void find_gaps() {
    std::vector<Point3> middles;
    for (const LooseEdge& edge : loose_)
      middles.push_back(middle_of(edge));
    const PointTree tree(middles);
    std::size_t tried = 0;
    for (std::uint32_t t = 0; t < scene_.triangles.size() && tried < max_tried; ++t) {
      if (!is_opaque(material_of(scene_, TriangleId{t})))
        continue;
      const auto p = corners(scene_, TriangleId{t});
      const Bounds box{glm::min(p[0], glm::min(p[1], p[2])) - 2.0 * widest_,
                       glm::max(p[0], glm::max(p[1], p[2])) + 2.0 * widest_};
      const Plane plane = plane_of(p);
      tree.visit_inside(box, [&](std::uint32_t k) {
        look_at(loose_[k], middles[k], TriangleId{t}, p, plane);
        return ++tried < max_tried;
      });
    }
  }

  void look_at(const LooseEdge& edge, const Point3& middle, TriangleId other,
               const std::array<Point3, 3>& p, const Plane& plane) {
    if (edge.triangle == other || std::abs(signed_distance(plane, middle)) > widest_ ||
        !is_within(p, middle, 1.5 * widest_))
      return;
    const Point3 &a = position(scene_, edge.from), &b = position(scene_, edge.to);
    const double at_a = signed_distance(plane, a), at_b = signed_distance(plane, b);
    const double most = std::max(std::abs(at_a), std::abs(at_b));
    const double least = 4.0 * std::max(precision_.of(edge.triangle), precision_.of(other));
    const double length = glm::distance(a, b);
    if (most > widest_ || length < longer * most)
      return;
    const auto own_corners = corners(scene_, edge.triangle);
    const Plane own = plane_of(own_corners);
    if (glm::length(glm::cross(own.normal, plane.normal)) < steepest)
      return;
    const double side = side_of(own_corners, plane, 2.0 * most);
    // An end that reaches through the other face leaves no gap, but the other end may.
    const double width = side * (side > 0.0 ? std::max(at_a, at_b) : std::min(at_a, at_b));
    if (width <= least)
      return;
    for (const VertexId v : {edge.from, edge.to}) {
      ends_[v].push_back(own);
      ends_[v].push_back(plane);
    }
    note(edge, other, own, plane, width, length);
  }

  bool is_same(const Plane& a, const Plane& b, const Point3& x) const {
    return std::abs(glm::dot(a.normal, b.normal)) > 0.9999 &&
           std::abs(signed_distance(a, x)) < 3.0 * widest_ &&
           std::abs(signed_distance(b, x)) < 3.0 * widest_;
  }

  void note(const LooseEdge& edge, TriangleId other, const Plane& own, const Plane& plane,
            double width, double length) {
    const auto [node, beside] = std::minmax(scene_.triangles[index(edge.triangle)].node,
                                            scene_.triangles[index(other)].node);
    const Point3 x = middle_of(edge);
    for (Joint& joint : joints_) {
      if (joint.said.node != node || joint.said.other != beside)
        continue;
      if ((is_same(joint.own, own, x) && is_same(joint.other, plane, x)) ||
          (is_same(joint.own, plane, x) && is_same(joint.other, own, x))) {
        joint.said.width = std::max(joint.said.width, width);
        joint.said.length += length;
        return;
      }
    }
    joints_.push_back({{node, beside, width, length}, own, plane});
  }

  void move_ends() {
    for (std::uint32_t v = 0; v < scene_.vertices.size(); ++v)
      if (const auto found = ends_.find(topology_.welded[v]); found != ends_.end()) {
        Point3& x = scene_.vertices[v].position;
        const Vec3 way = way_into(x, found->second);
        // Planes that meet at a small angle have no place in common nearby.
        if (glm::length(way) <= 4.0 * widest_)
          x += way;
      }
  }

  Scene& scene_;
  Precision precision_;
  Topology topology_;
  double widest_;
  std::vector<LooseEdge> loose_;
  std::vector<Joint> joints_;
  std::map<VertexId, std::vector<Plane>> ends_; ///< of loose edges, to where they go
};

} // namespace

std::vector<ClosedJoint> close_hairline_gaps(Scene& scene) {
  if (scene.triangles.empty())
    return {};
  return GapCloser(scene).close();
}

std::string describe_joints(const Scene& scene, const std::vector<ClosedJoint>& joints) {
  if (joints.empty())
    return {};
  constexpr std::size_t few = 4;
  const auto widest_joint = std::ranges::max_element(joints, {}, &ClosedJoint::width);
  double slits = 0.0;
  for (const ClosedJoint& joint : joints)
    slits += joint.width * joint.length;
  std::string text = fmt::format(
      "hairline gaps of up to {:.2g} mm along {} joint{} are closed; light through them, at most "
      "{:.2g} W for each W/m^2/sr outside, would come in blots and is left out:",
      1000.0 * widest_joint->width, joints.size(), joints.size() == 1 ? "" : "s",
      std::numbers::pi * slits);
  for (std::size_t k = 0; k < std::min(few, joints.size()); ++k)
    text +=
        fmt::format("{} '{}' and '{}'", k == 0 ? "" : ",", scene.nodes[index(joints[k].node)].name,
                    scene.nodes[index(joints[k].other)].name);
  if (joints.size() > few)
    text += fmt::format(" and {} more", joints.size() - few);
  return text;
}

} // namespace meninas
