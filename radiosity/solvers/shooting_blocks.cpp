#include "radiosity/solvers/shooting_blocks.h"

#include <algorithm>

namespace meninas {

static constexpr int block_edge = 8;
static constexpr std::size_t max_in_block = 64;

/// Sides of fewer elements than that share blocks:
/// meshes of many small patches have no more than some ten thousand shooters.
static std::size_t shared_elements(std::size_t elements) {
  return std::clamp<std::size_t>(elements / 16384, 1, max_in_block);
}

/// The block of a root cell; both are counted from the side's first.
static std::uint32_t block_of_root(const MeshSide& side, std::uint32_t root) {
  if (side.triangle)
    return root / static_cast<std::uint32_t>(max_in_block);
  const auto nu = static_cast<std::uint32_t>(side.nu);
  const std::uint32_t across = (nu + block_edge - 1) / block_edge;
  return root / nu / block_edge * across + root % nu / block_edge;
}

Shooters make_shooting_blocks(const ElementMesh& mesh, const std::vector<float>& exposed) {
  Shooters blocks;
  const std::size_t size = element_count(mesh);
  blocks.of_unknown.resize(size);
  blocks.measure.resize(size);
  const std::size_t shared = shared_elements(size);
  std::size_t in_last = max_in_block; // elements in the last block, if more may join
  std::uint32_t count = 0;
  for (const MeshSide& side : mesh.sides) {
    const std::size_t elements = side.element_count;
    if (elements == 0)
      continue;
    const bool joins = in_last + elements <= shared;
    count -= joins ? 1 : 0;
    in_last = elements < shared ? elements + (joins ? in_last : 0) : max_in_block;
    std::uint32_t in_side = 0;
    for (std::uint32_t root = 0; root < side.root_count; ++root) {
      const MeshCell& cell = mesh.cells[side.first_cell + root];
      const std::uint32_t block = block_of_root(side, root);
      in_side = std::max(in_side, block + 1);
      for (std::uint32_t k = 0; k < cell.element_count; ++k)
        blocks.of_unknown[cell.first_element + k] = count + block;
    }
    count += in_side;
  }
  for (std::size_t e = 0; e < size; ++e)
    blocks.measure[e] = mesh.area[e] * double{exposed[e]};

  blocks.begin.assign(count + 1, 0);
  for (const auto block : blocks.of_unknown)
    ++blocks.begin[block + 1];
  for (std::uint32_t block = 0; block < count; ++block)
    blocks.begin[block + 1] += blocks.begin[block];
  blocks.unknowns.resize(size);
  auto place = blocks.begin;
  for (std::uint32_t element = 0; element < size; ++element)
    blocks.unknowns[place[blocks.of_unknown[element]]++] = element;
  return blocks;
}

} // namespace meninas
