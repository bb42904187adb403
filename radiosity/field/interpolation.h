// From element values to a continuous field of irradiance over every patch side.
//
// `average`: a vertex takes the mean of the elements around it, in its own surface;
// on the boundary of a surface the mean is extrapolated from the elements behind, never below 0.
// `gather`: the irradiance is gathered at the vertex itself, direct light by closed form,
// the rest by rays over the element radiosities (the cells of a hemicube,
// where form factors are found so): the field is right at its vertices.
// Vertices of curved surfaces, whose facets are smaller than half an element,
// take the mean of the facets around instead (facets.h).
// Vertices that see nothing but the black insides of things that stand on
// them hold no value of their own (contact_vertices.h, vertex_fill.h).
// Between vertices the field is bilinear in quads, linear in triangles.
// It is irradiance, W/m^2: reflectance is applied at the hit.
#pragma once

#include "radiosity/light/direct_irradiance.h"
#include "radiosity/mesh/element_mesh.h"
#include "radiosity/solvers/solve.h"

#include <optional>

namespace meninas {

struct ReceiverNodes; // hierarchical/receiver_nodes.h

enum class Interpolation { average, gather };

struct AdaptiveSettings {
  double error =
      0.02; ///< wanted of the interpolated radiosity, relative, in the mean square (field_refinement.h)
  std::size_t max_elements = 1'000'000;
};

struct InterpolationSettings {
  Interpolation method = Interpolation::gather;
  int rays = 512; ///< per vertex, for `gather`
  int cluster_shadow_rays =
      8; ///< per bright cluster (bright_clusters.h) and vertex, where it matters most
  double bend =
      0.0; ///< X: elements in which indirect light bends by more are divided (gathered_field.h); 0: none
  double shadow_bend =
      0.0; ///< likewise of light from the source, by nodes (shadow_edges.h); 0: none
  std::optional<AdaptiveSettings> adaptive =
      {}; ///< `gather` on a mesh of its own (adaptive_field.h)
};

/// By ElementVertexId. The mesh it belongs to must outlive it.
struct DiffuseField {
  std::vector<glm::vec3> irradiance;
  std::vector<glm::vec3>
      mirrored; ///< the part of it whose last leg came by way of mirrors; empty from `average`

  /// The part without what is computed from the source (direct_irradiance.h), for those who compute
  /// that themselves; empty where that is not known: from `average` with form factors `analytic`.
  std::vector<glm::vec3> indirect;
  std::vector<glm::vec3> indirect_mirrored; ///< likewise of `mirrored`
};

struct InterpolatedField {
  DiffuseField field;
  std::optional<ElementMesh> mesh = {}; ///< where it is finer than that of the elements
  std::vector<Rgb> received = {}; ///< H by ElementId where elements receive what their corners do, by nodes; empty otherwise
  std::optional<double> error = {}; ///< of an adaptive field: estimated, of what its settings bound
  std::uint64_t form_factor_rays = 0;
  std::uint64_t shadow_rays = 0;
};

/// The light of the elements, by ElementId, W/m^2.
struct ElementLight {
  std::vector<Rgb> reflected;   ///< B without emission
  std::vector<Rgb> irradiance;  ///< H
  std::vector<Rgb> from_source; ///< the part of H found from the source; empty: not known
};

/// With `receivers`, vertices inside of nodes take their indirect light from
/// the corners (hierarchical/node_field.h), unless the mesh is adaptive: what `receivers` know
/// of vertices becomes the field.
InterpolatedField interpolate(const LightScene& light, const ElementLight& elements,
                              const FormFactorSettings& form_factors, const DirectSettings& direct,
                              const InterpolationSettings& settings,
                              ReceiverNodes* receivers = nullptr);

/// The field at a point of a side.
glm::vec3 irradiance_at(const ElementMesh& mesh, const DiffuseField& field, SideId side, Vec2 uv);

} // namespace meninas
