#include "radiosity/transport/factor_key.h"

#include "scenes/content_hash.h"
#include "scenes/materials/lobes.h"

#include <span>

namespace meninas {
namespace {

std::uint64_t hash_of_geometry(const Scene& scene) {
  ContentHash hash;
  for (const Vertex& vertex : scene.vertices) {
    hash.add(vertex.position);
  }
  for (const Triangle& triangle : scene.triangles) {
    for (const VertexId vertex : triangle.vertices) {
      hash.add(std::uint64_t{index(vertex)});
    }
    hash.add(std::uint64_t{scene.materials[index(triangle.material)].double_sided});
    if (triangle.curved)
      for (const VertexId vertex : triangle.vertices)
        hash.add(Vec3(scene.vertices[index(vertex)].normal));
  }
  return hash.value();
}

/// Films of glass and coats are part of the transport.
void add_film(ContentHash& hash, const ThinFilm& film) {
  if (film.share > 0.0)
    hash.add(Rgb(film.share, film.ior, film.thickness));
}
void add_coat(ContentHash& hash, const Bsdf& coat) {
  add_film(hash, coat.film);
  hash.add(coat.coat_f0);
  hash.add(Rgb(coat.coat, coat.coat_f90, 0.0));
}
void add_glass(ContentHash& hash, const Bsdf& glass) {
  add_film(hash, glass.pane.film);
  hash.add(glass.metal);
  hash.add(Rgb(glass.glass, glass.pane.ior, glass.pane.f90));
  hash.add(glass.pane.f0);
  hash.add(glass.pane.tint);
  hash.add(static_cast<std::uint64_t>(glass.pane.faces));
}

/// The texture of glass: its image, and its place on the surface.
void add_texture(ContentHash& hash, const Scene& scene, const std::optional<TextureUse>& use) {
  if (!use)
    return;
  const Texture& texture = scene.textures[index(use->texture)];
  hash.add(std::as_bytes(std::span(texture.encoded)));
  hash.add(static_cast<std::uint64_t>(texture.wrap_u));
  hash.add(static_cast<std::uint64_t>(texture.wrap_v));
  hash.add(static_cast<std::uint64_t>(texture.magnified));
  hash.add(static_cast<std::uint64_t>(use->texcoord_set));
  hash.add(Rgb(use->offset, use->rotation));
  hash.add(Rgb(use->scale, 0.0));
}

std::uint64_t hash_of_mirrors(const Scene& scene, const WorldTree& worlds) {
  ContentHash hash;
  for (const Triangle& triangle : scene.triangles) {
    const Material& material = scene.materials[index(triangle.material)];
    hash.add(mirror_reflectance(material));
    if (is_glass(material))
      add_glass(hash, clear_glass(material, untextured(material)));
    if (has_mirror_coat(material))
      add_coat(hash, mirror_coat(material));
    if (is_blended(material))
      for (const VertexId vertex : triangle.vertices)
        hash.add(Rgb(double{attributes_of(scene, vertex).color.a}));
    if (is_glass(material) && is_textured(material))
      for (const VertexId vertex : triangle.vertices)
        for (const glm::vec2& texcoord : attributes_of(scene, vertex).texcoord)
          hash.add(Vec3(texcoord, 0.0));
  }
  for (const Material& material : scene.materials)
    if (is_glass(material))
      for (const auto* use : {&material.base_color_texture, &material.metallic_roughness_texture,
                              &material.transmission_texture, &material.thickness_texture,
                              &material.iridescence_texture, &material.film_thickness_texture}) {
        if (use == &material.film_thickness_texture && *use)
          hash.add(Rgb(material.film_min_thickness, material.film_thickness, 0.0));
        add_texture(hash, scene, *use);
      }
  for (const MirrorWorld& world : worlds.worlds) {
    hash.add(std::uint64_t{index(world.parent)});
    hash.add(std::uint64_t{index(world.mirror)});
  }
  return hash.value();
}

std::uint64_t hash_of_mesh(const ElementMesh& mesh) {
  ContentHash hash;
  for (const MeshSide& side : mesh.sides) {
    hash.add(std::uint64_t{index(side.patch)});
    hash.add(std::uint64_t{static_cast<std::uint8_t>(side.facing)});
    hash.add(static_cast<std::uint64_t>(side.nu));
    hash.add(static_cast<std::uint64_t>(side.nv));
  }
  for (const MeshCell& cell : mesh.cells) {
    hash.add(std::uint64_t{cell.level});
  }
  for (const Point3& vertex : mesh.vertices) {
    hash.add(vertex);
  }
  return hash.value();
}

std::uint64_t hash_of_sampling(const FormFactorSettings& settings) {
  // All of them, by name: a new setting does not compile before it has a place here.
  const auto& [method, rays, hemicube_resolution, min_throughput, max_bounces, accuracy, seed,
               relightable] = settings;
  ContentHash hash;
  hash.add(static_cast<std::uint64_t>(method));
  hash.add(static_cast<std::uint64_t>(rays));
  hash.add(static_cast<std::uint64_t>(hemicube_resolution));
  hash.add(accuracy);
  hash.add(min_throughput);
  hash.add(static_cast<std::uint64_t>(max_bounces));
  hash.add(std::uint64_t{seed});
  hash.add(std::uint64_t{relightable});
  return hash.value();
}

} // namespace

FactorKey factor_key(const LightScene& light, const FormFactorSettings& settings) {
  return {hash_of_geometry(light.scene), hash_of_mirrors(light.scene, light.worlds),
          hash_of_mesh(light.mesh),
          light.scene.background.map ? content_hash(light.scene.background) : 0,
          hash_of_sampling(settings)};
}

} // namespace meninas
