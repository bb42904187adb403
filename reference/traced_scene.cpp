#include "reference/traced_scene.h"

#include "scenes/materials/refraction.h"
#include "scenes/materials/normal_map.h"
#include "scenes/rays/curved_origin.h"
#include "scenes/shading_normal.h"

namespace meninas::reference {

SurfacePoint surface_point(const TracedScene& traced, TriangleId triangle, Vec2 barycentric,
                           bool front) {
  const Material& material = material_of(traced.scene, triangle);
  const auto [a, b, c] = corners(traced.scene, triangle);
  SurfacePoint at;
  at.triangle = triangle;
  at.front = front;
  at.position = a + barycentric.x * (b - a) + barycentric.y * (c - a);
  at.plane = traced.surfaces.plane_of_triangle[index(triangle)];
  at.face = front ? traced.normals[index(triangle)] : -traced.normals[index(triangle)];
  at.normal = at.face;
  at.origin = at.position;
  at.leaving = at.plane;
  if (is_textured(material) || has_vertex_colors(traced.scene, triangle)) {
    at.material = material_at(traced.scene, traced.textures, triangle, barycentric);
    at.bsdf = make_bsdf(material, at.material);
  } else {
    at.material = untextured(material);
    at.bsdf = traced.bsdfs[index(traced.scene.triangles[index(triangle)].material)];
  }
  if (!front)
    at.bsdf = from_behind(at.bsdf);
  at.hole = is_cut_out(material, at.material);
  if (!front && !material.double_sided) {
    at.material.emission = Rgb(0.0);
    // A pane is one from both sides.
    at.black = material.transmission == 0.0;
  }
  return at;
}

/// The normal of a curve, or of a map, and light's origin over it.
static void curve(const TracedScene& traced, Vec2 barycentric, const Direction& out,
                  SurfacePoint& at) {
  const Direction n = mapped_normal(traced.scene, traced.textures, at.triangle, barycentric);
  at.normal = visible_normal(at.front ? n : -n, at.face, out);
  // Light passes a pane or a translucent surface at itself.
  const Material& material = material_of(traced.scene, at.triangle);
  if ((is_glass(material) && !is_blended(material)) || is_translucent(material))
    return;
  at.origin = curved_origin(traced.scene, traced.surfaces, traced.rays, at.triangle, barycentric,
                            at.front);
  at.leaving = none<PlaneId>;
}

void bend(const TracedScene& traced, Vec2 barycentric, const Direction& out, SurfacePoint& at) {
  if (is_bent(traced.scene, at.triangle))
    curve(traced, barycentric, out, at);
  if (!has_round_facets(at.bsdf))
    at.bsdf.axis = facet_axis(traced.scene, at.triangle, barycentric, at.bsdf.axis, at.normal);
}

} // namespace meninas::reference
