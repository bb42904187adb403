#include "radiosity/landing.h"

namespace meninas {

static FaceRecord make_face(const Scene& scene, const SurfaceModel& model, const MirrorSet& mirrors,
                            const ElementMesh& mesh, std::uint32_t triangle, int facing) {
  const PatchId patch_id = model.patch_of_triangle[triangle];
  const Patch& patch = model.patches[index(patch_id)];
  const Surface& surface = model.surfaces[index(patch.surface)];
  const Material& material = scene.materials[index(patch.material)];
  FaceRecord face;
  face.plane_class = index(surface.plane_class);
  face.affine = patch.affine;
  face.normal = facing == 0 ? surface.plane.normal : -surface.plane.normal;
  if (facing == 1 && !material.double_sided)
    return face;

  face.side = index(mesh.sides_of_patch[index(patch_id)][static_cast<std::size_t>(facing)]);
  face.mirrors = is_mirror(material);
  face.mirror = mirrors.mirror_of_surface[index(patch.surface)][static_cast<std::size_t>(facing)];
  face.reflectance = mirror_reflectance(material);
  const auto& uv = model.corner_uv[triangle];
  face.uv0 = uv[0];
  face.uv1 = uv[1] - uv[0];
  face.uv2 = uv[2] - uv[0];
  return face;
}

LandingTable make_landing_table(const Scene& scene, const SurfaceModel& surfaces,
                                const MirrorSet& mirrors, const ElementMesh& mesh,
                                Point3 frame_centre, double frame_scale) {
  LandingTable table;
  table.faces.reserve(2 * scene.triangles.size());
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    for (int facing = 0; facing < 2; ++facing) {
      FaceRecord face = make_face(scene, surfaces, mirrors, mesh, t, facing);
      // The plane through one of its own vertices, in the frame: n . (p - centre) scale.
      const Point3 p = position(scene, scene.triangles[t].vertices[0]);
      face.frame_offset = glm::dot(face.normal, (p - frame_centre) * frame_scale);
      table.faces.push_back(face);
    }
  }
  for (const auto& side : mesh.sides)
    table.sides.push_back({side.first_element, side.nu, side.nv, side.triangle});
  return table;
}

glm::vec2 landing_uv(const FaceRecord& face, const SurfaceModel& surfaces, std::uint32_t triangle,
                     float b1, float b2) {
  if (face.affine)
    return face.uv0 + b1 * face.uv1 + b2 * face.uv2;
  return patch_uv(surfaces, static_cast<TriangleId>(triangle), Vec2(b1, b2));
}

} // namespace meninas
