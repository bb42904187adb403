// Hierarchical radiosity (`--mesh hierarchical`):
// light is received by nodes as large as it allows, and sent on by the elements below them.
//
// What elements have not reflected yet, S = rho (D + G), is found as for every solver
// (first_light.h), element by element, as it has the edges (or as below, where vertices have them).
// What they send one another is smooth. So with c the receiver of element j (node_cut.h),
//
//   B_j = S_j + rho_j H_c,   H_c = sum_j F_cj B_j = s_c + sum_d F_cd rho_d H_d,   s_c = sum_j F_cj S_j,
//
// d over the receivers, F_cd the sum of F_cj over the elements j below d, rho_d their mean:
// (of translucent surfaces, tau times what their other side receives comes to B_j: transport/translucency.h),
// first light is gathered from the elements themselves, and what follows from receivers,
// over links between nodes (F_cd, c, d). The system of receivers is solved by any solver (solve.h).
// Receivers are then divided where
//
//   rho max_d |H_d - H_parent| > X (B + B_mean),   d over the parts of the receiver's parent, H with G and what comes from the sky,
//
// and the larger system is solved, until none is. The difference between children and parent halves
// per level, hence the factor 2 in the bound:
// links are refined by the power they carry (Hanrahan, Salzman, Aupperle 1991).
// The factors of links come from the rays of the receivers' rows and not from pairs of nodes:
// rays follow every mirror to any depth and know what stands between,
// there is no quadratic beginning, and rows close. Pairs with a closed form and shadow rays,
// as in the paper, were slower and less accurate (docs/notes/hierarchical.md).
//
// X is the link error where elements are seen as they receive,
// less where all light is more than four times what is reflected first: in proportion to that,
// as what receivers are off by is passed on so many times.
// Where vertices gather what is seen (node_field.h), elements only light others,
// on average over many, and what is seen of them is as vertices have it (node_field.h):
// X is twenty link errors, direct light is that of their corners (node_light.h),
// and of more than 128 receivers the rows share the rays of so many,
// or of up to 1,024 where light is uneven; where it is very uneven they are found twice.
//
// Cost: first light and pushes are linear in elements; rows as many as receivers, whose number
// depends on the light and on X, and on elements only while these are larger than X asks for.
#pragma once

#include "radiosity/light/first_light.h"
#include "radiosity/hierarchical/link_figures.h"
#include "radiosity/hierarchical/node_cut.h"
#include "radiosity/hierarchical/node_light.h"
#include "radiosity/hierarchical/receiver_nodes.h"
#include "radiosity/solvers/solve.h"

#include <optional>

namespace meninas {

struct NodeSolverSettings {
  const FormFactorSettings& form_factors;
  const DirectSettings& direct;
  const HierarchicalSettings& hierarchical;
  const SolverSettings& solver;
};

struct NodeSolution {
  SolverResult solver;      ///< its radiosity is the reflected part, by ElementId
  std::vector<Rgb> arrived; ///< H of its receiver by ElementId, W/m^2
  FirstLight first;
  LightByLamp reflected_by_lamp, irradiance_by_lamp; ///< of `solver` and H, by ElementId; empty where light is not told apart
  std::vector<RowClosure> closure; ///< by ElementId: its receiver's
  std::vector<float> exposed;      ///< by ElementId
  HierarchicalSolution receivers;         ///< with the bound for what vertices interpolate
  LinkFigures figures;
  std::uint64_t rays_traced = 0;
  double seconds_gathering = 0.0, seconds_solving = 0.0;
};

/// The settings for each row of so many that only light others: of more than 128 they share
/// the rays of so many, or of more, up to 1,024, where light is so uneven that few rays find it.
/// `unevenness` is the mean of the squares of first light over the square of its mean.
FormFactorSettings rays_per_row(FormFactorSettings settings, std::size_t rows,
                                   double unevenness = 1.0);

/// With vertices, which then gather what is seen, elements only light others;
/// without, what they receive is what is seen of them.
NodeSolution solve_by_nodes(const LightScene& light, const NodeSolverSettings& settings,
                            std::optional<LitVertices> vertices, const Progress& progress = {});

} // namespace meninas
