// The figures of a solution by which one sees whether light was lost: where the emitted power ends,
// how far the rows of form factors are from closing, and what each node sends and receives.
//
//   sum_i A_i E_i = absorbed by surfaces + escaped + absorbed by mirrors        W
//   closure of a row: landed + escaped + black + cut = 1
//
// The balance follows from energy conservation (Siegel and Howell 1992); it is met as far as
// sampled form factors are reciprocal, which `imbalance` measures.
#pragma once

#include "radiosity/scene/light_scene.h"
#include "radiosity/transport/form_factor_rows.h"

#include <string>
#include <vector>

namespace meninas {

/// The light of the elements as it was solved, by ElementId, W/m^2.
struct ElementSolution {
  std::vector<Rgb> radiosity;  ///< B, emission included: the mean over the exposed part
  std::vector<Rgb> irradiance; ///< H, likewise
  std::vector<float> exposed;  ///< the share of the area that is there and on which nothing stands
};

struct EnergyBalance {
  Rgb emitted{0.0}, absorbed{0.0}, escaped{0.0}, mirror_absorbed{0.0}; ///< W
  double imbalance =
      0.0; ///< (emitted - absorbed - escaped - mirror_absorbed) / emitted, worst channel by size
};

/// The light that leaves an element is divided by the fractions of its own rays;
/// the absorbed light follows from the irradiance of the elements.
/// Light that enters from outside the surfaces (of punctual lights, of the background: `entering`
/// by ElementId, or none) counts as emitted where it first arrives.
EnergyBalance energy_balance(const LightScene& light, const ElementSolution& solution,
                             const std::vector<RowClosure>& rows,
                             const std::vector<Rgb>& entering);

struct ClosureError {
  double mean_error = 0.0; ///< of |1 - (landed + escaped + black + cut)| over the rows
  double max_error = 0.0;
  double cut = 0.0; ///< mean fraction of a row's light cut at the last mirror bounce
};
ClosureError closure_error(const std::vector<RowClosure>& rows);

/// Area means of one node over all of its sides, W/m^2;
/// what is covered by things that stand on it receives nothing.
struct NodeLight {
  std::string name;
  double area = 0.0; ///< m^2
  Rgb emitted{0.0}, radiosity{0.0}, irradiance{0.0};
};
std::vector<NodeLight> light_by_node(const Scene& scene, const ElementMesh& mesh,
                                     const ElementSolution& solution);

} // namespace meninas
