// Where the points of a patch lie on the triangles of the scene, and what the file says of them there.
#pragma once

#include "scenes/surfaces/surfaces.h"

#include <optional>

namespace meninas {

/// A point of a triangle by the weights of its second and third corner.
struct ScenePlace {
  TriangleId triangle = none<TriangleId>;
  Vec2 barycentric{0.0};
};

/// The place on the triangle of a patch that holds the point, or comes nearest to that.
ScenePlace place_on(const Scene& scene, const Patch& patch, const Point3& x);

/// Texture coordinates as the texture takes them, (0, 0) where there is none
/// (scenes/materials/texture_lookup.h).
glm::vec2 texture_place(const Scene& scene, const std::optional<TextureUse>& use,
                        const ScenePlace& at);

/// COLOR_0 of the file, linear between its vertices, dimensionless.
glm::vec4 vertex_colour(const Scene& scene, const ScenePlace& at);

} // namespace meninas
