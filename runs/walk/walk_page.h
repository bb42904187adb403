// The page: the room, its mirrors and cameras as JSON with packed tables (packed_numbers.h), joined
// with the scripts of page/ into one HTML file that needs nothing else.
#pragma once

#include "image/view_transform.h"
#include "runs/walk/walk_lamps.h"
#include "runs/walk/walk_room.h"

#include <string>
#include <vector>

namespace meninas {

/// A place to look from, as the file has it.
struct WalkCamera {
  Camera camera;
  double exposure = 0.0; ///< stops, what a PNG from there would have
};

struct WalkPage {
  const IrradianceField& field;
  const WalkRoom& room;
  std::string title;
  std::vector<WalkCamera> cameras;
  ViewTransform transform = ViewTransform::neutral;
  double min_throughput = 1.0 / 1024.0;
  double luminous_efficacy = 683.0; ///< lm/W
  std::vector<WalkLamp> lamps = {}; ///< those whose light the room knows, by their number
};

/// Pages with more triangles are refused: a browser would not draw them.
inline constexpr std::size_t most_walk_triangles = 3'000'000;

/// The whole file. `warnings` gets what had to be left out, a sentence each.
std::string walk_page_html(const WalkPage& page, std::vector<std::string>& warnings);

} // namespace meninas
