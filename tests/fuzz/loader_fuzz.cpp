// What libFuzzer throws at the loader: any bytes end as a scene whose numbers are finite
// and whose indices are in range, or with one UserError of one line. Its materials reflect
// what is a number from any angle, its luminaires shine so, its lamps can be dimmed. Then the scene's
// surfaces are found and reported on, as every command does. Anything else is a finding.
#include "scenes/errors.h"
#include "scenes/gltf/gltf.h"
#include "scenes/ies/intensity_distribution.h"
#include "scenes/lamps.h"
#include "scenes/materials/bsdf.h"
#include "scenes/rays/hidden_copies.h"
#include "scenes/report/mesh_oddities.h"
#include "scenes/report/overlaps.h"
#include "scenes/surfaces/shells.h"
#include "scenes/surfaces/surfaces.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

using namespace meninas;

constexpr std::size_t few = 300; // triangles; larger scenes are the loader's business here

void require(bool condition, const char* what) {
  if (!condition) {
    std::fprintf(stderr, "finding: %s\n", what);
    std::abort();
  }
}

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check(const Scene& scene) {
  require(!scene.triangles.empty(), "a scene without triangles");
  for (const Vertex& vertex : scene.vertices) {
    require(is_finite(vertex.position), "a position that is not finite");
  }
  for (const Triangle& triangle : scene.triangles) {
    require(index(triangle.material) < scene.materials.size(), "a material out of range");
    require(index(triangle.node) < scene.nodes.size(), "a node out of range");
    for (const VertexId vertex : triangle.vertices) {
      require(index(vertex) < scene.vertices.size(), "a vertex out of range");
    }
  }
  for (const Material& material : scene.materials) {
    const Rgb diffuse = diffuse_reflectance(material);
    require(is_finite(diffuse) && is_finite(material.emission), "a material that is not finite");
    require(glm::all(glm::greaterThanEqual(diffuse, Rgb(0.0))) &&
                glm::all(glm::lessThanEqual(diffuse, Rgb(1.0))),
            "a reflectance beyond 1");
  }
  for (const std::string& warning : scene.warnings) {
    require(warning.find('\n') == std::string::npos, "a warning of two lines");
  }
}

/// From straight on, from aside, and along the surface.
void check_light(const Scene& scene) {
  constexpr Direction views[] = {{0.0, 0.0, 1.0}, {0.6, 0.0, 0.8}, {0.0, 1.0, 1e-12}};
  for (const Material& material : scene.materials) {
    const Bsdf bsdf = make_bsdf(material, untextured(material));
    for (const Direction& view : views) {
      require(is_finite(evaluate(bsdf, view, views[1])), "a scattering that is not finite");
      require(is_finite(ideal_reflection(bsdf, view.z)) && is_finite(straight_transmission(bsdf, view.z)),
              "a reflection that is not finite");
    }
  }
  for (const PunctualLight& light : scene.lights)
    for (const Direction& view : views)
      require(is_finite(light.intensity) &&
                  (!light.distribution || std::isfinite(intensity_at(*light.distribution, view))),
              "a light that is not finite");
  for (const LampGrouping grouping : {LampGrouping::node, LampGrouping::material}) {
    const LampGroups lamps = find_lamps(scene, grouping);
    if (lamps.size() > 0 && lamps.size() < 16)
      relit(scene, lamps, std::vector<Rgb>(lamps.size(), Rgb(0.5)));
  }
}

void look_at(const Scene& scene) {
  if (scene.triangles.size() > few) {
    return;
  }
  const SurfaceModel surfaces = find_surfaces(scene);
  const Topology topology = find_topology(scene, 0.5 * surfaces.tolerance);
  duplicate_faces(scene, topology);
  hidden_copies(scene);
  overlapping_faces(scene, surfaces);
  divided_edges(scene, topology, surfaces.tolerance);
  find_shells(scene, topology);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  try {
    // A folder that is not there: names of files lead nowhere.
    const Scene scene = read_gltf({data, data + size}, "/nonexistent/fuzz/scene.gltf",
                                  {.memory_limit = std::uint64_t{1} << 24,
                                   .state = {.at = 0.5}});
    check(scene);
    if (scene.triangles.size() <= few)
      check_light(scene);
    look_at(scene);
  } catch (const UserError& error) {
    require(std::string_view(error.what()).find('\n') == std::string_view::npos,
            "an error of two lines");
  }
  return 0;
}
