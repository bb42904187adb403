#include "runs/bake/chart_packing.h"

#include "scenes/types.h"

#define STBRP_STATIC
#define STB_RECT_PACK_IMPLEMENTATION
#include <stb/stb_rect_pack.h>

namespace meninas {

std::optional<std::vector<glm::ivec2>> pack_rectangles(const std::vector<glm::ivec2>& sizes,
                                                       glm::ivec2 picture) {
  std::vector<stbrp_rect> rectangles(sizes.size());
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    rectangles[k].id = static_cast<int>(k);
    rectangles[k].w = sizes[k].x;
    rectangles[k].h = sizes[k].y;
  }
  // As many nodes as columns: then nothing is left out for want of them.
  std::vector<stbrp_node> nodes(static_cast<std::size_t>(picture.x));
  stbrp_context context;
  stbrp_init_target(&context, picture.x, picture.y, nodes.data(), picture.x);
  if (stbrp_pack_rects(&context, rectangles.data(), static_cast<int>(rectangles.size())) == 0)
    return std::nullopt;
  std::vector<glm::ivec2> places(sizes.size());
  for (std::size_t k = 0; k < sizes.size(); ++k)
    places[k] = {rectangles[k].x, rectangles[k].y};
  return places;
}

} // namespace meninas
