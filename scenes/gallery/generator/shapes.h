// The shapes the gallery is made of. Each is a value;
// fronts face outwards, or along u x v for flat ones.
#pragma once

#include "scenes/gallery/generator/stage.h"

#include <span>

namespace meninas::gallery {

/// A convex polygon, counter-clockwise seen from the front.
Mesh polygon(std::span<const Point3> corners);
Mesh quad(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// Where flat things are laid out:
/// the point corner + s u + t v, with unit u and v, and the front along u x v.
struct Sheet {
  Point3 corner;
  Direction u;
  Direction v;

  Point3 at(double s, double t, double off = 0.0) const {
    return corner + s * u + t * v + off * glm::cross(u, v);
  }
};

/// low.x <= s <= high.x, low.y <= t <= high.y on a sheet.
struct Rect {
  Vec2 low;
  Vec2 high;
};

inline Rect grown(const Rect& rect, double by) { return {rect.low - by, rect.high + by}; }

/// A rectangle, `off` metres in front of its sheet.
Mesh panel(const Sheet& sheet, const Rect& rect, double off);

/// A wall with rectangular openings, divided along all their edges,
/// so that no vertex lies on another's edge.
Mesh wall(const Sheet& sheet, const Rect& extent, std::span<const Rect> openings);

/// The four sides of an opening, `depth` metres back from the sheet, facing into the opening.
Mesh reveal(const Sheet& sheet, const Rect& opening, double depth);

/// A picture frame around `inside`, mitred:
/// outer sides from the sheet, a front, and inner sides back to `rebate`.
struct Moulding {
  double width = 0.1;
  double depth = 0.06;
  double rebate = 0.02; ///< distance from the sheet at which the framed picture lies
};
Mesh frame(const Sheet& sheet, const Rect& inside, const Moulding& moulding);

/// A flat bar that lies on a sheet:
/// its sides from `from` to `to` metres off the sheet, and its face.
Mesh batten(const Sheet& sheet, const Rect& rect, double from, double to);

/// A square bar between two points, closed at both ends.
Mesh bar(const Point3& from, const Point3& to, double thickness);

enum class Face { x0, x1, y0, y1, z0, z1 };

/// An axis-parallel box without the faces in `open` (where it stands on, or joins, something else).
Mesh box(const Point3& low, const Point3& high, std::span<const Face> open = {});
Mesh standing_box(const Point3& low, const Point3& high);

/// One wall of the room from low to high, facing in.
Mesh room_wall(const Point3& low, const Point3& high, Face face);

/// Sides and top over a convex base of (x, z) corners, in either order; no bottom.
Mesh standing_prism(std::span<const Vec2> base, double bottom, double top);

/// A surface of revolution about the vertical axis through `foot`:
/// a profile of (radius, height) from the bottom up.
Mesh lathe(const Point3& foot, std::span<const Vec2> profile, int sides);

/// Corners of a regular polygon in (x, z), a side of it facing +z.
std::vector<Vec2> regular(const Vec2& centre, double radius, int sides);

/// Normals and texture coordinates are kept where all have them, else they are to be left out before.
Mesh merged(std::span<const Mesh> meshes);
Mesh moved(Mesh mesh, const Vec3& by);
Mesh turned(Mesh mesh, const Point3& centre, const Direction& axis, double degrees);
Mesh scaled(Mesh mesh, const Point3& centre, const Vec3& factors);

/// With an image laid over it that is `size` metres long and high on the sheet,
/// from its corner, rows running down against v.
Mesh papered(Mesh mesh, const Sheet& sheet, double size);

/// The image in the mirror plane x = 0; fronts stay fronts.
Mesh mirrored_in_x(Mesh mesh);

} // namespace meninas::gallery
