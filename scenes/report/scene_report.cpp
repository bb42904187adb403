#include "scenes/report/scene_report.h"

#include "scenes/report/crossings.h"
#include "scenes/report/mesh_oddities.h"
#include "scenes/report/overlaps.h"
#include "scenes/surfaces/point_tree.h"
#include "scenes/surfaces/shells.h"
#include "scenes/surfaces/topology.h"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>

namespace meninas {
namespace {

// Rooms are metres wide. Beyond these a scene is more likely in another unit than meant.
constexpr double largest_scene = 200.0;
constexpr double smallest_scene = 0.02;
constexpr double unlike =
    500.0; ///< how often the usual extent of nodes one of them has before it is named

constexpr double inwards = -0.6; ///< Shell::outwards of an open shape that shows its fronts inside
constexpr std::ptrdiff_t max_neighbours = 16; ///< cameras, lamps or shapes that are tried

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

class Reporter {
public:
  Reporter(const Scene& scene, const SurfaceModel& surfaces)
      : scene_(scene), topology_(find_topology(scene, Precision(scene))),
        tolerance_(surfaces.tolerance) {}

  void report_sizes() {
    const Bounds bounds = bounds_of(scene_);
    const double extent = glm::distance(bounds.low, bounds.high);
    if (extent > largest_scene) {
      say("too_large", 1,
          fmt::format(
              "the scene is {:.4g} m across, and glTF counts in metres: if it was modelled in "
              "{}, scale it by {}",
              extent, extent > 20.0 * largest_scene ? "millimetres" : "centimetres",
              extent > 20.0 * largest_scene ? "0.001" : "0.01"));
    }
    if (extent < smallest_scene) {
      say("too_small", 1,
          fmt::format(
              "the scene is {:.4g} mm across, and glTF counts in metres: if it was modelled "
              "in metres, an export has scaled it down",
              1000.0 * extent));
    }
    // Floats this coarse show as steps in smooth shapes.
    if (scene_.position_error > 1e-5 * extent) {
      const double away = std::max(glm::length(bounds.low), glm::length(bounds.high));
      say("far_away", 1,
          fmt::format(
              "corners are only known to {:.2g} m, {:.2g} of the scene's size, as they are "
              "up to {:.4g} m from an origin: move the scene to the origin before exporting",
              scene_.position_error, scene_.position_error / extent, away));
    }
  }

  void report_unlike_nodes() {
    std::vector<Bounds> bounds(scene_.nodes.size());
    for (const Triangle& triangle : scene_.triangles) {
      for (const VertexId vertex : triangle.vertices) {
        Bounds& of_node = bounds[index(triangle.node)];
        of_node.low = glm::min(of_node.low, position(scene_, vertex));
        of_node.high = glm::max(of_node.high, position(scene_, vertex));
      }
    }
    std::vector<double> extents;
    for (const Bounds& box : bounds) {
      extents.push_back(box.low.x <= box.high.x ? glm::distance(box.low, box.high) : 0.0);
    }
    std::vector<double> sorted;
    std::ranges::copy_if(extents, std::back_inserter(sorted), [](double x) { return x > 0.0; });
    if (sorted.size() < 3) {
      return;
    }
    std::ranges::sort(sorted);
    const double usual = sorted[sorted.size() / 2];
    for (std::uint32_t node = 0; node < extents.size(); ++node) {
      if (extents[node] > unlike * usual) {
        say("unlike_size", 1,
            fmt::format(
                "'{}' is {:.4g} m across, {:.0f} times as much as most nodes: is it in another "
                "unit?",
                name(NodeId{node}), extents[node], extents[node] / usual),
            NodeId{node});
      }
    }
  }

  void report_shells() {
    const std::vector<Shell> shells = find_shells(scene_, topology_);
    std::vector<Point3> middles;
    for (const Shell& shell : shells) {
      middles.push_back(0.5 * (shell.bounds.low + shell.bounds.high));
    }
    const PointTree tree(middles);
    CountByNode inside_out;
    CountByNode mixed;
    for (std::uint32_t k = 0; k < shells.size(); ++k) {
      const Shell& shell = shells[k];
      if (!shell.double_sided && shell.clashes > 0) {
        mixed[node_of(shell.faces.front())] += shell.clashes;
      }
      if (faces_inwards(shell) && !holds_something(shell, k, middles, tree)) {
        for (const TriangleId face : shell.faces) {
          ++inside_out[node_of(face)];
        }
      }
    }
    for (const auto& [node, count] : inside_out) {
      say("inside_out", count,
          fmt::format("'{}' shows the black backs of {} outside: flip its normals, unless it is a "
                      "room to be looked into",
                      name(node), counted(count, "face")),
          node);
    }
    for (const auto& [node, count] : mixed) {
      say("mixed_winding", count,
          fmt::format("'{}' has {} where one face shows its front and the next its black back: "
                      "recalculate its normals, or make its material double-sided",
                      name(node), counted(count, "edge")),
          node);
    }
    report_cameras(shells);
  }

  void report_faces() {
    for (const auto& [nodes, count] : duplicate_faces(scene_, topology_)) {
      const auto [node, other] = nodes;
      say("duplicate_faces", count,
          node == other
              ? fmt::format(
                    "'{}' has {} twice in one place: only one of the two is seen; delete the "
                    "other",
                    name(node), counted(count, "face"))
              : fmt::format("'{}' has {} exactly where '{}' has one: only one of the two is seen; "
                            "delete the other, or move them apart",
                            name(node), counted(count, "face"), name(other)),
          node, other);
    }
    for (const auto& [node, count] : slivers(scene_)) {
      say("slivers", count,
          fmt::format(
              "'{}' has {} over a thousand times as long as high: light is right, in elements "
              "as thin; remesh it where that shows",
              name(node), counted(count, "triangle")),
          node);
    }
  }

  void report_overlaps(const CountByNodes& counts) {
    for (const auto& [nodes, count] : counts) {
      const auto [node, other] = nodes;
      say("overlapping_faces", count,
          fmt::format(
              "'{}' has {} in one plane with, and overlapping, faces of {}, of another material: "
              "which of the two is seen changes from pixel to pixel; move one a little, or cut "
              "the hidden part away",
              name(node), counted(count, "face"),
              node == other ? "its own" : fmt::format("'{}'", name(other))),
          node, other);
    }
  }

  void report_edges() {
    for (const auto& [node, count] : crowded_edges(scene_, topology_)) {
      say("non_manifold", count,
          fmt::format("'{}' has {} at which more than two of its faces meet: light is right, but "
                      "tools that want a solid will complain",
                      name(node), counted(count, "edge")),
          node);
    }
    for (const auto& [node, count] : crowded_corners(scene_, topology_)) {
      say("crowded_corners", count,
          fmt::format("'{}' has {} at which over a thousand faces meet: rays near there take "
                      "several times as long; fewer segments would do",
                      name(node), counted(count, "corner")),
          node);
    }
    for (const auto& [node, count] : divided_edges(scene_, topology_, tolerance_)) {
      say("t_junctions", count,
          fmt::format(
              "'{}' has {} with corners of other faces along them: hairline cracks may show; "
              "insert the missing corners",
              name(node), counted(count, "edge")),
          node);
    }
  }

  void report_crossings(const CountByNodes& counts) {
    for (const auto& [nodes, count] : counts) {
      const auto [node, other] = nodes;
      say("crossing", count,
          fmt::format(
              "'{}' passes through {} ({} at least): light is right but for elements that are "
              "partly inside; cut the hidden part away where that shows",
              name(node), node == other ? "itself" : fmt::format("'{}'", name(other)),
              counted(count, "edge")),
          node, other);
    }
  }

  std::vector<Oddity> oddities() && { return std::move(oddities_); }

private:
  const std::string& name(NodeId node) const { return scene_.nodes[index(node)].name; }
  NodeId node_of(TriangleId triangle) const { return scene_.triangles[index(triangle)].node; }

  void say(const std::string& kind, std::size_t count, const std::string& text,
           NodeId node = none<NodeId>, NodeId other = none<NodeId>) {
    const bool is_pair = other != none<NodeId> && other != node;
    oddities_.push_back(
        {kind, node == none<NodeId> ? "" : name(node), is_pair ? name(other) : "", count, text});
  }

  static bool faces_inwards(const Shell& shell) {
    const bool shape = shell.faces.size() > 1 && shell.oriented && !shell.double_sided;
    return shape && (shell.closed ? shell.volume < 0.0 : shell.outwards < inwards);
  }

  /// A camera, a lamp or another shape is in it: then it is a room.
  bool holds_something(const Shell& shell, std::uint32_t self, const std::vector<Point3>& middles,
                       const PointTree& tree) const {
    const auto holds = [&](const Point3& x) {
      const bool near = glm::all(glm::lessThan(shell.bounds.low, x)) &&
                        glm::all(glm::lessThan(x, shell.bounds.high));
      return near && (!shell.closed || winding_number(scene_, shell, x) < -0.5);
    };
    const auto few = std::views::take(max_neighbours);
    if (std::ranges::any_of(scene_.cameras | few, holds, &Camera::position) ||
        std::ranges::any_of(scene_.lights | few, holds, &PunctualLight::position) ||
        std::ranges::any_of(scene_.area_lights | few, holds,
                            [](const AreaLight& light) { return light.corners[0]; })) {
      return true;
    }
    bool found = false;
    std::ptrdiff_t tried = 0;
    tree.visit_inside(shell.bounds, [&](std::uint32_t other) {
      found = other != self && holds(middles[other]);
      return !found && ++tried < max_neighbours;
    });
    return found;
  }

  void report_cameras(const std::vector<Shell>& shells) {
    for (const Camera& camera : scene_.cameras | std::views::take(max_neighbours)) {
      for (const Shell& shell : shells) {
        const Point3& x = camera.position;
        const bool near = shell.volume > 0.0 && glm::all(glm::lessThan(shell.bounds.low, x)) &&
                          glm::all(glm::lessThan(x, shell.bounds.high));
        if (!near || winding_number(scene_, shell, x) < 0.5) {
          continue;
        }
        const std::string& node = name(node_of(shell.faces.front()));
        oddities_.push_back(
            {"camera_inside", camera.name, node, shell.faces.size(),
             fmt::format("camera '{}' is inside '{}', whose faces all look outwards, and "
                         "sees through it: if it is a room, flip its normals",
                         camera.name, node)});
      }
    }
  }

  const Scene& scene_;
  Topology topology_;
  double tolerance_;
  std::vector<Oddity> oddities_;
};

} // namespace

std::vector<Oddity> report_scene(const Scene& scene, const SurfaceModel& surfaces,
                                 const RayScene& rays) {
  Reporter reporter(scene, surfaces);
  reporter.report_sizes();
  reporter.report_unlike_nodes();
  reporter.report_shells();
  reporter.report_faces();
  reporter.report_overlaps(overlapping_faces(scene, surfaces));
  reporter.report_edges();
  reporter.report_crossings(crossings(scene, surfaces, rays));
  return std::move(reporter).oddities();
}

} // namespace meninas
