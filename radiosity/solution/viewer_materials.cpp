#include "radiosity/solution/viewer_materials.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace meninas {

using nlohmann::json;

namespace {

constexpr const char* unlit = "KHR_materials_unlit";

json array_of(const Vec3& x) { return json::array({x.x, x.y, x.z}); }

json factor(const Rgb& colour, double alpha) {
  return json::array({colour.r, colour.g, colour.b, alpha});
}

int wrap_of(Wrap wrap) {
  constexpr int clamp_to_edge = 33071, repeat = 10497, mirrored_repeat = 33648;
  return wrap == Wrap::clamp ? clamp_to_edge : wrap == Wrap::repeat ? repeat : mirrored_repeat;
}

void add_alpha(json& to, const Material& material) {
  if (material.alpha_mode == AlphaMode::blend)
    to["alphaMode"] = "BLEND";
  if (material.alpha_mode == AlphaMode::mask) {
    to["alphaMode"] = "MASK";
    to["alphaCutoff"] = material.alpha_cutoff;
  }
}

json glass_extensions(const Material& material) {
  json extensions{{"KHR_materials_transmission", {{"transmissionFactor", material.transmission}}},
                  {"KHR_materials_ior", {{"ior", material.ior}}}};
  if (material.thickness > 0.0) {
    json volume{{"thicknessFactor", material.thickness},
                {"attenuationColor", array_of(material.attenuation_color)}};
    if (std::isfinite(material.attenuation_distance))
      volume["attenuationDistance"] = material.attenuation_distance;
    extensions["KHR_materials_volume"] = std::move(volume);
  }
  if (material.specular != 1.0 || material.specular_color != Rgb(1.0))
    extensions["KHR_materials_specular"] = {
        {"specularFactor", material.specular},
        {"specularColorFactor", array_of(material.specular_color)}};
  return extensions;
}

/// A camera of a scene of this size about this centre.
json camera_json(const Camera& camera, const Point3& centre, double size) {
  constexpr double nearest = 1e-3; // of the scene: depth buffers ask for some distance
  const double znear = camera.znear > 0.0 ? camera.znear : nearest * size;
  json made{{"name", camera.name}};
  if (camera.projection == Projection::orthographic) {
    const double aspect = camera.aspect > 0.0 ? camera.aspect : 1.0;
    made["type"] = "orthographic";
    made["orthographic"] = {{"xmag", camera.half_height * aspect},
                            {"ymag", camera.half_height},
                            {"znear", camera.znear},
                            {"zfar", camera.znear + glm::distance(camera.position, centre) + size}};
  } else {
    const double ahead = 0.5 * std::numbers::pi;
    made["type"] = "perspective";
    made["perspective"] = {
        {"yfov", is_panorama(camera.projection) ? ahead : camera.vertical_fov}, {"znear", znear}};
    if (camera.aspect > 0.0 && !is_panorama(camera.projection))
      made["perspective"]["aspectRatio"] = camera.aspect;
  }
  if (camera.sensor_fit != SensorFit::vertical)
    made["extras"]["sensor_fit"] =
        camera.sensor_fit == SensorFit::horizontal ? "HORIZONTAL" : "AUTO";
  if (camera.lens_radius > 0.0) {
    constexpr double focal_length = 50.0; // millimetres; R = f / (2 fstop) alone is told
    made["extras"]["focal_length"] = focal_length;
    made["extras"]["fstop"] = 1e-3 * focal_length / (2.0 * camera.lens_radius);
    made["extras"]["focus_distance"] = camera.focus_distance;
  }
  return made;
}

/// Columns of the node's matrix: a camera looks along its -z.
json matrix_of(const Camera& camera) {
  json matrix = json::array();
  const Vec3 columns[] = {camera.right, camera.up, -camera.forward, camera.position};
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row)
      matrix.push_back(columns[column][row]);
    matrix.push_back(column == 3 ? 1.0 : 0.0);
  }
  return matrix;
}

} // namespace

json ViewerMaterials::texture_info(const TextureUse& use) {
  auto place = std::ranges::find(used_, use.texture);
  if (place == used_.end()) {
    textures_.push_back({{"source", used_.size()}, {"sampler", used_.size()}});
    used_.push_back(use.texture);
    place = std::prev(used_.end());
  }
  return {{"index", place - used_.begin()}};
}

json ViewerMaterials::lit(const Material& material) {
  json made{{"name", material.name}, {"extensions", {{unlit, json::object()}}}};
  json& colour = made["pbrMetallicRoughness"];
  const double alpha = material.alpha_mode == AlphaMode::opaque ? 1.0 : material.alpha;
  // Viewers without the extension then show a lit surface evenly, too.
  colour = {{"baseColorFactor", factor(Rgb(1.0), alpha)},
            {"metallicFactor", 0.0},
            {"roughnessFactor", 1.0}};
  if (const auto& use = shown_texture(scene_, material))
    colour["baseColorTexture"] = texture_info(*use);
  add_alpha(made, material);
  return made;
}

json ViewerMaterials::lobe(const Material& material) {
  json made{{"name", material.name}};
  const double roughness = material.roughness <= ideal_mirror_roughness ? 0.0 : material.roughness;
  made["pbrMetallicRoughness"] = {{"baseColorFactor", factor(material.base_color, material.alpha)},
                                  {"metallicFactor", material.metallic},
                                  {"roughnessFactor", roughness}};
  if (const auto& use = shown_texture(scene_, material))
    made["pbrMetallicRoughness"]["baseColorTexture"] = texture_info(*use);
  if (is_glass(material)) {
    made["extensions"] = glass_extensions(material);
    made["doubleSided"] = !is_solid_glass(material); // a solid has one outside
  }
  add_alpha(made, material);
  return made;
}

std::size_t ViewerMaterials::add(const ShownPiece& piece) {
  const auto [place, is_new] =
      known_.emplace(std::pair(piece.material, piece.shown_as), materials_.size());
  if (!is_new)
    return place->second;
  const Material& material = scene_.materials[index(piece.material)];
  json made = piece.shown_as == ShownAs::lobe ? lobe(material) : lit(material);
  if (piece.shown_as == ShownAs::dark) {
    made["name"] = material.name + " (dark)";
    json& alpha = made["pbrMetallicRoughness"]["baseColorFactor"];
    alpha = factor(Rgb(0.0), alpha.at(3));
  }
  materials_.push_back(std::move(made));
  return place->second;
}

void ViewerMaterials::write(json& root, GlbArrays& glb) const {
  root["materials"] = materials_;
  std::set<std::string> used;
  for (const json& material : materials_)
    if (material.contains("extensions"))
      for (const auto& extension : material.at("extensions").items())
        used.insert(extension.key());
  if (!used.empty())
    root["extensionsUsed"] = used;
  if (used_.empty())
    return;
  root["textures"] = textures_;
  for (const TextureId id : used_) {
    const Texture& texture = scene_.textures[index(id)];
    const bool png = texture.encoded.at(0) == std::byte{0x89};
    root["images"].push_back({{"name", texture.name},
                              {"mimeType", png ? "image/png" : "image/jpeg"},
                              {"bufferView", add_bytes(glb, texture.encoded)}});
    constexpr int nearest = 9728, linear = 9729, trilinear = 9987;
    root["samplers"].push_back(
        {{"wrapS", wrap_of(texture.wrap_u)},
         {"wrapT", wrap_of(texture.wrap_v)},
         {"minFilter", trilinear},
         {"magFilter", texture.magnified == TexelFilter::nearest ? nearest : linear}});
  }
}

ViewerCameras viewer_cameras(const Scene& scene) {
  ViewerCameras made;
  const Bounds bounds = bounds_of(scene);
  const Point3 centre = 0.5 * bounds.low + 0.5 * bounds.high;
  const double size = glm::length(bounds.high - bounds.low);
  for (const Camera& camera : scene.cameras) {
    made.nodes.push_back({{"name", camera.name},
                          {"camera", made.cameras.size()},
                          {"matrix", matrix_of(camera)}});
    made.cameras.push_back(camera_json(camera, centre, size));
  }
  return made;
}

} // namespace meninas
