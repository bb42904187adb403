// The parameters of the bidirectional functions of a point (bsdf.h).
#pragma once

#include "scenes/material.h"
#include "scenes/materials/glass.h"

namespace meninas {

/// A material at one point, after its textures.
struct MaterialPoint {
  Rgb base_color{0.8};
  double alpha = 1.0;
  double metallic = 0.0;
  double roughness = 1.0;
  Rgb emission{0.0}; ///< radiance
  double transmission = 0.0;
  double thickness = 0.0; ///< metres
  double diffuse_transmission = 0.0;
  Rgb diffuse_transmission_color{1.0};
  double anisotropy = 0.0;
  Vec2 anisotropy_direction{1.0, 0.0}; ///< unit, along the tangent and the bitangent
  ThinFilm film{};
  Rgb metal_covariance{0.0}; ///< mean of base colour times metalness, less the product of both means
};

/// The factors alone, as where there is no texture.
MaterialPoint untextured(const Material& material);

struct Bsdf {
  Rgb diffuse{0.0};  ///< rho_d
  Rgb passed{0.0};   ///< tau_d, of translucent surfaces: passed evenly
  Rgb metal{0.0};    ///< rho_s, below a film the mean of it
  double coat = 0.0; ///< share of the surface under the coat
  Rgb coat_f0{0.0};
  double coat_f90 = 0.0;
  ThinFilm film{};           ///< over metal and coat, by a share
  Rgb metal_below{0.0};    ///< the colour of metal below it
  Rgb metal_with_film{1.0}; ///< the mean of what that reflects with the film
  FilmMean film_on_coat{};   ///< of the film alone, over coat_f0, times coat_f90
  double roughness = 1.0; ///< of facets that are not round, (alpha_t alpha_b)^(1/4)
  double alpha = 1.0;     ///< alpha_b; 0 stands for ideal reflection and transmission
  double stretch = 1.0;   ///< alpha_t / alpha_b; 1: facets are round
  Vec2 axis{1.0, 0.0};    ///< of alpha_t: by tangent and bitangent, at a point in its local frame
  Rgb sheen{0.0};     ///< colour of the fibres above it all (sheen.h)
  double sheen_roughness = 0.0;
  double glass = 0.0; ///< share of the surface that is glass
  Glass pane;         ///< what it is there
};

Bsdf make_bsdf(const Material& material, const MaterialPoint& point);

/// rho_s of a facet that is met at this cosine: rho_s itself where there is no film.
Rgb metal_reflectance(const Bsdf& bsdf, double cosine);

/// The reflectance of a film over the coat there, alone.
Rgb film_over_coat(const Bsdf& bsdf, double cosine);

inline bool has_round_facets(const Bsdf& bsdf) { return bsdf.stretch == 1.0; }

/// Whether what it passes goes straight through openings, however rough the rest is.
inline bool is_open(const Bsdf& bsdf) {
  return bsdf.glass > 0.0 && bsdf.pane.faces == GlassFaces::none;
}

} // namespace meninas
