#include "radiosity/queries/node_sides.h"

#include "radiosity/queries/node_scene.h"
#include "radiosity/transport/hemisphere_rays.h"
#include "scenes/sampling.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace meninas {

namespace {

/// A node seen in a share less than this is seen through a seam.
constexpr double min_share = 1e-3;

bool is_double_sided(const Scene& scene, const Face& face) {
  return scene.materials[index(face.material)].double_sided;
}

/// The view of one side of a face, as shares of its rays, and of lines to points of B.
struct SideView {
  double others = 0.0;  ///< nodes other than A
  double escaped = 0.0; ///< nothing
  double black = 0.0;   ///< backs of single-sided surfaces
  double asked = 0.0;   ///< B, by rays
  double lines = 0.0;   ///< B, mean of V cos cos'
  double other_lines = 0.0; ///< the same of what of B is not A
  double behind = 0.0;  ///< the same of B's black backs

  double of_b() const { return asked + lines; }
};
using FaceViews = std::array<SideView, 2>; ///< front, back

struct FacePoint {
  const Face* face;
  Point3 x;
};

/// A point of the polygon's fan, evenly spread for (u, v) that are so in [0, 1)^2.
Point3 point_of_fan(const ConvexPolygon& polygon, double area, double u, double v) {
  double rest = u * area;
  const auto& p = polygon.vertices;
  for (std::size_t k = 2;; ++k) {
    const Vec3 a = p[k - 1] - p[0], b = p[k] - p[0];
    const double part = 0.5 * glm::length(glm::cross(a, b));
    if (rest > part && k + 1 < polygon.size) {
      rest -= part;
      continue;
    }
    // (s, t) folded into the triangle
    double s = part > 0.0 ? std::clamp(rest / part, 0.0, 1.0) : 0.0, t = v;
    if (s + t > 1.0) {
      s = 1.0 - s;
      t = 1.0 - t;
    }
    return p[0] + s * a + t * b;
  }
}

/// The faces of B, to choose points of them by area.
class Targets {
public:
  Targets(const SideQuestion& question) {
    const auto sets = sets_of_nodes(question.scene, question.to);
    for (const Face& face : question.all) {
      if (sets[index(face.node)] == none_of_sets)
        continue;
      faces_.push_back(&face);
      sums_.push_back((sums_.empty() ? 0.0 : sums_.back()) + face.area);
    }
  }
  bool empty() const { return faces_.empty(); }
  FacePoint point(double u, double v) const {
    const double wanted = u * sums_.back();
    const auto at = std::ranges::upper_bound(sums_, wanted);
    const auto k = std::min<std::size_t>(static_cast<std::size_t>(at - sums_.begin()), sums_.size() - 1);
    const Face& face = *faces_[k];
    const double inside = (wanted - (sums_[k] - face.area)) / face.area;
    return {&face, point_of_fan(face.polygon, face.area, std::clamp(inside, 0.0, 1.0), v)};
  }

private:
  std::vector<const Face*> faces_;
  std::vector<double> sums_;
};

class Survey {
public:
  Survey(const SideQuestion& question, const std::vector<Face>& from)
      : question_(question), from_(from),
        node_scene_(question.scene, question.surfaces, question.mirrors,
                    {question.to, NodeSides::both}, std::min(question.max_depth, max_mirrors)),
        targets_(question), in_from_(question.scene.nodes.size(), 0) {
    for (const Face& face : from)
      in_from_[index(face.node)] = 1;
    const auto faces = static_cast<int>(std::min<std::size_t>(from.size(), 1U << 20));
    rays_ = std::clamp((1 << 21) / faces / 16 * 16, 64, 1024);
    lines_ = std::clamp((1 << 20) / faces, 16, 256);
  }

  std::vector<FaceViews> run() {
    for (std::size_t corners = 3; corners <= ConvexPolygon::capacity; ++corners)
      net_of(corners);
    std::vector<FaceViews> views(from_.size());
    tbb::parallel_for(std::size_t{0}, from_.size(), [&](std::size_t f) {
      send_rays(f, views[f]);
      if (!targets_.empty())
        draw_lines(f, views[f]);
    });
    return views;
  }

private:
  static constexpr int max_mirrors = 8;

  /// Rays for each triangle of a fan.
  const HemisphereSamples& net_of(std::size_t corners) {
    const int each = std::max(16, rays_ / static_cast<int>(corners - 2) / 16 * 16);
    auto& net = nets_[corners];
    if (net.points.empty())
      net = make_direction_net(each);
    return net;
  }

  void send_rays(std::size_t f, FaceViews& views) const {
    GatherWorkspace work;
    for (std::size_t side = 0; side < 2; ++side) {
      const Face face = side == 0 ? from_[f] : turned_round(from_[f]);
      for (std::size_t k = 2; k < face.polygon.size; ++k) {
        ReceiverArea area;
        area.corner = face.polygon.vertices[0];
        area.edge_u = face.polygon.vertices[k - 1] - area.corner;
        area.edge_v = face.polygon.vertices[k] - area.corner;
        area.triangle = true;
        area.normal = face.plane.normal;
        area.plane_class = face.plane_class;
        const double share =
            0.5 * glm::length(glm::cross(area.edge_u, area.edge_v)) / face.area;
        gather_rays(node_scene_.light, nets_.at(face.polygon.size), area,
                    hash(static_cast<std::uint32_t>(f), static_cast<std::uint32_t>(k), 0x51de),
                    node_scene_.settings, work);
        add_rays(work.result, share, views[side]);
      }
    }
  }

  void add_rays(const GatheredRays& gathered, double share, SideView& view) const {
    const double each = share / gathered.rays;
    view.escaped += each * gathered.escaped;
    view.black += each * gathered.black;
    for (const ElementHit& landing : gathered.landings) {
      const SideId side = node_scene_.mesh.side_of_element[landing.element];
      if (in_from_[index(node_scene_.mesh.sides[index(side)].node)] == 0)
        view.others += each;
      if (node_scene_.groups[index(side)] != none_of_sets)
        view.asked += each;
    }
  }

  void draw_lines(std::size_t f, FaceViews& views) const {
    const Face& face = from_[f];
    for (int k = 0; k < lines_; ++k) {
      const auto u = sobol4(static_cast<std::uint32_t>(k), hash(static_cast<std::uint32_t>(f), 0x11e));
      const Point3 x = point_of_fan(face.polygon, face.area, double{u[0]}, double{u[1]});
      const FacePoint y = targets_.point(double{u[2]}, double{u[3]});
      const Vec3 d = y.x - x;
      const double length = glm::length(d);
      if (length == 0.0 || y.face->plane_class == face.plane_class)
        continue;
      const double here = glm::dot(face.plane.normal, d) / length;
      const double there = -glm::dot(y.face->plane.normal, d) / length;
      const double weight = std::abs(here * there) / lines_;
      if (weight == 0.0 ||
          occluded(node_scene_.rays, {x, y.x, face.plane_class, y.face->plane_class}))
        continue;
      SideView& view = views[here > 0.0 ? 0 : 1];
      if (there < 0.0 && !is_double_sided(question_.scene, *y.face)) {
        view.behind += weight;
        continue;
      }
      view.lines += weight;
      if (in_from_[index(y.face->node)] == 0)
        view.other_lines += weight;
    }
  }

  const SideQuestion& question_;
  const std::vector<Face>& from_;
  NodeScene node_scene_;
  Targets targets_;
  std::vector<std::uint8_t> in_from_; ///< by NodeId
  std::map<std::size_t, HemisphereSamples> nets_; ///< by the number of corners
  int rays_ = 0, lines_ = 0;
};

/// The sides of a double-sided face that count, by the rules of the header.
std::array<bool, 2> facing_sides(const FaceViews& views, bool& outside_left_out) {
  std::array<bool, 2> counts{true, true};
  const auto keep_where = [&](const auto& holds) {
    const std::array<bool, 2> kept{counts[0] && holds(views[0]), counts[1] && holds(views[1])};
    if (kept[0] || kept[1])
      counts = kept;
  };
  keep_where([](const SideView& v) { return v.others > min_share || v.other_lines > 0.0; });
  const double seen = std::max(views[0].of_b(), views[1].of_b());
  if (counts[0] && counts[1]) {
    // A hundredth: a window would not make a room open.
    constexpr double open = 1e-2;
    for (std::size_t s = 0; s < 2; ++s)
      if (views[s].escaped < min_share && views[1 - s].escaped > open) {
        counts[1 - s] = false;
        outside_left_out = outside_left_out || views[1 - s].of_b() > min_share * seen;
      }
  }
  const double most = std::max(counts[0] ? views[0].of_b() : 0.0, counts[1] ? views[1].of_b() : 0.0);
  if (most > 0.0)
    keep_where([&](const SideView& v) { return v.of_b() > min_share * most; });
  else if (counts[0] && counts[1])
    counts[1] = false;
  return counts;
}

std::array<bool, 2> counting(const Scene& scene, const Face& face, NodeSides sides,
                             const FaceViews& views, bool& outside_left_out) {
  const bool back = is_double_sided(scene, face);
  if (sides == NodeSides::facing && back)
    return facing_sides(views, outside_left_out);
  return {may_count(sides, true), may_count(sides, false) && back};
}

/// The parts of A and B that do not count where it matters, by sums over faces.
struct LeftOut {
  double area = 0.0, black = 0.0;                        ///< black: of what A sends
  double seen = 0.0, from_behind = 0.0, of_behind = 0.0; ///< lines
  bool outside = false;
};

std::vector<std::string> lines_of(const LeftOut& left) {
  std::vector<std::string> lines;
  const double all = left.seen + left.from_behind + left.of_behind;
  if (left.from_behind > 0.01 * all)
    lines.emplace_back("backs of the sender that are single-sided see the receiver: "
                       "they do not count");
  if (left.of_behind > 0.01 * all)
    lines.emplace_back("backs of the receiver that are single-sided are seen: they do not count");
  if (left.black > min_share * left.area)
    lines.push_back(fmt::format("{:.2g} % of what is sent ends on backs of single-sided surfaces, "
                                "which do not count",
                                100.0 * left.black / left.area));
  if (left.outside)
    lines.emplace_back("sides that see out of the scene do not count beside those that do not; "
                       "--sides both counts them");
  return lines;
}

} // namespace

Face turned_round(const Face& face) {
  Face turned = face;
  std::reverse(turned.polygon.vertices.begin(),
               turned.polygon.vertices.begin() + static_cast<std::ptrdiff_t>(face.polygon.size));
  turned.plane = {-face.plane.normal, -face.plane.offset};
  return turned;
}

std::vector<Face> sides_of_faces(const Scene& scene, std::span<const Face> faces, NodeSides sides) {
  std::vector<Face> result;
  if (may_count(sides, true))
    result.assign(faces.begin(), faces.end());
  for (const Face& face : faces)
    if (may_count(sides, false) && is_double_sided(scene, face))
      result.push_back(turned_round(face));
  return result;
}

static double area_of(const std::vector<Face>& faces) {
  double area = 0.0;
  for (const Face& face : faces)
    area += face.area;
  return area;
}

CountedSides counted_sides(const SideQuestion& question, const std::vector<Face>& from) {
  const std::vector<FaceViews> views = Survey(question, from).run();
  CountedSides counted;
  LeftOut left;
  std::vector<Face> backs;
  for (std::size_t f = 0; f < from.size(); ++f) {
    const double area = from[f].area;
    const auto counts =
        counting(question.scene, from[f], question.sides, views[f], left.outside);
    for (std::size_t s = 0; s < 2; ++s) {
      const SideView& view = views[f][s];
      if (counts[s]) {
        left.area += area;
        left.black += area * view.black;
        left.seen += area * view.lines;
        left.of_behind += area * view.behind;
      } else if (s == 1 && !is_double_sided(question.scene, from[f])) {
        left.from_behind += area * view.lines;
      }
    }
    if (counts[0])
      counted.faces.push_back(from[f]);
    if (counts[1])
      backs.push_back(turned_round(from[f]));
  }
  // The fronts come first, so that backs which lie on them take no part of theirs.
  const double tolerance = question.surfaces.tolerance;
  counted.fronts = area_of(without_overlaps(counted.faces, tolerance));
  counted.faces.insert(counted.faces.end(), backs.begin(), backs.end());
  counted.faces = without_overlaps(counted.faces, tolerance);
  counted.backs = area_of(counted.faces) - counted.fronts;
  if (question.to.size() == 1)
    left.black = 0.0; // it takes nothing from the one that is asked for
  counted.not_counted = lines_of(left);
  return counted;
}

} // namespace meninas
