#include "scenes/materials/refraction.h"

#include <cmath>

namespace meninas {

Bsdf from_behind(Bsdf bsdf) {
  if (bsdf.pane.faces == GlassFaces::one && bsdf.pane.ior > 0.0)
    bsdf.pane.ior = 1.0 / bsdf.pane.ior;
  return bsdf;
}

std::optional<Direction> direction_behind(const Glass& glass, const Direction& out) {
  if (glass.faces != GlassFaces::one)
    return -out;
  const double x = -out.x / glass.ior, y = -out.y / glass.ior;
  const double sine2 = x * x + y * y;
  if (!(glass.ior > 0.0 && sine2 < 1.0))
    return std::nullopt;
  return Direction(x, y, -std::sqrt(1.0 - sine2));
}

} // namespace meninas
