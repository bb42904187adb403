// What the solution by nodes leaves to the field that is gathered from it.
#pragma once

#include "radiosity/transport/contact_mask.h"
#include "radiosity/field/vertex_gathering.h"
#include "radiosity/solvers/solver_settings.h"
#include "radiosity/transport/element_hierarchy.h"
#include "radiosity/transport/translucency.h"

namespace meninas {

/// What receivers were solved by (node_solution.h): H_c = s_c + sum_d F_cd rho_d H_d.
struct ReceiverSystem {
  Transport links; ///< F_cd, by receiver
  std::vector<Rgb> reflectance;
  TranslucentLinks translucent;
  std::vector<std::uint32_t> receiver_of_element; ///< by ElementId
  std::vector<double> areas;                      ///< likewise, exposed, m^2
  SolverSettings solver;
};

/// The cut at which light was received, and the vertices that lit its elements.
struct HierarchicalSolution {
  NodeTree tree;
  std::vector<TreeNodeId> receivers;
  double bend = 0.0;                 ///< X (node_bends.h)
  std::vector<ContactMask> covered; ///< by ElementId: on what something stands
  VertexSamples vertices; ///< with direct light alone (node_light.h)
  ReceiverSystem system;
};

} // namespace meninas
