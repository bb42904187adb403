// Places of a curve at which several facets have a vertex of the view's cells.
//
// A curve has one irradiance H(x) at a place x, by its normal n(x) (curves/curved_vertices.h):
// what the samples of two facets find apart there is noise. So the first vertex of a place is lit, and the others have its
// light. Facets whose normals differ by more than same_normal_degrees, or that lie below unlike coats, meet in a
// crease and share nothing. Nor do facets on which something stands.
#pragma once

#include "radiosity/field/view/lattice_cells.h"
#include "radiosity/light/direct_samples.h"
#include "radiosity/mesh/vertex_welder.h"
#include "radiosity/scene/light_scene.h"

#include <unordered_map>

namespace meninas {

class CurvePlaces {
public:
  CurvePlaces(const LightScene& light, const LatticeCells& cells);

  /// Takes up the vertices that the cells have had since the last time.
  void find_new();

  /// The vertex whose light that one has: itself, or an earlier one.
  std::uint32_t first_of(std::size_t vertex) const { return firsts_[vertex]; }

private:
  struct First {
    std::uint32_t vertex;
    Receiver receiver;
  };
  std::uint32_t first_at(std::uint32_t vertex);

  const LightScene& light_;
  const LatticeCells& cells_;
  VertexWelder welder_;
  std::vector<Point3> places_;
  std::unordered_multimap<std::uint32_t, First> at_place_;
  std::vector<std::uint32_t> firsts_; ///< by vertex
};

} // namespace meninas
