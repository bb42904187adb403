// Values between key frames: glTF 2.0, Appendix C.
//
// With u = (t - t_k) / (t_k+1 - t_k) between keys k and k+1, d = t_k+1 - t_k:
//
//   step           v_k
//   linear         (1 - u) v_k + u v_k+1
//   of rotations   sin((1 - u) a) / sin(a) q_k + s sin(u a) / sin(a) q_k+1,
//                  cos a = |q_k . q_k+1|, s its sign: the shorter way (Shoemake 1985)
//   cubic spline   (2u^3 - 3u^2 + 1) v_k + d (u^3 - 2u^2 + u) b_k
//                  + (3u^2 - 2u^3) v_k+1 + d (u^3 - u^2) a_k+1
//
// a and b are the tangents into and out of a key. Before the first key, at the last and after it
// the value is theirs. Rotations are (x, y, z, w), made unit quaternions.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace meninas::gltf {

enum class KeyInterpolation { step, linear, cubic_spline };

/// The number of elements of values per key: a spline has a, v and b, in this order.
std::size_t elements_per_key(KeyInterpolation interpolation);

struct KeyFrames {
  KeyInterpolation interpolation = KeyInterpolation::linear;
  std::size_t width = 1;          ///< numbers of an element
  std::span<const double> times;  ///< seconds, ascending, at least one
  std::span<const double> values; ///< width elements_per_key times.size() of them
};

std::vector<double> value_at(const KeyFrames& keys, double seconds);

/// Zero where all numbers of a key are: no rotation.
std::array<double, 4> rotation_at(const KeyFrames& keys, double seconds);

} // namespace meninas::gltf
