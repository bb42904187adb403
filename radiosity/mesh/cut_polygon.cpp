#include "radiosity/mesh/cut_polygon.h"

#include "scenes/surfaces/disjoint_sets.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

constexpr std::size_t max_pieces = 64;
constexpr double max_blocked = 0.02; ///< of the polygon's size, and no more than is open: pieces
                                     ///< that more parts are two regions
constexpr double min_gap = 1.0 / 16.0; ///< of the polygon's size: what is hovering for
                                       ///< contact_segments.h is standing here

double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

struct Line {
  Vec2 normal;
  double offset;
  double height(Vec2 x) const { return glm::dot(normal, x) - offset; }
};

/// Whichever end comes first, so that what is cut does not depend on how segments were found.
Line line_through(Vec2 a, Vec2 b) {
  constexpr double upright = 1e-6;
  Vec2 along = glm::normalize(b - a);
  if (along.x < -upright || (along.x < upright && along.y < 0.0))
    along = -along;
  const Vec2 normal(-along.y, along.x);
  return {normal, glm::dot(normal, a)};
}

/// The longest; of those as long, to rounding, the one whose middle comes first.
const Segment2& longest_of(std::span<const Segment2> segments) {
  constexpr double alike = 1e-6;
  const Segment2* longest = &segments[0];
  for (const Segment2& s : segments) {
    const double length = glm::distance(s.a, s.b), most = glm::distance(longest->a, longest->b);
    const Vec2 before = s.a + s.b - (longest->a + longest->b);
    const bool comes_first = before.x < -alike * most ||
                             (before.x < alike * most && before.y < -alike * most);
    if (length > (1.0 + alike) * most || (length > (1.0 - alike) * most && comes_first))
      longest = &s;
  }
  return *longest;
}

/// The part of a convex polygon on one side of a line; `sign` -1: below it.
std::vector<Vec2> part_beyond(std::span<const Vec2> polygon, const Line& line, double sign) {
  std::vector<Vec2> part;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    const double ha = sign * line.height(a), hb = sign * line.height(b);
    if (ha >= 0.0)
      part.push_back(a);
    if ((ha > 0.0 && hb < 0.0) || (ha < 0.0 && hb > 0.0))
      part.push_back(glm::mix(a, b, ha / (ha - hb)));
  }
  return part;
}

/// The pieces, cut one by one.
struct Cutter {
  double grain;
  CutPolygon cut;

  /// The number of the piece or line that stands for the polygon.
  std::uint32_t add(std::vector<Vec2> polygon, std::span<const Segment2> segments) {
    std::vector<Segment2> inside;
    for (Segment2 segment : segments)
      if (clip_to(polygon, grain, segment) && glm::distance(segment.a, segment.b) > 4.0 * grain &&
          divides(polygon, line_through(segment.a, segment.b)))
        inside.push_back(segment);
    if (inside.empty() || cut.pieces.size() + cut.lines.size() >= max_pieces) {
      cut.pieces.push_back(std::move(polygon));
      return CutLine::piece | static_cast<std::uint32_t>(cut.pieces.size() - 1);
    }
    const Segment2 longest = longest_of(inside);
    const Line line = line_through(longest.a, longest.b);
    const auto number = static_cast<std::uint32_t>(cut.lines.size());
    cut.lines.push_back({line.normal, line.offset, {}});
    for (const std::size_t side : {0U, 1U}) {
      const std::uint32_t next = add(part_beyond(polygon, line, side == 0 ? -1.0 : 1.0), inside);
      cut.lines[number].next[side] = next;
    }
    return number;
  }

  /// Whether more than a border's grain lies on either side.
  bool divides(std::span<const Vec2> polygon, const Line& line) const {
    double low = 0.0, high = 0.0;
    for (const Vec2 x : polygon) {
      low = std::min(low, line.height(x));
      high = std::max(high, line.height(x));
    }
    return low < -grain && high > grain;
  }
};

/// The common stretch of two edges that run along one line, as a segment of the first.
bool common_stretch(const Segment2& one, const Segment2& other, double grain, Segment2& common) {
  const double length = glm::distance(one.a, one.b);
  if (!(length > grain))
    return false;
  const Vec2 along = (one.b - one.a) / length;
  if (std::abs(cross(along, other.a - one.a)) > grain ||
      std::abs(cross(along, other.b - one.a)) > grain)
    return false;
  const double p = glm::dot(along, other.a - one.a), q = glm::dot(along, other.b - one.a);
  const double from = std::max(0.0, std::min(p, q)), to = std::min(length, std::max(p, q));
  if (to - from <= grain)
    return false;
  common = {one.a + from * along, one.a + to * along};
  return true;
}

/// The part of the line through a segment that lies within a convex polygon.
Segment2 chord_of(std::span<const Vec2> polygon, double grain, const Segment2& way) {
  double around = 0.0;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    around += glm::distance(polygon[k], polygon[(k + 1) % polygon.size()]);
  const Vec2 along = around / glm::distance(way.a, way.b) * (way.b - way.a);
  Segment2 chord{way.a - along, way.a + along};
  return clip_to(polygon, grain, chord) ? chord : way;
}

/// The blocked length of the way between two pieces. Light finds no way through a gap narrower
/// than `narrow` that segments leave on the chord on which the way lies.
double blocked_length(const Segment2& way, const Segment2& chord, double narrow,
                      std::span<const Segment2> segments, double grain) {
  const double length = glm::distance(chord.a, chord.b);
  const Vec2 along = (chord.b - chord.a) / length;
  const double a = glm::dot(along, way.a - chord.a) / length;
  const double b = glm::dot(along, way.b - chord.a) / length;
  const Stretch own{std::min(a, b), std::max(a, b)};
  double open = 0.0, from = 0.0;
  const auto pass = [&](double to) {
    if ((to - from) * length > narrow || to - from >= 1.0)
      open += std::max(0.0, std::min(to, own.to) - std::max(from, own.from));
  };
  for (const Stretch& stretch : met_along(chord.a, chord.b, segments, grain)) {
    pass(stretch.from);
    from = stretch.to;
  }
  pass(1.0);
  return std::max(0.0, own.to - own.from - open) * length;
}

/// Joins the pieces between which nothing stands.
void number_regions(std::span<const Vec2> polygon, std::span<const Segment2> segments,
                    double grain, CutPolygon& cut) {
  const double size = std::sqrt(std::abs(area_of(polygon)));
  DisjointSets sets(cut.pieces.size());
  const auto edge = [&](std::size_t piece, std::size_t k) {
    const auto& points = cut.pieces[piece];
    return Segment2{points[k], points[(k + 1) % points.size()]};
  };
  for (std::size_t i = 0; i < cut.pieces.size(); ++i)
    for (std::size_t j = i + 1; j < cut.pieces.size(); ++j)
      for (std::size_t k = 0; k < cut.pieces[i].size(); ++k)
        for (std::size_t l = 0; l < cut.pieces[j].size(); ++l)
          if (Segment2 common; common_stretch(edge(i, k), edge(j, l), grain, common)) {
            const double blocked = blocked_length(common, chord_of(polygon, grain, common),
                                                  min_gap * size, segments, grain);
            if (blocked <= max_blocked * size && blocked < 0.5 * glm::distance(common.a, common.b))
              sets.join(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
          }
  std::vector<std::uint32_t> number(cut.pieces.size(), CutLine::piece);
  cut.regions = 0;
  for (std::uint32_t i = 0; i < cut.pieces.size(); ++i) {
    std::uint32_t& region = number[sets.root(i)];
    if (region == CutLine::piece)
      region = cut.regions++;
    cut.region.push_back(region);
  }
}

} // namespace

double area_of(std::span<const Vec2> polygon) {
  double sum = 0.0;
  for (std::size_t k = 2; k < polygon.size(); ++k)
    sum += cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  return 0.5 * sum;
}

bool clip_to(std::span<const Vec2> polygon, double grain, Segment2& segment) {
  double from = 0.0, to = 1.0;
  const Vec2 way = segment.b - segment.a;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    const double length = glm::distance(a, b);
    if (!(length > 0.0))
      continue;
    const Vec2 along = (b - a) / length;
    const double start = cross(along, segment.a - a), change = cross(along, way);
    const double allowed = -grain - start; // start + t change >= -grain
    if (change == 0.0) {
      if (allowed > 0.0)
        return false;
    } else if (change > 0.0) {
      from = std::max(from, allowed / change);
    } else {
      to = std::min(to, allowed / change);
    }
  }
  if (!(from <= to))
    return false;
  segment = {segment.a + from * way, segment.a + to * way};
  return true;
}

std::vector<Stretch> met_along(Vec2 a, Vec2 b, std::span<const Segment2> segments, double grain) {
  std::vector<Stretch> met;
  const double length = glm::distance(a, b);
  if (!(length > 0.0))
    return met;
  const Vec2 along = (b - a) / length;
  for (const Segment2& segment : segments) {
    // The part of the segment within the grain of the line, and of the way.
    double from = 0.0, to = 1.0;
    const Vec2 way = segment.b - segment.a;
    const auto keep = [&](double start, double change, double limit) { // start + t change <= limit
      if (std::abs(change) <= 1e-300) {
        if (start > limit)
          to = -1.0;
      } else if (change > 0.0) {
        to = std::min(to, (limit - start) / change);
      } else {
        from = std::max(from, (limit - start) / change);
      }
    };
    const double aside = cross(along, segment.a - a), turn = cross(along, way);
    const double ahead = glm::dot(along, segment.a - a), advance = glm::dot(along, way);
    keep(aside, turn, grain);
    keep(-aside, -turn, grain);
    keep(ahead, advance, length + grain);
    keep(-ahead, -advance, grain);
    if (!(from <= to))
      continue;
    const double p = std::clamp((ahead + from * advance) / length, 0.0, 1.0),
                 q = std::clamp((ahead + to * advance) / length, 0.0, 1.0);
    met.push_back({std::min(p, q), std::max(p, q)});
  }
  std::ranges::sort(met, {}, &Stretch::from);
  std::vector<Stretch> joined;
  for (const Stretch& stretch : met)
    if (!joined.empty() && stretch.from <= joined.back().to + grain / length)
      joined.back().to = std::max(joined.back().to, stretch.to);
    else
      joined.push_back(stretch);
  return joined;
}

CutPolygon cut_polygon(std::span<const Vec2> polygon, std::span<const Segment2> segments,
                       double grain) {
  Cutter cutter{grain, {}};
  cutter.add({polygon.begin(), polygon.end()}, segments);
  number_regions(polygon, segments, grain, cutter.cut);
  return std::move(cutter.cut);
}

std::vector<Stretch> stretches_along(Vec2 a, Vec2 b, const CutPolygon& cut, std::uint32_t region,
                                     double grain) {
  const double length = glm::distance(a, b);
  const Vec2 along = (b - a) / length, aside(-along.y, along.x);
  std::vector<Stretch> found;
  for (std::size_t p = 0; p < cut.pieces.size(); ++p) {
    if (cut.region[p] != region)
      continue;
    const auto& points = cut.pieces[p];
    for (std::size_t c = 0; c < points.size(); ++c) {
      const Vec2 x = points[c] - a, y = points[(c + 1) % points.size()] - a;
      if (std::abs(glm::dot(aside, x)) > grain || std::abs(glm::dot(aside, y)) > grain)
        continue;
      const double s = glm::dot(along, x) / length, t = glm::dot(along, y) / length;
      if (std::abs(s - t) * length > 2.0 * grain)
        found.push_back({std::min(s, t), std::max(s, t)});
    }
  }
  return found;
}

bool has_corner(const CutPolygon& cut, std::uint32_t region, Vec2 point, double grain) {
  for (std::size_t p = 0; p < cut.pieces.size(); ++p)
    if (cut.region[p] == region && std::ranges::any_of(cut.pieces[p], [&](Vec2 x) {
          return glm::distance(x, point) <= grain;
        }))
      return true;
  return false;
}

} // namespace meninas
