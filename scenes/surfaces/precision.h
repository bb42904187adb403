// The precision of positions: alike where the detail of a scene is, lower far beyond.
//
// Floats round a position by a share of its distance from their origin, and so do the programs
// that wrote them. In most scenes one bound on that holds for all: the scene's extent is that of
// its detail. But a ground of a thousand kilometres, or one triangle far away, is known to
// decimetres and says nothing of the room that stands there. The detail of a scene is what lies
// within a multiple of the median distance of its vertices from their median; all of it is known
// alike, and what is beyond by its own distance.
#pragma once

#include "scenes/scene.h"

namespace meninas {

/// A ball that holds most vertices.
struct Detail {
  Point3 centre{0.0};
  double radius = 0.0;
  bool is_all = true; ///< nothing is beyond
};

Detail detail_of(const Scene& scene);

class Precision {
public:
  explicit Precision(const Scene& scene);

  const Detail& detail() const { return detail_; }
  /// The distance by which a vertex of a wall may be off its plane, in metres.
  double in_detail() const { return in_detail_; }
  double at(VertexId vertex) const;
  double of(TriangleId triangle) const;    ///< the least known of its corners
  double alone(TriangleId triangle) const; ///< were there nothing else in the scene

private:
  const Scene& scene_;
  Detail detail_;
  double in_detail_ = 0.0, error_ = 0.0;
};

} // namespace meninas
