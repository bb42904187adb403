// Hierarchical radiosity (`--mesh hierarchical`):
// nodes as large as the error allows receive light, and the elements below them send it on.
//
// The first reflection, S = rho (D + G), has the sharp edges. It is found as for every solver (first_light.h),
// element by element (or as below, where vertices have the edges).
// The light that elements send one another is smooth. So with c the receiver of element j (node_cut.h),
//
//   B_j = S_j + rho_j H_c,   H_c = sum_j F_cj B_j = s_c + sum_d F_cd rho_d H_d,   s_c = sum_j F_cj S_j,
//
// d over the receivers, F_cd the sum of F_cj over the elements j below d, rho_d their mean:
// (translucent surfaces add tau times the irradiance of their other side to B_j: transport/translucency.h),
// first light is gathered from the elements themselves, and later bounces from receivers,
// over links between nodes (F_cd, c, d). The system of receivers is solved by any solver (solve.h).
// Receivers are then divided where
//
//   rho max_d |H_d - H_parent| > X (min(B, Phi / 256 A_c) + B_mean),
//
// d over the parts of the receiver's parent, H with G and the light of the sky, A_c the receiver's area and
// Phi = sum A B: in a bright nook it is not the light of a receiver that counts, but its part of all light.
// The larger system is solved, until
// no receiver is divided. The difference between children and parent halves per level, hence the factor 2 in the
// bound: links are refined by the power they carry (Hanrahan, Salzman, Aupperle 1991).
// The factors of links come from the rays of the receivers' rows and not from pairs of nodes:
// rays follow every mirror to any depth and find occluders, there is no quadratic first step, and rows close.
// Pairs with a closed form and shadow rays, as in the paper, were slower and less accurate
// (docs/notes/hierarchical.md).
//
//   X = link_error min(1, 4 P_1 / P),   P_1 the power of the first reflection, P that of all reflected light.
//
// A receiver's error is reflected about P / P_1 times, so bright closed rooms need a smaller X.
// If vertices gather the visible light (node_field.h), elements only light others and may be coarser:
// twenty link errors take the place of one, and D is the mean of the corners (node_light.h).
// More than 512 rows share the rays of 512 full rows, or of up to 4,096 where first light is uneven;
// above an unevenness of 8 the rows are traced again with more rays, and once more when no receiver
// is divided any longer: rays that chose which are divided are not right in the mean (node_cut.h).
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

/// The settings for each row of so many that only light others: of more than 512 they share
/// the rays of so many, or of more, up to 4,096, where light is so uneven that few rays find it.
/// `unevenness` is the mean of the squares of first light over the square of its mean.
/// Fewer rows than that have up to `times` as many rays each.
FormFactorSettings rays_per_row(FormFactorSettings settings, std::size_t rows,
                                   double unevenness = 1.0, int times = 1);

/// With vertices, which then gather what is seen, elements only light others;
/// without, what they receive is what is seen of them.
NodeSolution solve_by_nodes(const LightScene& light, const NodeSolverSettings& settings,
                            std::optional<LitVertices> vertices, const Progress& progress = {});

} // namespace meninas
