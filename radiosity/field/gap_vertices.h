// Values for the ground of gaps: elements on all of whose corners something stands, but which are
// open in between, as the floor is between two boxes closer together than its elements are wide.
//
// A point is open if a ray along the normal reaches a lit surface. Sixteen points are tested, up to
// four gather, and the corners take the means of their elements:
//
//   H_e = 1/m sum_k H(x_k),  m <= 4,    H_v = 1/n sum over the n such elements e at v of H_e      W/m^2
//
// Runs after contact_vertices.h, which handles elements with at least one open corner.
#pragma once

#include "radiosity/field/irradiance_field.h"
#include "radiosity/field/vertex_light.h"

#include <optional>
#include <span>

namespace meninas {

/// The mean irradiance at the open ones of a few points of an element; none where all are covered.
struct GapLight {
  ArrivingLight irradiance, indirect;
};
std::optional<GapLight> light_in_gap(const PointGathering& gathering,
                                     const std::vector<Rgb>& irradiance, const ElementMesh& mesh,
                                     ElementId element, PointWorkspace& work);

/// The elements without a valid corner; `valid` by ElementVertexId.
std::vector<ElementId> covered_elements(const ElementMesh& mesh,
                                        std::span<const std::uint8_t> valid);

/// Their corners take the means of what is there, and are valid then.
/// `lights` by place in `elements`.
void take_from_gaps(const ElementMesh& mesh, std::span<const ElementId> elements,
                    std::span<const std::optional<GapLight>> lights,
                    std::vector<std::uint8_t>& valid, VertexIrradiance& field);

} // namespace meninas
