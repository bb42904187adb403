#include "form_factors/point_worlds.h"

#include "form_factors/point_form_factor.h"

#include <algorithm>

namespace meninas {

namespace {

/// Polygons in as little room as they need, for the many that wait.
struct PackedPolygons {
  std::vector<Point3> vertices;
  std::vector<std::uint8_t> sizes;

  explicit PackedPolygons(const std::vector<ConvexPolygon>& polygons) {
    for (const auto& polygon : polygons) {
      vertices.insert(vertices.end(), polygon.span().begin(), polygon.span().end());
      sizes.push_back(static_cast<std::uint8_t>(polygon.size));
    }
    vertices.shrink_to_fit();
  }
  std::vector<ConvexPolygon> unpacked() const {
    std::vector<ConvexPolygon> polygons;
    auto from = vertices.begin();
    for (const std::uint8_t size : sizes) {
      polygons.emplace_back(std::span<const Point3>(from, from + size));
      from += size;
    }
    return polygons;
  }
};

/// The ball of directions and distances in which something is seen from a point.
struct Appearance {
  Direction towards{0.0};
  double distance = 0.0, radius = 0.0;
  double sine = 1.0, cosine = 0.0; ///< of the half angle of the ball
};

Appearance appearance_of(const Point3& x, const Point3& centre, double radius) {
  Appearance ball;
  ball.distance = glm::distance(centre, x);
  ball.radius = radius;
  if (ball.distance > radius) {
    ball.towards = (centre - x) / ball.distance;
    ball.sine = radius / ball.distance;
    ball.cosine = std::sqrt((1.0 - ball.sine) * (1.0 + ball.sine));
  }
  return ball;
}

Appearance appearance_of(const Point3& x, const ConvexPolygon& polygon) {
  Point3 centre(0.0);
  for (const auto& vertex : polygon.span())
    centre += vertex / static_cast<double>(polygon.size);
  double radius = 0.0;
  for (const auto& vertex : polygon.span())
    radius = std::max(radius, glm::distance(vertex, centre));
  return appearance_of(x, centre, radius);
}

/// Whether the one may stand before the other: not wholly behind it, nor wholly beside it.
bool may_hide(const Appearance& near, const Appearance& far) {
  if (near.distance - near.radius > far.distance + far.radius)
    return false;
  if (near.distance <= near.radius || far.distance <= far.radius)
    return true;
  constexpr double rounding = 1e-12;
  const double cosine_of_both = near.cosine * far.cosine - near.sine * far.sine;
  return glm::dot(near.towards, far.towards) >= cosine_of_both - rounding;
}

/// One world on the way: where it stands in unfolded space, and what of the way in is open.
struct Station {
  std::uint32_t world = 0;
  int depth = 0;
  Isometry image;
  Plane plane; ///< of the last mirror, normal towards x
  MirrorId mirror = none<MirrorId>;
  PlaneId plane_class = none<PlaneId>; ///< the leg leaves this plane
  Rgb throughput{1.0};
  std::vector<ConvexPolygon> openings; ///< visible parts of the last mirror's window
};

/// A world that may be entered next.
struct Waiting {
  double bound = 0.0; ///< on what it and all behind it can bring
  std::uint32_t parent = 0;
  MirrorId mirror = none<MirrorId>;
  PackedPolygons openings;
};

/// The data of an entered world that its children need.
struct Entered {
  Isometry image;
  int depth = 0;
  Rgb throughput{1.0};
};

class Walk {
public:
  Walk(const WorldView& view, const WalkPoint& point, const WalkSettings& settings,
       const std::vector<std::uint8_t>& known)
      : view_(view), point_(point), settings_(settings), known_(known) {}

  WalkResult run() {
    result_.worlds.emplace_back();
    Station real;
    real.plane_class = point_.plane_class;
    visit(real);
    while (!waiting_.empty() && left_out() > settings_.tail &&
           result_.worlds.size() < settings_.max_worlds) {
      std::pop_heap(waiting_.begin(), waiting_.end(), by_bound);
      const Waiting next = std::move(waiting_.back());
      waiting_.pop_back();
      waiting_bound_ -= next.bound;
      visit(station_of(next));
    }
    result_.tail = left_out();
    return std::move(result_);
  }

private:
  struct Obstacle {
    ConvexPolygon polygon;
    PlaneId plane_class;
    Appearance ball;
  };

  static bool by_bound(const Waiting& a, const Waiting& b) { return a.bound < b.bound; }

  double left_out() const { return waiting_.empty() ? 0.0 : std::max(0.0, waiting_bound_); }

  /// Where the world behind the parent's next mirror stands.
  Station station_of(const Waiting& waiting) {
    const Mirror& mirror = view_.mirrors.mirrors[index(waiting.mirror)];
    const Entered& parent = entered_[waiting.parent];
    Station station;
    station.world = static_cast<std::uint32_t>(result_.worlds.size());
    station.depth = parent.depth + 1;
    station.image = compose_reflection(parent.image, mirror.plane);
    station.plane = apply(parent.image, mirror.plane);
    station.mirror = waiting.mirror;
    station.plane_class = mirror.plane_class;
    station.throughput = parent.throughput * mirror.reflectance;
    station.openings = waiting.openings.unpacked();
    result_.worlds.push_back({waiting.parent, waiting.mirror});
    return station;
  }

  void visit(const Station& station) {
    entered_.push_back({station.image, station.depth, station.throughput});
    result_.work += view_.blockers.size() + view_.targets.size() + view_.mirrors.mirrors.size();
    const auto obstacles = obstacles_of(station);
    add_targets(station, obstacles);
    if (station.depth >= settings_.max_depth)
      return;
    for (std::uint32_t m = 0; m < view_.mirrors.mirrors.size(); ++m)
      if (static_cast<MirrorId>(m) != station.mirror)
        enter(station, static_cast<MirrorId>(m), obstacles);
  }

  /// Whether a sphere of unfolded space may be met by light on this leg:
  /// above the horizon, beyond the mirror, in its opening's cone.
  bool within_reach(const Station& station, const Point3& centre, double radius) const {
    if (glm::dot(point_.normal, centre - point_.x) <= -radius)
      return false;
    if (station.depth == 0)
      return true;
    if (signed_distance(station.plane, centre) >= radius)
      return false;
    return std::any_of(
        station.openings.begin(), station.openings.end(),
        [&](const ConvexPolygon& opening) { return may_show(opening, centre, radius); });
  }

  bool may_show(const ConvexPolygon& opening, const Point3& centre, double radius) const {
    const double side = glm::dot(area_vector(opening.span()), opening.vertices[0] - point_.x);
    for (std::size_t k = 0; k < opening.size; ++k) {
      const Vec3 a = opening.vertices[k] - point_.x;
      const Vec3 normal =
          glm::cross(a, opening.vertices[k + 1 < opening.size ? k + 1 : 0] - opening.vertices[k]);
      const double height = glm::dot(normal, centre - point_.x);
      if ((side > 0.0 ? height : -height) < -radius * glm::length(normal))
        return false;
    }
    return true;
  }

  /// The scene as it stands on this leg, as far as it can be met,
  /// cut off at the mirror the leg leaves.
  std::vector<Obstacle> obstacles_of(const Station& station) const {
    std::vector<Obstacle> obstacles;
    for (const Face& face : view_.blockers) {
      if (face.plane_class == station.plane_class)
        continue;
      const Point3 centre = apply(station.image, face.centre);
      if (!within_reach(station, centre, face.radius))
        continue;
      if (std::abs(signed_distance(apply(station.image, face.plane), point_.x)) <= view_.tolerance)
        continue;
      ConvexPolygon image = clip(apply(station.image, face.polygon), point_.x, point_.normal);
      if (station.depth > 0)
        clip_in_place(image, origin_of(station.plane), -station.plane.normal);
      if (!image.empty())
        obstacles.push_back(
            {image, face.plane_class, appearance_of(point_.x, centre, face.radius)});
    }
    return obstacles;
  }

  /// Appends the parts of a polygon of this world, in unfolded space, that x sees.
  void append_visible(const Station& station, const ConvexPolygon& polygon, const Plane& plane,
                      PlaneId plane_class, const std::vector<Obstacle>& obstacles,
                      std::vector<ConvexPolygon>& visible) {
    ConvexPolygon above = clip(polygon, point_.x, point_.normal);
    if (station.depth > 0)
      clip_in_place(above, origin_of(station.plane), -station.plane.normal);
    if (above.empty())
      return;
    std::vector<ConvexPolygon> parts;
    if (station.depth == 0)
      parts.push_back(above);
    for (const auto& opening : station.openings) {
      const ConvexPolygon part = clip_to_cone(above, point_.x, opening);
      if (!part.empty())
        parts.push_back(part);
    }
    const Appearance ball = appearance_of(point_.x, above);
    for (const auto& obstacle : obstacles) {
      if (parts.empty())
        break;
      ++result_.work;
      if (obstacle.plane_class == plane_class || !may_hide(obstacle.ball, ball))
        continue;
      result_.work += parts.size();
      subtract_cone(parts, point_.x, clip(obstacle.polygon, origin_of(plane), plane.normal));
    }
    visible.insert(visible.end(), parts.begin(), parts.end());
  }

  double factor_of(const std::vector<ConvexPolygon>& parts) const {
    double sum = 0.0;
    for (const auto& part : parts)
      sum += point_form_factor(point_.x, point_.normal, part.span());
    return sum;
  }

  void add_targets(const Station& station, const std::vector<Obstacle>& obstacles) {
    for (std::size_t t = 0; t < view_.targets.size(); ++t) {
      if (station.depth == 0 && !known_.empty() && known_[t] != 0)
        continue;
      const Face& target = view_.targets[t];
      // A leg that leaves a plane meets nothing in it,
      // such as the back of the mirror, which its image would show.
      if (target.plane_class == station.plane_class)
        continue;
      if (!within_reach(station, apply(station.image, target.centre), target.radius))
        continue;
      const Plane plane = apply(station.image, target.plane);
      if (signed_distance(plane, point_.x) <= view_.tolerance)
        continue;
      std::vector<ConvexPolygon> visible;
      append_visible(station, apply(station.image, target.polygon), plane, target.plane_class,
                     obstacles, visible);
      const double factor = factor_of(visible);
      if (factor > 0.0)
        result_.shares.push_back({station.world, view_.groups[t], factor});
    }
  }

  /// Goes on behind a mirror, unless nothing that matters can come from there.
  void enter(const Station& station, MirrorId id, const std::vector<Obstacle>& obstacles) {
    const Mirror& mirror = view_.mirrors.mirrors[index(id)];
    // Nor does it meet a mirror there: two reflections in one plane would
    // let it pass straight through a sheet that mirrors on both sides.
    if (mirror.plane_class == station.plane_class)
      return;
    const Plane plane = apply(station.image, mirror.plane);
    if (signed_distance(plane, point_.x) <= view_.tolerance)
      return;
    const double throughput = mean_of(station.throughput * mirror.reflectance);
    if (throughput <= 0.0)
      return;
    std::vector<ConvexPolygon> openings;
    for (const auto& part : mirror.window)
      append_visible(station, apply(station.image, part), plane, mirror.plane_class, obstacles,
                     openings);
    const double bound = throughput * factor_of(openings);
    if (bound <= 0.0)
      return;
    waiting_bound_ += bound;
    waiting_.push_back({bound, station.world, id, PackedPolygons(openings)});
    std::push_heap(waiting_.begin(), waiting_.end(), by_bound);
  }

  const WorldView& view_;
  const WalkPoint& point_;
  const WalkSettings& settings_;
  const std::vector<std::uint8_t>& known_;
  std::vector<Entered> entered_; ///< by world
  std::vector<Waiting> waiting_; ///< a heap: the largest bound first
  double waiting_bound_ = 0.0;   ///< sum over those waiting
  WalkResult result_;
};

} // namespace

WalkResult walk_worlds(const WorldView& view, const WalkPoint& point, const WalkSettings& settings,
                       const std::vector<std::uint8_t>& known) {
  return Walk(view, point, settings, known).run();
}

} // namespace meninas
