// Normal maps: a texture turns the normal within a frame that follows the texture coordinates.
// The axis of anisotropic facets is a direction of the same frame.
//
//   n' ~ t_x T(b) + t_y B(b) + t_z N(b),   (t_x, t_y, t_z) = (2 r - 1) s, (2 g - 1) s, 2 b - 1
//
// s is the scale of glTF's normalTexture. N_k are the corners' normals without the map
// (scenes/shading_normal.h), T_k the unit vectors across them along which u grows, and
// B_k = w_k N_k x T_k those up the image, against v; all three are linear between the corners, not
// of unit length (glTF 2.0, 3.7.2.1; Mikkelsen 2008, Simulation of Wrinkled Surfaces Revisited).
//
// T_k and w_k = +-1 are the scene's tangents. Where it has none, or one along N_k, the triangle's
// own stand for them:
//
//   T ~ sign (dv_2 e_1 - dv_1 e_2),   w = -sign,   sign = that of du_1 dv_2 - dv_1 du_2
//
// with e_k the edges of the triangle from its first corner and (du_k, dv_k) their changes of the
// texture coordinates.
//
// Where these do not change either, facets take T ~ y x N, which is level, or x where N is upright.
//
// The facets of d = (d_t, d_b) are widest along d_t T(b) + d_b B(b), laid flat on the surface
// (KHR_materials_anisotropy). The frame is that of the normal map, where there is one; else of the
// coordinates of the texture of d, or of TEXCOORD_0, as they are before KHR_texture_transform.
//
// A normal that would look behind the face is lifted to where it just does not.
#pragma once

#include "scenes/materials/texture_lookup.h"

namespace meninas {

/// Whether what the triangle reflects goes by a normal that turns: with its vertices or a map.
inline bool is_bent(const Scene& scene, TriangleId triangle) {
  return scene.triangles[index(triangle)].curved ||
         material_of(scene, triangle).normal_texture.has_value();
}

/// n(b) of a point (scenes/shading_normal.h), turned by the map where there is one; towards the
/// front. `barycentric` are the weights of the second and the third corner, as of `footprint`.
Direction mapped_normal(const Scene& scene, const DecodedTextures& textures, TriangleId triangle,
                        Vec2 barycentric, const Footprint& footprint = {});

/// A unit vector across N for where texture coordinates tell none.
Direction level_tangent(const Direction& normal);

/// The axis of facets that are widest along `direction` of T and B, in the local frame of `normal`
/// (lobes.h): of unit length.
Vec2 facet_axis(const Scene& scene, TriangleId triangle, Vec2 barycentric, Vec2 direction,
                const Direction& normal);

} // namespace meninas
