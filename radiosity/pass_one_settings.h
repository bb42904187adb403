// The settings of pass one: those of each of its stages in one place, the numbers that a quality stands for,
// and the conversion of a user's choices to settings.
#pragma once

#include "radiosity/field/interpolation_settings.h"
#include "radiosity/hierarchical/link_figures.h"
#include "radiosity/light/direct_samples.h"
#include "radiosity/scene/plan.h"
#include "radiosity/solvers/solver_settings.h"
#include "radiosity/transport/form_factors.h"
#include "scenes/lamps.h"

#include <array>
#include <optional>

namespace meninas {

/// The cut through the hierarchy of elements that has the unknowns of Eq. 1: its leaves, or nodes as large
/// as the light allows (hierarchical/node_solution.h).
enum class MeshCut { uniform, hierarchical };
inline constexpr std::array mesh_cuts{MeshCut::uniform, MeshCut::hierarchical};
/// As users call it.
const char* name_of(MeshCut cut);

struct PassOneSettings {
  PlanSettings plan;
  MeshSettings mesh;
  MeshCut cut = MeshCut::uniform;
  FormFactorSettings form_factors;
  DirectSettings direct;
  SolverSettings solver;
  HierarchicalSettings hierarchical;
  InterpolationSettings interpolation;
  std::optional<LampGrouping> lamps = {}; ///< light is told apart by lamps, so grouped
};

/// Whether these settings shoot rays instead of assembling a transport.
bool shoots_rays(const PassOneSettings& settings, std::size_t elements);

/// Whether light is received by nodes,
/// and vertices gather as far as these ask for it (hierarchical/node_field.h).
bool gathers_by_nodes(const PassOneSettings& settings);

enum class Quality { draft, normal, fine };

/// The numbers of pass one that a quality stands for.
struct PassOneQuality {
  double target_elements = 0.0; ///< about how many elements share the meshed area
  int rays = 0; ///< form-factor rays per element, and per vertex where irradiance is gathered there
  int hemicube_resolution = 0; ///< cells along an edge of the top, where hemicubes are used instead
  double link_error =
      0.0; ///< of a hierarchical mesh: how much light may bend where it is interpolated
  int penumbra_rays = 0; ///< shadow rays from a vertex to an emitter that it sees in part
  int images = 0;        ///< of emitters, computed at a vertex; of more, a choice (mirror/light_choice.h)
  int images_in_element = 0; ///< likewise, at each of an element's points
  double faintest_world = 0.0; ///< least throughput of a mirror world (mirror/worlds.h)
};
PassOneQuality pass_one_quality(Quality quality);

/// The presets' link errors, between them and beyond: X = X_normal sqrt(n_normal / n) of n rays an element, relative.
double link_error_for(double rays);

/// A user's choices for pass one; values that are not set follow from the quality.
struct PassOneChoice {
  Quality quality = Quality::normal;
  std::optional<double> element_size; ///< metres, of all surfaces
  std::optional<int> elements;        ///< or about so many, shared over them (element_sizes.h)
  std::optional<MeshCut> mesh;        ///< else as mesh_cut() says
  std::optional<double> bends; ///< of the mean: elements in which light bends by more are divided
  FormFactorMethod form_factors = FormFactorMethod::rays;
  std::optional<int> rays;                ///< rounded up to a power of two
  std::optional<int> hemicube_resolution; ///< even
  SolverMethod solver = SolverSettings{}.method;
  std::optional<double> tolerance;
  std::optional<int> steps;         ///< of the progressive solver: shots
  std::optional<double> link_error; ///< of a hierarchical mesh
  std::optional<int> mirror_depth;  ///< no path meets more mirrors
  std::optional<Interpolation> interpolation;
  std::optional<LampGrouping> lamps; ///< light is found by lamp
  std::uint32_t seed = 0;
};

/// The cut that is chosen: hierarchical, but where form factors are not by rays, or where the solver
/// `progressive` or the interpolation `average` want a row for every element.
MeshCut mesh_cut(const PassOneChoice& choice);

PassOneSettings pass_one_settings(const PassOneChoice& choice);

/// The samples of low-discrepancy sequences are evenly spread where their number is a power of two.
int power_of_two(int at_least);

} // namespace meninas
