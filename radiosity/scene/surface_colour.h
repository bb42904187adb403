// The diffuse reflectance and emission of a textured surface, at a point and as means over the elements of
// pass one.
//
//   rho(x) = what its lobes reflect in the mean (diffuse_reflectance, scenes/materials/bsdf.h),   E(x) = pi L(x)
//
// with base colour, metalness, roughness,
// transmission and emitted radiance L the material's factors times its textures.
// Pass one knows the means over its elements, pass two looks up the point:
// the irradiance is interpolated between the elements, the colours are as sharp as their images.
#pragma once

#include "radiosity/mesh/element_mesh.h"
#include "scenes/materials/lobes.h"
#include "scenes/rays/ray_scene.h"
#include "scenes/materials/texture_lookup.h"

namespace meninas {

struct SurfaceColour {
  Rgb reflectance{0.0}; ///< rho
  Rgb emission{0.0};    ///< E, W/m^2
  Rgb transmittance{0.0}; ///< tau_d of a translucent surface
  bool hole = false;    ///< nothing is there
};

/// At the point of a triangle with weights b1, b2 of its second and third corner;
/// its footprint is counted in them as well.
SurfaceColour surface_colour(const Scene& scene, const DecodedTextures& textures,
                             TriangleId triangle, Vec2 barycentric,
                             const Footprint& footprint = {});

/// Clear glass there (scenes/materials/lobes.h), of a triangle whose material it is.
Bsdf glass_at(const Scene& scene, const DecodedTextures& textures, TriangleId triangle,
              Vec2 barycentric);

/// The share of light from everywhere that the elements of a side of glass reflect or transmit,
/// by their place among those of the side.
/// The mean of a glass of mean tint stands for the mean over its tints.
std::vector<Rgb> passed_on_by_glass(const Scene& scene, const SurfaceModel& surfaces,
                                    const DecodedTextures& textures, const ElementMesh& mesh,
                                    SideId side);

/// The holes of cut-out materials, for the rays of a scene that outlives them.
Holes holes_of(const Scene& scene, const DecodedTextures& textures);

/// Sets the means of the elements of textured sides, by 64 points per element.
void average_textures(const Scene& scene, const SurfaceModel& surfaces,
                      const DecodedTextures& textures, ElementMesh& mesh);

} // namespace meninas
