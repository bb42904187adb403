#include "scenes/repair/touching.h"

#include "scenes/repair/common_place.h"
#include "scenes/materials/texture_lookup.h"
#include "scenes/rays/ray_contacts.h"
#include "scenes/report/overlaps.h"
#include "scenes/surfaces/point_tree.h"
#include "scenes/surfaces/regions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>

namespace meninas {
namespace {

constexpr double touch_share = 1e-5; ///< of the radius of the detail
constexpr double tolerances = 8.0;
/// Of boxes: scenes of very many faces that move are left as they are beyond it.
constexpr std::size_t max_pairs_tried = 50'000'000;
/// Of faces that one body is put before.
constexpr std::size_t max_planes = 64;

double touch_of(const Scene& scene) {
  const Precision precision(scene);
  return std::max(touch_share * precision.detail().radius, tolerances * precision.in_detail());
}

Plane turned(const Plane& plane, double sign) {
  return sign < 0.0 ? Plane{-plane.normal, -plane.offset} : plane;
}

// --- Faces

struct TriangleBox {
  Bounds bounds;
  TriangleId triangle = none<TriangleId>;
};

class Separator {
public:
  using Test = bool (*)(const Material&);

  Separator(Scene& scene, double touch) : scene_(scene), touch_(touch) {}

  /// Puts the faces of materials that `moves` before those of materials that `stays`.
  void separate(Test moves, Test stays, std::set<NodeId>& moved) {
    constexpr double far = std::numeric_limits<double>::infinity();
    const std::vector<TriangleBox> movers = boxes_of(moves, {Point3(-far), Point3(far)});
    if (movers.empty())
      return;
    Bounds around;
    for (const TriangleBox& box : movers) {
      around.low = glm::min(around.low, box.bounds.low - touch_);
      around.high = glm::max(around.high, box.bounds.high + touch_);
    }
    const std::vector<TriangleBox> fixed = boxes_of(stays, around);
    if (fixed.empty())
      return;
    for (const TriangleBox& box : movers)
      for (const VertexId v : scene_.triangles[index(box.triangle)].vertices)
        bodies_[body_of(box.triangle)].vertices.push_back(v);
    std::vector<double> farthest; // of those up to here along x
    for (const TriangleBox& box : fixed)
      farthest.push_back(
          std::max(farthest.empty() ? box.bounds.high.x : farthest.back(), box.bounds.high.x));
    std::size_t tried = 0;
    for (const TriangleBox& mover : movers) {
      const auto first = std::ranges::lower_bound(farthest, mover.bounds.low.x - touch_);
      for (auto k = static_cast<std::size_t>(first - farthest.begin());
           k < fixed.size() && fixed[k].bounds.low.x <= mover.bounds.high.x + touch_ &&
           tried < max_pairs_tried;
           ++k, ++tried)
        if (are_near(mover.bounds, fixed[k].bounds))
          touch(mover.triangle, fixed[k].triangle);
    }
    move(moved);
  }

private:
  using BodyName = std::pair<NodeId, MaterialId>;
  struct Body {
    std::vector<VertexId> vertices;
    std::vector<Plane> before; ///< through faces that stay, their normals the way out
  };
  using Bodies = std::map<BodyName, Body>;

  /// Those of a kind that are near the bounds, from the lowest along x on.
  std::vector<TriangleBox> boxes_of(Test of_kind, const Bounds& around) const {
    std::vector<TriangleBox> boxes;
    for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t) {
      if (!of_kind(material_of(scene_, TriangleId{t})))
        continue;
      TriangleBox box{{}, TriangleId{t}};
      for (const Point3& corner : corners(scene_, TriangleId{t})) {
        box.bounds.low = glm::min(box.bounds.low, corner);
        box.bounds.high = glm::max(box.bounds.high, corner);
      }
      if (are_near(box.bounds, around))
        boxes.push_back(box);
    }
    std::ranges::sort(boxes, [](const TriangleBox& a, const TriangleBox& b) {
      return std::pair(a.bounds.low.x, a.triangle) < std::pair(b.bounds.low.x, b.triangle);
    });
    return boxes;
  }

  bool are_near(const Bounds& a, const Bounds& b) const {
    return glm::all(glm::lessThanEqual(a.low, b.high + touch_)) &&
           glm::all(glm::lessThanEqual(b.low, a.high + touch_));
  }

  /// Notes before which plane the body of `moves` is put, if that lies on `stays`.
  void touch(TriangleId moves, TriangleId stays) {
    const auto a = corners(scene_, moves), b = corners(scene_, stays);
    const TriangleShape own = shape_of(a), other = shape_of(b);
    const bool own_is_wider = own.height > other.height;
    const TriangleShape& wide = own_is_wider ? own : other;
    if (!(wide.height > touch_))
      return;
    const Plane plane{wide.normal, glm::dot(wide.normal, own_is_wider ? a[0] : b[0])};
    const auto lies_in = [&](const Point3& x) {
      return std::abs(signed_distance(plane, x)) <= touch_;
    };
    if (!std::ranges::all_of(own_is_wider ? b : a, lies_in) ||
        !overlap_along(plane.normal, a, b, 4.0 * touch_))
      return;
    // The wider face tells the direction better, the other one where it stands.
    const Plane before{plane.normal, glm::dot(plane.normal, b[0])};
    Bodies::mapped_type& body = bodies_[body_of(moves)];
    if (is_known(body, before, a))
      return;
    const double side = side_of_body(body, before);
    const std::optional<Direction> out =
        side != 0.0 ? side * before.normal : way_out(moves, own.normal, stays, other.normal);
    if (out)
      body.before.push_back(turned(before, glm::dot(before.normal, *out)));
  }

  BodyName body_of(TriangleId triangle) const {
    const Triangle& of = scene_.triangles[index(triangle)];
    return {of.node, of.material};
  }

  bool is_known(const Body& body, const Plane& plane, const std::array<Point3, 3>& face) const {
    return body.before.size() > max_planes ||
           std::ranges::any_of(body.before, [&](const Plane& known) {
             const Plane alike = turned(known, glm::dot(known.normal, plane.normal));
             return std::ranges::all_of(face, [&](const Point3& x) {
               return std::abs(signed_distance(alike, x) - signed_distance(plane, x)) <=
                      0.1 * touch_;
             });
           });
  }

  /// On which side of a plane that it touches the rest of a body is; 0 where it has no rest, or on
  /// both.
  double side_of_body(const Body& body, const Plane& plane) const {
    double low = 0.0, high = 0.0;
    for (const VertexId v : body.vertices) {
      const double height = signed_distance(plane, position(scene_, v));
      low = std::min(low, height);
      high = std::max(high, height);
    }
    const bool is_above = high > 2.0 * touch_, is_below = low < -2.0 * touch_;
    return is_above == is_below ? 0.0 : is_above ? 1.0 : -1.0;
  }

  /// Where a sheet goes, or a body on both sides of the plane.
  std::optional<Direction> way_out(TriangleId moves, const Direction& own, TriangleId stays,
                                   const Direction& other) const {
    const Material& mover = material_of(scene_, moves);
    const Material& below = material_of(scene_, stays);
    if (is_solid_glass(mover))
      return -own;
    // Whether what is blended is open is not known yet.
    const bool has_one_way = (!is_glass(mover) || is_blended(mover)) && !mover.double_sided;
    if (has_one_way && !below.double_sided && glm::dot(own, other) < 0.0)
      return std::nullopt; // a sheet of two sides, each of which is seen from its own
    return has_one_way || below.double_sided ? own : other;
  }

  /// All vertices of a body that lie in a plane before which it is put. Those of a curved body,
  /// which would have to go before very many planes, stay.
  void move(std::set<NodeId>& moved) {
    std::vector<Plane> planes;
    for (auto& [name, body] : bodies_) {
      if (body.before.empty() || body.before.size() > max_planes)
        continue;
      std::ranges::sort(body.vertices);
      body.vertices.erase(std::ranges::unique(body.vertices).begin(), body.vertices.end());
      for (const VertexId v : body.vertices) {
        Point3& x = scene_.vertices[index(v)].position;
        planes.clear();
        for (const Plane& plane : body.before)
          if (std::abs(signed_distance(plane, x)) <= 1.5 * touch_)
            planes.push_back({plane.normal, plane.offset + 2.0 * touch_});
        if (planes.empty())
          continue;
        x += way_into(x, planes);
        moved.insert(name.first);
      }
    }
    bodies_.clear();
  }

  Scene& scene_;
  double touch_;
  Bodies bodies_;
};

bool is_lamp(const Material& material) { return is_emitter(material) && !is_glass(material); }
bool is_no_glass(const Material& material) { return !is_glass(material); }
bool is_plain(const Material& material) { return !is_glass(material) && !is_emitter(material); }

// --- Lights

/// Which side of a face a light next to it shines on.
double side_of(const PunctualLight& light, const Plane& face, bool double_sided, double rounding) {
  constexpr double along = 0.05; // sine of an axis that says nothing of sides
  const double axis = glm::dot(light.direction, face.normal);
  if ((light.kind == PunctualKind::spot || light.distribution) && std::abs(axis) > along)
    return axis;
  const double height = signed_distance(face, light.position);
  return double_sided && std::abs(height) > rounding ? height : 1.0;
}

/// A face that a light is in, by the side that it shines on.
struct LitFace {
  Plane before;
  std::optional<Rgb> reflectance; ///< where it is the same everywhere on the face
};

/// The mean of several faces; none where that of one of them is not known.
Rgb mean_reflectance(std::span<const LitFace> faces) {
  Rgb sum(0.0);
  for (const LitFace& face : faces) {
    if (!face.reflectance)
      return Rgb(0.0);
    sum += *face.reflectance / static_cast<double>(faces.size());
  }
  return sum;
}

/// Puts a light before faces; the half-space before them is all that a point light shines on. Of
/// the two sides of a sheet it takes that of the first.
void settle(PunctualLight& light, std::vector<LitFace> faces) {
  std::erase_if(faces, [first = faces.front().before.normal](const LitFace& face) {
    return glm::dot(face.before.normal, first) < -0.5;
  });
  std::vector<Plane> planes;
  for (const LitFace& face : faces)
    planes.push_back(face.before);
  light.position += way_into(light.position, planes);
  if (light.kind == PunctualKind::spot)
    return;
  Vec3 out(0.0);
  for (const Plane& plane : planes)
    out += plane.normal;
  if (!light.distribution && glm::length(out) > 0.999 * static_cast<double>(planes.size()))
    light.foot_reflectance = mean_reflectance(faces);
  light.kind = PunctualKind::spot;
  light.direction = glm::normalize(out);
  light.inner_cone = light.outer_cone = 0.5 * std::numbers::pi;
}

} // namespace

std::vector<NodeId> separate_touching(Scene& scene) {
  if (scene.triangles.empty())
    return {};
  std::set<NodeId> moved;
  Separator separator(scene, touch_of(scene));
  separator.separate(is_lamp, is_plain, moved);
  separator.separate(is_glass, is_no_glass, moved);
  return {moved.begin(), moved.end()};
}

/// Puts area lights before the faces in whose plane they are. Adds their names.
static void settle_area_lights(Scene& scene, std::vector<std::string>& names) {
  const double touch = touch_of(scene);
  for (AreaLight& light : scene.area_lights) {
    Bounds around;
    for (const Point3& corner : light.corners) {
      around.low = glm::min(around.low, corner - touch);
      around.high = glm::max(around.high, corner + touch);
    }
    const double at = glm::dot(light.axis, light.corners[0]);
    double way = 0.0;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
      const Material& material = material_of(scene, TriangleId{t});
      const auto p = corners(scene, TriangleId{t});
      const Bounds box{glm::min(p[0], glm::min(p[1], p[2])), glm::max(p[0], glm::max(p[1], p[2]))};
      const bool apart = glm::any(glm::greaterThan(box.low, around.high)) ||
                         glm::any(glm::greaterThan(around.low, box.high));
      if (apart || is_glass(material) || material.alpha_mode != AlphaMode::opaque)
        continue;
      double farthest = 0.0; // of the triangle's corners and the light's from one plane
      for (const Point3& corner : p)
        farthest = std::max(farthest, std::abs(glm::dot(light.axis, corner) - at));
      if (farthest <= touch)
        way = std::max(way, glm::dot(light.axis, p[0]) - at + 2.0 * touch);
    }
    for (Point3& corner : light.corners)
      corner += way * light.axis;
    if (way > 0.0)
      names.push_back(light.name);
  }
}

std::vector<std::string> settle_lights(Scene& scene) {
  std::vector<std::string> names;
  if (scene.triangles.empty())
    return names;
  if (!scene.area_lights.empty())
    settle_area_lights(scene, names);
  if (scene.lights.empty())
    return names;
  const Precision precision(scene);
  const double touch = touch_of(scene);
  std::vector<Point3> positions;
  for (const PunctualLight& light : scene.lights)
    positions.push_back(light.position);
  const PointTree tree(positions);
  std::vector<std::vector<LitFace>> faces(scene.lights.size());
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const Material& material = material_of(scene, TriangleId{t});
    if (is_glass(material) || material.alpha_mode != AlphaMode::opaque)
      continue;
    const auto p = corners(scene, TriangleId{t});
    const Bounds box{glm::min(p[0], glm::min(p[1], p[2])) - touch,
                     glm::max(p[0], glm::max(p[1], p[2])) + touch};
    tree.visit_inside(box, [&](std::uint32_t k) {
      const PunctualLight& light = scene.lights[k];
      if (light.kind == PunctualKind::directional || !is_within(p, light.position, touch))
        return true;
      const Direction normal = shape_of(p).normal;
      const Plane face{normal, glm::dot(normal, p[0])};
      const double side = side_of(light, face, material.double_sided, precision.in_detail());
      const Plane before = turned(face, side);
      faces[k].push_back({{before.normal, before.offset + 2.0 * touch}, std::nullopt});
      if (!is_textured(material) && !has_vertex_colors(scene, TriangleId{t}))
        faces[k].back().reflectance = diffuse_reflectance(material);
      return true;
    });
  }
  for (std::size_t k = 0; k < faces.size(); ++k)
    if (!faces[k].empty()) {
      settle(scene.lights[k], std::move(faces[k]));
      names.push_back(scene.lights[k].name);
    }
  return names;
}

} // namespace meninas
