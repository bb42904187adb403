// The page: the room, its mirrors and cameras as JSON with packed tables (packed_numbers.h), joined
// with the scripts of page/ into one HTML file that needs nothing else.
#pragma once

#include "image/view_transform.h"
#include "runs/walk/walk_lamps.h"
#include "runs/walk/walk_room.h"
#include "runs/walk/walk_vertices.h"

#include <span>
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
  PackedSize packed = PackedSize::smallest;
  VertexNumbering numbering = VertexNumbering::joined;
  std::vector<WalkLamp> lamps = {}; ///< those whose light the room knows, by their number
};

/// Pages with more triangles are refused: a browser would not draw them.
inline constexpr std::size_t max_walk_triangles = 3'000'000;

/// Its JSON. `warnings` gets what had to be left out, a sentence each. Throws InputError where a browser would
/// not draw it, naming the scene's file.
std::string walk_page_data(const WalkPage& page, std::vector<std::string>& warnings);

/// Irradiance that all but two in a hundred vertices stay below, luminance, W/m^2: the top of the false colours.
double top_irradiance(std::span<const glm::vec3> irradiance);

/// The whole file, with the same data. `warnings` gets what had to be left out, a sentence each.
std::string walk_page_html(const WalkPage& page, std::vector<std::string>& warnings);

} // namespace meninas
