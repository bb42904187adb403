#include "radiosity/field/view/cell_lookup.h"

#include <utility>

namespace meninas {

FieldCells cell_lookup(const ElementMesh& mesh, const LatticeCells& all, std::size_t roots,
                       std::size_t first_vertex) {
  FieldCells result{make_element_table(mesh, true), mesh.corners};
  std::vector<std::uint32_t>& descent = result.lookup.descent;
  const std::vector<LatticeCell>& cells = all.cells();
  // Cells below the elements come after those of the mesh.
  const std::size_t before = descent.size();
  const auto entry_of = [&](const LatticeCell& cell) {
    if (cell.first_child != LatticeCell::leaf)
      return static_cast<std::uint32_t>(before + cell.first_child - roots);
    ElementCorners corners;
    for (std::size_t c = 0; c < 4; ++c)
      corners[c] = static_cast<ElementVertexId>(first_vertex + cell.corners[c]);
    result.corners.push_back(corners);
    return ElementTable::leaf | static_cast<std::uint32_t>(result.corners.size() - 1);
  };

  std::vector<std::uint32_t> of_element(element_count(mesh));
  for (std::uint32_t e = 0; e < of_element.size(); ++e)
    of_element[e] = ElementTable::leaf | e;
  for (std::size_t c = 0; c < roots; ++c)
    of_element[index(cells[c].element)] = entry_of(cells[c]);
  const auto replace = [&](std::uint32_t& entry) {
    if ((entry & ElementTable::leaf) != 0)
      entry = of_element[entry & ~ElementTable::leaf];
  };
  for (std::uint32_t& entry : descent)
    replace(entry);
  for (LandingLine& line : result.lookup.lines)
    for (std::uint32_t& entry : line.next)
      replace(entry);
  for (std::size_t c = roots; c < cells.size(); ++c)
    descent.push_back(entry_of(cells[c]));
  return result;
}

} // namespace meninas
