// How finely a view shows direct light D, W/m^2, and what is divided for it.
//
// A cell of p > 1 pixels is divided where the hierarchical surplus of D (view_field.h) exceeds `tolerance`. Within a
// pixel an edge counts by the share of the pixel that it crosses: there the bound is 2.5 tolerance / p, dimensionless.
//
// Elements of the mesh may be smaller than a pixel. Most show what their corners have. An edge passes through one whose
// corners differ, at the step of a shadow by four times the surplus in the middle:
//
//   max D - min D over the corners  >  4 bound(p) (H_max + H_dark)
//
// and such an element is divided as larger ones are: it would else blur the edge over its width.
// H_dark is a twentieth of the mean of all light: what is darker is not told apart.
#pragma once

#include "radiosity/field/irradiance_field.h"

namespace meninas {

struct ViewRefinement {
  double coarse = 8.0;     ///< pixels
  double finest = 0.1;     ///< pixels: no smaller cell is divided
  double tolerance = 0.02; ///< dimensionless
  int rays = 8;            ///< from a vertex to an image of an emitter, to begin with
  int penumbra_rays =
      128;              ///< where some arrive and some do not, from one that stands for many pixels
  int solid_rays = 256; ///< to a body of solid glass that fills the hemisphere
  int images = 256;     ///< of emitters; of more, a choice
  std::uint32_t seed = 0;
};

inline constexpr float dark_share = 0.05F;      ///< H_dark, of the mean of all light
inline constexpr float spread_to_surplus = 4.0F; ///< what corners differ by at an edge, over the surplus in the middle

/// The surplus beyond which a cell of so many pixels is divided, dimensionless.
double surplus_bound(const ViewRefinement& how, double pixels);

/// The mean irradiance at the vertices of a field, W/m^2, its brightest channel.
float mean_light(const IrradianceField& field);

/// Whether an edge of direct light passes through an element of so many pixels, by the field at its corners. `dark` is
/// H_dark, W/m^2. Precondition: the field knows its indirect part. Limit: an edge that leaves all corners alike is
/// not found.
bool has_edge_of_light(const IrradianceField& field, ElementId element, double pixels, float dark,
                       const ViewRefinement& how);

} // namespace meninas
