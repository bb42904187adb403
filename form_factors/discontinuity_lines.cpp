#include "form_factors/discontinuity_lines.h"

#include <algorithm>
#include <map>
#include <optional>
#include <span>

namespace meninas {

namespace {

/// A corner of what is looked at, and the plane before which all that hides it stands.
struct Sight {
  Point3 corner;
  Plane plane;
  PlaneId plane_class = none<PlaneId>;
};

/// The corners of a polygon. Objects that reach down to the face's plane throw shadows of any length,
/// so edges towards it have points at falling heights as well.
void append_sights(const ConvexPolygon& polygon, const Plane& plane, PlaneId plane_class,
                   const Plane& face, std::vector<Sight>& sights) {
  constexpr double step = 0.25, lowest = 1e-4;
  for (std::size_t k = 0; k < polygon.size; ++k) {
    const Point3& corner = polygon.vertices[k];
    const double height = signed_distance(face, corner);
    if (height <= 0.0)
      continue;
    sights.push_back({corner, plane, plane_class});
    for (const std::size_t n : {k + 1, k + polygon.size - 1}) {
      const Point3& next = polygon.vertices[n % polygon.size];
      const double end = std::max(signed_distance(face, next), 0.0);
      for (double h = step * height; h > std::max(end, lowest * height); h *= step)
        sights.push_back(
            {glm::mix(corner, next, (height - h) / (height - signed_distance(face, next))), plane,
             plane_class});
    }
  }
}

/// The targets that are asked for; of more than `most` every so manyth tells how they are spread.
std::vector<const Face*> asked_targets(const WorldView& view,
                                       const std::vector<std::uint8_t>& known, std::size_t most) {
  std::vector<const Face*> asked;
  for (std::size_t t = 0; t < view.targets.size(); ++t)
    if (known.empty() || known[t] == 0)
      asked.push_back(&view.targets[t]);
  const std::size_t stride = std::max<std::size_t>(1, (asked.size() + most - 1) / most);
  std::vector<const Face*> chosen;
  for (std::size_t k = 0; k < asked.size(); k += stride)
    chosen.push_back(asked[k]);
  return chosen;
}

/// The sights of the real world: targets, and the windows of mirrors.
std::vector<Sight> sights_of(const Face& face, const WorldView& view,
                             const std::vector<std::uint8_t>& known,
                             std::span<const Mirror> mirrors) {
  constexpr std::size_t max_faces = 64;
  std::vector<Sight> sights;
  for (const Face* target : asked_targets(view, known, max_faces))
    append_sights(target->polygon, target->plane, target->plane_class, face.plane, sights);
  for (const Mirror& mirror : mirrors)
    for (const ConvexPolygon& part : mirror.window)
      append_sights(part, mirror.plane, mirror.plane_class, face.plane, sights);
  return sights;
}

/// The targets as they are seen in a mirror.
std::vector<Sight> images_in(const Plane& mirror, const Face& face, const WorldView& view) {
  constexpr std::size_t max_faces = 16;
  std::vector<Sight> sights;
  for (const Face* target : asked_targets(view, {}, max_faces)) {
    ConvexPolygon image;
    for (const Point3& corner : target->polygon.span())
      image.push_back(reflect_point(mirror, corner));
    append_sights(image, reflect_plane(mirror, target->plane), none<PlaneId>, face.plane, sights);
  }
  return sights;
}

/// The edges before a mirror, as they are seen in it.
std::vector<BlockerEdge> edges_in(const Plane& mirror, const std::vector<BlockerEdge>& edges) {
  std::vector<BlockerEdge> images;
  for (const BlockerEdge& edge : edges) {
    if (signed_distance(mirror, edge.from) < 0.0 && signed_distance(mirror, edge.to) < 0.0)
      continue;
    BlockerEdge image{
        reflect_point(mirror, edge.from), reflect_point(mirror, edge.to), none<PlaneId>, {}};
    for (const Point3& beside : edge.beside)
      image.beside.push_back(reflect_point(mirror, beside));
    images.push_back(std::move(image));
  }
  return images;
}

/// As many as there is time for, evenly.
void thin_out(std::vector<Sight>& sights, std::size_t most) {
  const std::size_t stride = sights.size() / std::max<std::size_t>(1, most) + 1;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < sights.size(); k += stride)
    sights[kept++] = sights[k];
  sights.resize(kept);
}

/// The shadow on the face that an edge throws from one corner.
struct ShadowLine {
  Point3 from, to;
  double offset = 0.0; ///< across the band
};

/// The part of a segment, by its ends' distances from a plane, where they exceed a least one.
bool keep_above(double from, double to, double least, double& begin, double& end) {
  if (from <= least && to <= least)
    return false;
  const double t = (least - from) / (to - from);
  if (from < least)
    begin = std::max(begin, t);
  else if (to < least)
    end = std::min(end, t);
  return begin < end;
}

/// Nothing from edges inside a sheet, whose two faces continue each other seen from the corner.
bool is_outline(const BlockerEdge& edge, const Point3& corner) {
  const Vec3 across = glm::cross(edge.from - corner, edge.to - edge.from);
  bool below = false, above = false;
  for (const Point3& beside : edge.beside) {
    const double side = glm::dot(across, beside - edge.from);
    below |= side < 0.0;
    above |= side > 0.0;
  }
  return !(below && above);
}

/// The part of the edge between the corner and the face, projected on the face.
std::optional<ShadowLine> shadow_of(const BlockerEdge& edge, const Sight& sight, const Plane& face,
                                    double tolerance) {
  // Towards the height of the corner the shadow runs off to infinity.
  constexpr double highest = 0.999;
  const double height = signed_distance(face, sight.corner);
  if (height <= tolerance || !is_outline(edge, sight.corner))
    return std::nullopt;
  const double from = signed_distance(face, edge.from), to = signed_distance(face, edge.to);
  double begin = 0.0, end = 1.0;
  if (!keep_above(from, to, 0.0, begin, end) ||
      !keep_above(-from, -to, -highest * height, begin, end) ||
      !keep_above(signed_distance(sight.plane, edge.from), signed_distance(sight.plane, edge.to),
                  tolerance, begin, end))
    return std::nullopt;
  const auto thrown = [&](double t) {
    const Point3 x = glm::mix(edge.from, edge.to, t);
    return sight.corner + height / (height - glm::mix(from, to, t)) * (x - sight.corner);
  };
  return ShadowLine{thrown(begin), thrown(end)};
}

/// An edge's shadow lines, those in one direction, by where they cross the band.
struct Band {
  std::vector<ShadowLine> lines;
  Direction along{0.0}, across{0.0};
};

Band band_of(const BlockerEdge& edge, const Face& face, const std::vector<Sight>& sights,
             double tolerance) {
  constexpr double aligned = 0.9;
  Band band;
  band.lines.reserve(sights.size());
  Vec3 sum(0.0);
  for (const Sight& sight : sights) {
    if (edge.plane_class == sight.plane_class && edge.plane_class != none<PlaneId>)
      continue;
    const auto line = shadow_of(edge, sight, face.plane, tolerance);
    if (!line || glm::distance(line->from, line->to) <= tolerance)
      continue;
    band.lines.push_back(*line);
    sum += glm::normalize(line->to - line->from);
  }
  if (glm::length(sum) <= 0.5 * static_cast<double>(band.lines.size()))
    return {};
  band.along = glm::normalize(sum);
  band.across = glm::cross(face.plane.normal, band.along);
  std::erase_if(band.lines, [&](const ShadowLine& line) {
    const Vec3 run = line.to - line.from;
    return glm::dot(run, band.along) < aligned * glm::length(run);
  });
  for (ShadowLine& line : band.lines)
    line.offset = glm::dot(band.across, 0.5 * (line.from + line.to) - face.centre);
  std::ranges::sort(band.lines, {}, &ShadowLine::offset);
  return band;
}

/// A line to cut along, and how much may hide beside it.
struct Cut {
  Point3 from, to;
  double amount = 0.0;
};

/// The cuts that one band asks for.
class BandCuts {
public:
  BandCuts(const Band& band, double tolerance, std::vector<Cut>& cuts)
      : band_(band), tolerance_(tolerance), cuts_(cuts) {
    for (const ShadowLine& line : band.lines)
      if (distinct_.empty() || line.offset > distinct_.back()->offset + tolerance)
        distinct_.push_back(&line);
  }

  /// Where half of the lines between two offsets lie closely together,
  /// that is cut out, and all three parts are looked at in turn.
  void look(double low, double high) {
    constexpr double narrow = 0.25;
    const auto first = std::ranges::find_if(
        distinct_, [&](const ShadowLine* line) { return line->offset > low + tolerance_; });
    const auto last = std::find_if(first, distinct_.end(), [&](const ShadowLine* line) {
      return line->offset >= high - tolerance_;
    });
    const auto count = last - first;
    if (count < 2)
      return;
    const auto half = std::max<std::ptrdiff_t>(2, (count + 1) / 2);
    auto begin = first;
    const auto width = [half](auto at) { return (*(at + half - 1))->offset - (*at)->offset; };
    for (auto at = first; last - at >= half; ++at)
      if (width(at) < width(begin))
        begin = at;
    if (width(begin) >= narrow * (high - low))
      return;
    const double from = (*begin)->offset, to = (*(begin + half - 1))->offset;
    add(**begin, from, to);
    add(**(begin + half - 1), from, to);
    look(low, from);
    look(from, to);
    look(to, high);
  }

private:
  /// The line as far as any of its neighbours reaches: the corners of a shadow are cut out as well.
  void add(const ShadowLine& line, double low, double high) {
    double begin = std::numeric_limits<double>::infinity(), end = -begin;
    for (const ShadowLine& other : band_.lines) {
      if (other.offset < low || other.offset > high)
        continue;
      begin = std::min(begin, glm::dot(other.from - line.from, band_.along));
      end = std::max(end, glm::dot(other.to - line.from, band_.along));
    }
    const Vec3 run = line.to - line.from;
    const Vec3 step = run / glm::dot(run, band_.along);
    cuts_.push_back(
        {line.from + begin * step, line.from + end * step, (high - low) * (end - begin)});
  }

  const Band& band_;
  double tolerance_;
  std::vector<Cut>& cuts_;
  std::vector<const ShadowLine*> distinct_;
};

void add_cuts(const Face& face, const std::vector<BlockerEdge>& edges,
              const std::vector<Sight>& sights, double tolerance, std::vector<Cut>& cuts) {
  for (const BlockerEdge& edge : edges) {
    if (edge.plane_class == face.plane_class)
      continue;
    const Band band = band_of(edge, face, sights, tolerance);
    if (band.lines.size() < 2)
      continue;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Point3& vertex : face.polygon.span()) {
      const double offset = glm::dot(band.across, vertex - face.centre);
      low = std::min(low, offset);
      high = std::max(high, offset);
    }
    // A band that begins on the face may end at its edge, or a little beyond it.
    const double beyond = 0.02 * (high - low);
    BandCuts(band, tolerance, cuts).look(low - beyond, high + beyond);
  }
}

} // namespace

std::vector<BlockerEdge> edges_of(const std::vector<Face>& blockers) {
  const auto key_of = [](const Point3& a, const Point3& b) {
    std::array<std::array<double, 3>, 2> ends{{{a.x, a.y, a.z}, {b.x, b.y, b.z}}};
    std::ranges::sort(ends);
    return ends;
  };
  std::vector<BlockerEdge> edges;
  std::map<std::array<std::array<double, 3>, 2>, std::size_t> found;
  for (const Face& face : blockers)
    for (std::size_t k = 0; k < face.polygon.size; ++k) {
      const Point3 &from = face.polygon.vertices[k],
                   &to = face.polygon.vertices[k + 1 < face.polygon.size ? k + 1 : 0];
      const auto [at, is_new] = found.emplace(key_of(from, to), edges.size());
      if (is_new)
        edges.push_back({from, to, face.plane_class, {}});
      edges[at->second].beside.push_back(face.centre);
    }
  return edges;
}

void cut_at_discontinuity_lines(std::vector<ConvexPolygon>& parts, const Face& face, const WorldView& view,
                    const std::vector<BlockerEdge>& edges, const std::vector<std::uint8_t>& known,
                    const LineLimits& limits) {
  constexpr std::size_t max_mirrors = 16, min_sights = 16;
  const std::size_t max_parts = std::min(enough_parts_at_lines, limits.max_parts);
  const std::span<const Mirror> mirrors(
      view.mirrors.mirrors.data(),
      limits.by_mirrors ? std::min(max_mirrors, view.mirrors.mirrors.size()) : 0);
  const std::size_t max_sights =
      limits.max_lines / std::max<std::size_t>(1, edges.size() * (1 + 2 * mirrors.size()));
  if (max_sights < min_sights || parts.size() >= max_parts)
    return;
  std::vector<Cut> cuts;
  const auto add = [&](const std::vector<BlockerEdge>& these, std::vector<Sight> sights) {
    thin_out(sights, max_sights);
    add_cuts(face, these, sights, view.tolerance, cuts);
  };
  add(edges, sights_of(face, view, known, mirrors));
  for (const Mirror& mirror : mirrors) {
    const std::vector<Sight> images = images_in(mirror.plane, face, view);
    add(edges, images);
    add(edges_in(mirror.plane, edges), images);
  }
  std::ranges::stable_sort(cuts, std::greater{}, &Cut::amount);
  for (const Cut& cut : cuts) {
    if (parts.size() >= max_parts)
      return;
    cut_along(parts, cut.from, cut.to, face.plane.normal, view.tolerance);
  }
}

} // namespace meninas
