#include "radiosity/field/vertex_fill.h"

namespace meninas {

void fill_vertices(const ElementMesh& mesh, std::vector<std::uint8_t> valid,
                   std::vector<glm::vec3>& values) {
  constexpr int rings = 2;
  for (std::size_t v = 0; v < values.size(); ++v)
    if (valid[v] == 0)
      values[v] = glm::vec3(0.0F);

  for (int ring = 0; ring < rings; ++ring) {
    std::vector<glm::vec3> sum(values.size(), glm::vec3(0.0F));
    std::vector<std::uint32_t> count(values.size(), 0);
    for (const auto& corners : mesh.corners)
      for (const auto to : corners) {
        if (valid[index(to)] != 0)
          continue;
        for (const auto from : corners) {
          if (valid[index(from)] == 0)
            continue;
          sum[index(to)] += values[index(from)];
          ++count[index(to)];
        }
      }
    for (std::size_t v = 0; v < values.size(); ++v) {
      if (count[v] == 0)
        continue;
      values[v] = sum[v] / static_cast<float>(count[v]);
      valid[v] = 1;
    }
  }
}

} // namespace meninas
