#include "scenes/scene.h"

#include "scenes/content_hash.h"
#include "scenes/errors.h"
#include "scenes/ies/intensity_distribution.h"
#include "scenes/names.h"

#include <algorithm>

namespace meninas {
namespace {

std::uint64_t word(bool x) { return x ? 1 : 0; }

void add_texture_use(ContentHash& hash, const std::optional<TextureUse>& use) {
  hash.add(word(use.has_value()));
  if (!use) {
    return;
  }
  hash.add(std::uint64_t{index(use->texture)});
  hash.add(static_cast<std::uint64_t>(use->texcoord_set));
  hash.add(use->offset);
  hash.add(use->rotation);
  hash.add(use->scale);
}

void add_anisotropy(ContentHash& hash, const Material& material) {
  if (material.anisotropy == 0.0)
    return;
  hash.add(std::uint64_t{5}); // no other flag of what is left out where there is none
  hash.add(material.anisotropy);
  hash.add(Vec3(material.anisotropy_direction, 0.0));
  add_texture_use(hash, material.anisotropy_texture);
}

void add_film(ContentHash& hash, const Material& material) {
  if (material.iridescence == 0.0)
    return;
  hash.add(std::uint64_t{6}); // no other's
  hash.add(material.iridescence);
  hash.add(material.film_ior);
  hash.add(material.film_min_thickness);
  hash.add(material.film_thickness);
  add_texture_use(hash, material.iridescence_texture);
  add_texture_use(hash, material.film_thickness_texture);
}

void add_sheen(ContentHash& hash, const Material& material) {
  if (material.sheen_color == Rgb(0.0))
    return;
  hash.add(material.sheen_color);
  hash.add(material.sheen_roughness);
  add_texture_use(hash, material.sheen_color_texture);
  add_texture_use(hash, material.sheen_roughness_texture);
}

void add_material(ContentHash& hash, const Material& material) {
  hash.add(material.base_color);
  hash.add(material.alpha);
  hash.add(material.metallic);
  hash.add(material.roughness);
  if (material.specular_in_pass_one)
    hash.add(std::uint64_t{1});
  hash.add(material.emission);
  hash.add(word(material.double_sided));
  hash.add(material.ior);
  hash.add(material.specular);
  hash.add(material.specular_color);
  hash.add(material.transmission);
  if (material.thickness > 0.0) {
    hash.add(material.thickness);
    hash.add(material.attenuation_color);
    hash.add(material.attenuation_distance);
  }
  hash.add(static_cast<std::uint64_t>(material.alpha_mode));
  hash.add(material.alpha_cutoff);
  add_texture_use(hash, material.base_color_texture);
  add_texture_use(hash, material.metallic_roughness_texture);
  add_texture_use(hash, material.emissive_texture);
  // Scenes without them keep the hashes that they have had.
  if (material.transmission_texture || material.thickness_texture) {
    add_texture_use(hash, material.transmission_texture);
    add_texture_use(hash, material.thickness_texture);
  }
  if (material.unlit)
    hash.add(std::uint64_t{3}); // no other flag of those that are left out where they are not set
  if (material.normal_texture) {
    hash.add(material.normal_scale);
    add_texture_use(hash, material.normal_texture);
  }
  add_sheen(hash, material);
  if (material.diffuse_transmission > 0.0) {
    hash.add(std::uint64_t{4}); // no other's
    hash.add(material.diffuse_transmission);
    hash.add(material.diffuse_transmission_color);
    add_texture_use(hash, material.diffuse_transmission_texture);
    add_texture_use(hash, material.diffuse_transmission_color_texture);
  }
  add_anisotropy(hash, material);
  add_film(hash, material);
  if (material.clear_coat > 0.0) {
    hash.add(material.clear_coat);
    hash.add(material.clear_coat_roughness);
    add_texture_use(hash, material.clear_coat_texture);
    add_texture_use(hash, material.clear_coat_roughness_texture);
  }
  if (material.specular_texture || material.specular_color_texture) {
    hash.add(std::uint64_t{2}); // not those of glass
    add_texture_use(hash, material.specular_texture);
    add_texture_use(hash, material.specular_color_texture);
  }
}

void add_light(ContentHash& hash, const PunctualLight& light) {
  hash.add(static_cast<std::uint64_t>(light.kind));
  hash.add(light.intensity);
  hash.add(light.position);
  hash.add(light.direction);
  hash.add(light.inner_cone);
  hash.add(light.outer_cone);
  hash.add(light.foot_reflectance);
  if (!light.distribution)
    return;
  for (int axis = 0; axis < 3; ++axis)
    hash.add(light.frame[axis]);
  hash.add(static_cast<std::uint64_t>(light.distribution->photometry));
  for (const auto* values :
       {&light.distribution->vertical, &light.distribution->horizontal, &light.distribution->candela})
    for (const double value : *values)
      hash.add(value);
}

void add_texture(ContentHash& hash, const Texture& texture) {
  hash.add(static_cast<std::uint64_t>(texture.wrap_u));
  hash.add(static_cast<std::uint64_t>(texture.wrap_v));
  if (texture.magnified != TexelFilter::linear) {
    hash.add(static_cast<std::uint64_t>(texture.magnified));
  }
  hash.add(std::span(texture.encoded));
}

void add_geometry(ContentHash& hash, const Scene& scene) {
  hash.add(std::uint64_t{scene.vertices.size()});
  for (const Vertex& vertex : scene.vertices) {
    hash.add(vertex.position);
    const VertexAttributes& told = attributes_of(scene, vertex);
    for (const glm::vec2& texcoord : told.texcoord) {
      hash.add(Vec2(texcoord));
    }
    if (told.color != glm::vec4(1.0F)) {
      hash.add(Vec3(told.color));
      hash.add(double{told.color.a});
    }
    if (vertex.normal != glm::vec3(0.0F)) {
      hash.add(Vec3(vertex.normal));
    }
  }
  for (const glm::vec4& tangent : scene.tangents) {
    hash.add(Vec3(tangent));
    hash.add(double{tangent.w});
  }
  hash.add(std::uint64_t{scene.triangles.size()});
  for (const Triangle& triangle : scene.triangles) {
    for (const VertexId vertex : triangle.vertices) {
      hash.add(std::uint64_t{index(vertex)});
    }
    hash.add(std::uint64_t{index(triangle.material)});
  }
}

/// The place of `name` among the things of one kind, or the error that names the nearest.
template <typename Thing>
std::size_t find_named(const Scene& scene, const std::vector<Thing>& things, std::string_view kind,
                       const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (things[i].name == name) {
      return i;
    }
    names.push_back(things[i].name);
  }
  throw UsageError(scene.file, unknown_name(kind, name, names));
}

} // namespace

VertexAttributes& own_attributes(Scene& scene, Vertex& vertex) {
  const VertexAttributes told = attributes_of(scene, vertex);
  vertex.attributes = static_cast<AttributesId>(scene.attributes.size());
  return scene.attributes.emplace_back(told);
}

std::array<Point3, 3> corners(const Scene& scene, TriangleId triangle) {
  const auto& vertices = scene.triangles[index(triangle)].vertices;
  return {position(scene, vertices[0]), position(scene, vertices[1]), position(scene, vertices[2])};
}

Vec3 area_vector(const std::array<Point3, 3>& corners) {
  return 0.5 * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
}

Bounds bounds_of(const Scene& scene) {
  Bounds bounds;
  for (const Triangle& triangle : scene.triangles) {
    for (const VertexId vertex : triangle.vertices) {
      bounds.low = glm::min(bounds.low, position(scene, vertex));
      bounds.high = glm::max(bounds.high, position(scene, vertex));
    }
  }
  return bounds;
}

std::uint64_t content_hash(const Scene& scene) {
  ContentHash hash;
  add_geometry(hash, scene);
  hash.add(std::uint64_t{scene.materials.size()});
  for (const Material& material : scene.materials) {
    add_material(hash, material);
  }
  hash.add(std::uint64_t{scene.textures.size()});
  for (const Texture& texture : scene.textures) {
    add_texture(hash, texture);
  }
  hash.add(std::uint64_t{scene.lights.size()});
  for (const PunctualLight& light : scene.lights) {
    add_light(hash, light);
  }
  for (const AreaLight& light : scene.area_lights) {
    hash.add(std::uint64_t{7}); // no other flag where there is none
    hash.add(light.radiance);
    for (const Point3& corner : light.corners)
      hash.add(corner);
  }
  if (scene.background.map || scene.background.encoded)
    hash.add(content_hash(scene.background));
  else
    hash.add(scene.background.constant);
  return hash.value();
}

NodeId find_node(const Scene& scene, const std::string& name) {
  if (std::ranges::find(scene.nodes, name, &Node::name) == scene.nodes.end() &&
      std::ranges::find(scene.area_lights, name, &AreaLight::name) != scene.area_lights.end())
    throw UsageError(scene.file, "'" + name + "' is an area light, which has no surface");
  return static_cast<NodeId>(find_named(scene, scene.nodes, "node", name));
}

const Camera& find_camera(const Scene& scene, const std::string& name) {
  return scene.cameras[find_named(scene, scene.cameras, "camera", name)];
}

} // namespace meninas
