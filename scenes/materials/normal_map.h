// Normal maps: a texture turns the normal within a frame that follows the texture coordinates.
//
//   n' = t_x T - t_y B + t_z N,   (t_x, t_y, t_z) = (2 r - 1) s, (2 g - 1) s, 2 b - 1
//
// N is the normal without the map (scenes/shading_normal.h), s the scale of glTF's normalTexture.
// T is the direction across N in which u grows, B = +-N x T that in which v does (it runs down the
// image), both of unit length, as MikkTSpace has them:
//
//   T ~ sign (dv_2 e_1 - dv_1 e_2),   B = sign N x T,   sign = that of du_1 dv_2 - dv_1 du_2
//
// with e_k the edges of the triangle from its first corner and (du_k, dv_k) their changes of the
// texture coordinates. MikkTSpace takes means of T over the triangles around a vertex; here each
// has its own, which differs from that by less than neighbours do.
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

} // namespace meninas
