// FLIP: how different two displayed pictures look to someone who flips between them.
//
// P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. D.
// Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proc. ACM Comput.
// Graph. Interact. Tech. 3(2), 2020. Sections and symbols are the paper's.
#pragma once

#include "image/channel.h"
#include "image/image.h"

#include <numbers>

namespace meninas {

struct FlipSettings {
  /// The observer's:
  /// by default 0.7 m from a screen of 0.7 m and 3840 pixels (section 5 of the paper).
  double pixels_per_degree = 3840.0 * std::numbers::pi / 180.0;
};

/// 0 where both pictures look the same, at most 1.
/// Values are linear; clipped to [0, 1]. Symmetric in its pictures.
Channel flip_map(const Image& a, const Image& b, const FlipSettings& settings = {});

} // namespace meninas
