// Numbers for tests that try many cases: the same on every run and every platform.
#pragma once

#include "scenes/types.h"

#include <random>

namespace meninas::test {

class Random {
public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}

  /// In [low, high);
  /// built from the engine's bits because the standard's distributions differ between libraries.
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) * 0x1p-32);
  }
  Vec3 in_box(const Vec3& low, const Vec3& high) {
    const double x = between(low.x, high.x), y = between(low.y, high.y);
    return {x, y, between(low.z, high.z)};
  }
  /// Evenly over the sphere, by rejection from the cube.
  Direction direction() {
    for (;;) {
      const Vec3 v = in_box(Vec3(-1.0), Vec3(1.0));
      const double length2 = glm::dot(v, v);
      if (length2 > 0.01 && length2 < 1.0)
        return v / std::sqrt(length2);
    }
  }

private:
  std::mt19937 engine_;
};

} // namespace meninas::test
