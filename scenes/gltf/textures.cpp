// Textures: the encoded bytes of their images, kept once per image and sampler.
#include "scenes/gltf/accessors.h"
#include "scenes/gltf/stages.h"
#include "scenes/materials/image_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace meninas::gltf {

static constexpr std::uint64_t clamp_to_edge = 33071;
static constexpr std::uint64_t mirrored_repeat = 33648;
static constexpr std::uint64_t repeat = 10497;
static constexpr std::uint64_t nearest = 9728;
static constexpr std::uint64_t linear = 9729;
static constexpr std::uint64_t last_set = 1; // of texture coordinates

/// A PNG or JPEG before a WebP: where a file has both, that is what the other is made from.
static std::optional<std::size_t> image_of(const Json& texture) {
  if (const auto image = index_at(texture, "source"))
    return image;
  const auto* webp = find(texture, {"extensions", "EXT_texture_webp"});
  return webp ? index_at(*webp, "source") : std::nullopt;
}

static std::uint64_t texcoord_set(const Json& use) {
  const auto set = size_or(use, "texCoord", 0);
  const auto* transform = find(use, {"extensions", "KHR_texture_transform"});
  return transform ? size_or(*transform, "texCoord", set) : set;
}

std::optional<TextureUse> read_texture_use(const Document& document, const Json& owner,
                                           std::string_view key, const std::string& material,
                                           Findings& findings) {
  const auto* json = find(owner, key);
  if (!json)
    return std::nullopt;
  TextureUse use;
  const auto index = *index_at(*json, "index");
  use.texture = static_cast<TextureId>(index);
  if (const auto* transform = find(*json, {"extensions", "KHR_texture_transform"})) {
    const auto offset = numbers_at(*transform, "offset");
    const auto scale = numbers_at(*transform, "scale");
    if (!offset.empty())
      use.offset = {offset[0], offset[1]};
    if (!scale.empty())
      use.scale = {scale[0], scale[1]};
    use.rotation = number_or(*transform, "rotation", 0.0);
  }
  const auto set = texcoord_set(*json);
  if (set > last_set) {
    findings.about("textures with texCoord above 1 are left out in materials", material);
    return std::nullopt;
  }
  use.texcoord_set = static_cast<int>(set);
  const auto& texture = element(document.root, "textures", index);
  if (!image_of(texture)) {
    const auto* formats = find(texture, "extensions");
    const auto only_in = formats && !formats->empty()
                             ? fmt::format(", there is only {},", one_line(formats->begin().key()))
                             : "";
    findings.about(
        fmt::format("textures without an image that can be read{} are left out in materials",
                    only_in),
        material);
    return std::nullopt;
  }
  return use;
}

std::set<std::uint64_t> texcoord_sets(const Json& material) {
  std::set<std::uint64_t> sets;
  const auto add = [&](std::initializer_list<std::string_view> path) {
    if (const auto* use = find(material, path))
      if (const auto set = texcoord_set(*use); set <= last_set)
        sets.insert(set);
  };
  add({"emissiveTexture"});
  add({"normalTexture"});
  add({"pbrMetallicRoughness", "baseColorTexture"});
  add({"pbrMetallicRoughness", "metallicRoughnessTexture"});
  add({"extensions", "KHR_materials_pbrSpecularGlossiness", "diffuseTexture"});
  add({"extensions", "KHR_materials_transmission", "transmissionTexture"});
  const auto* specular = find(material, {"extensions", "KHR_materials_specular"});
  if (specular && number_or(*specular, "specularFactor", 1.0) > 0.0) {
    add({"extensions", "KHR_materials_specular", "specularTexture"});
    add({"extensions", "KHR_materials_specular", "specularColorTexture"});
  }
  const auto* coat = find(material, {"extensions", "KHR_materials_clearcoat"});
  if (coat && number_or(*coat, "clearcoatFactor", 0.0) > 0.0) {
    add({"extensions", "KHR_materials_clearcoat", "clearcoatTexture"});
    add({"extensions", "KHR_materials_clearcoat", "clearcoatRoughnessTexture"});
  }
  const auto* sheen = find(material, {"extensions", "KHR_materials_sheen"});
  if (sheen && vec3_or(*sheen, "sheenColorFactor", Rgb(0.0)) != Rgb(0.0)) {
    add({"extensions", "KHR_materials_sheen", "sheenColorTexture"});
    add({"extensions", "KHR_materials_sheen", "sheenRoughnessTexture"});
  }
  const auto* brushed = find(material, {"extensions", "KHR_materials_anisotropy"});
  if (brushed && number_or(*brushed, "anisotropyStrength", 0.0) > 0.0)
    add({"extensions", "KHR_materials_anisotropy", "anisotropyTexture"});
  const auto* film = find(material, {"extensions", "KHR_materials_iridescence"});
  if (film && number_or(*film, "iridescenceFactor", 0.0) > 0.0) {
    add({"extensions", "KHR_materials_iridescence", "iridescenceTexture"});
    add({"extensions", "KHR_materials_iridescence", "iridescenceThicknessTexture"});
  }
  const auto* sheet = find(material, {"extensions", "KHR_materials_diffuse_transmission"});
  if (sheet && number_or(*sheet, "diffuseTransmissionFactor", 0.0) > 0.0) {
    add({"extensions", "KHR_materials_diffuse_transmission", "diffuseTransmissionTexture"});
    add({"extensions", "KHR_materials_diffuse_transmission", "diffuseTransmissionColorTexture"});
  }
  // Of a pane it is a texture of nothing, and without absorption it says nothing.
  const auto* volume = find(material, {"extensions", "KHR_materials_volume"});
  if (volume && number_or(*volume, "thicknessFactor", 0.0) > 0.0 &&
      volume->contains("attenuationDistance"))
    add({"extensions", "KHR_materials_volume", "thicknessTexture"});
  return sets;
}

namespace {

/// glTF 2.0, 5.26. `minFilter` tells a rasteriser how carefully to filter;
/// here the whole footprint of a sample is averaged anyway.
struct Sampler {
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  TexelFilter magnified = TexelFilter::linear;
  auto operator<=>(const Sampler&) const = default;
};

} // namespace

static Wrap wrap_of(std::uint64_t code, const std::string& texture, Findings& findings) {
  if (code == clamp_to_edge)
    return Wrap::clamp;
  if (code == mirrored_repeat)
    return Wrap::mirrored;
  if (code != repeat)
    findings.about("unknown wrapping is read as repeated in textures", texture);
  return Wrap::repeat;
}

static Sampler sampler_of(const Json& root, std::size_t texture, Findings& findings) {
  const auto index = index_at(element(root, "textures", texture), "sampler");
  if (!index)
    return {};
  const Json& json = element(root, "samplers", *index);
  const auto name = place(root, "textures", texture);
  const auto filter = size_or(json, "magFilter", linear);
  if (filter != linear && filter != nearest)
    findings.about("unknown filters are read as linear in textures", name);
  return {wrap_of(size_or(json, "wrapS", repeat), name, findings),
          wrap_of(size_or(json, "wrapT", repeat), name, findings),
          filter == nearest ? TexelFilter::nearest : TexelFilter::linear};
}

static std::string name_of_image(const Json& image, std::size_t index) {
  const auto name = name_of(image);
  if (!name.empty())
    return name;
  const auto uri = text_or(image, "uri", "data:");
  return uri.starts_with("data:") ? fmt::format("image{}", index) : one_line(uri);
}

Resource image_bytes(const Document& document, std::size_t index) {
  const auto& image = element(document.root, "images", index);
  if (const auto* uri = find(image, "uri"))
    return read_uri(uri->get<std::string>(), document.folder, document.settings);
  const auto view = index_at(image, "bufferView");
  if (!view)
    return {{}, "neither uri nor bufferView"};
  const auto bytes = view_bytes(document, *view);
  return {{bytes.begin(), bytes.end()}, ""};
}

namespace {

/// Textures of the scene by image and sampler; a missing image is looked for once.
class TextureShelf {
public:
  TextureShelf(const Document& document, Scene& scene, Findings& findings)
      : document_(document), scene_(scene), findings_(findings) {}

  TextureId of(std::size_t texture) {
    const auto image = *image_of(element(document_.root, "textures", texture));
    const Sampler sampler = sampler_of(document_.root, texture, findings_);
    const auto [found, is_new] = ids_.try_emplace({image, sampler}, none<TextureId>);
    if (is_new)
      found->second = add(image, sampler);
    return found->second;
  }

private:
  TextureId add(std::size_t image, const Sampler& sampler) {
    const auto where = place(document_.root, "images", image);
    const auto resource = image_bytes(document_, image);
    if (!resource.problem.empty() || resource.bytes.empty())
      return leave_out(where, resource.problem.empty() ? "the image is empty" : resource.problem);
    if (const auto size = image_size(resource.bytes); size && !has_room_for(*size))
      return leave_out(where,
                       fmt::format("{} x {} pixels would take the textures over the memory limit",
                                   size->width, size->height));
    bytes_ += resource.bytes.size();
    if (bytes_ > document_.settings.memory_limit)
      throw OutputError(document_.file, where, "the images are over the memory limit");
    Texture texture;
    texture.name = name_of_image(element(document_.root, "images", image), image);
    texture.wrap_u = sampler.wrap_u;
    texture.wrap_v = sampler.wrap_v;
    texture.magnified = sampler.magnified;
    texture.encoded.resize(resource.bytes.size());
    std::ranges::transform(resource.bytes, texture.encoded.begin(),
                           [](unsigned char c) { return std::byte{c}; });
    scene_.textures.push_back(std::move(texture));
    return static_cast<TextureId>(scene_.textures.size() - 1);
  }

  TextureId leave_out(const std::string& where, const std::string& why) {
    constexpr std::size_t max_lines = 20;
    if (++left_out_ <= max_lines)
      findings_.say(fmt::format("{}: {}; the factor alone is used", where, why));
    else
      findings_.about("more images cannot be used", where);
    return none<TextureId>;
  }

  /// Decoded, an image is four floats a pixel, and a third as much again in coarser copies.
  bool has_room_for(const ImageSize& size) {
    const auto decoded = 16.0 * 4.0 / 3.0 * static_cast<double>(size.width) * size.height;
    if (decoded_bytes_ + decoded > static_cast<double>(document_.settings.memory_limit))
      return false;
    decoded_bytes_ += decoded;
    return true;
  }

  const Document& document_;
  Scene& scene_;
  Findings& findings_;
  std::size_t left_out_ = 0;
  double decoded_bytes_ = 0.0;
  std::map<std::pair<std::size_t, Sampler>, TextureId> ids_;
  std::uint64_t bytes_ = 0;
};

} // namespace

void read_textures(const Document& document, Scene& scene, Findings& findings) {
  TextureShelf shelf(document, scene, findings);
  const auto settle = [&](std::optional<TextureUse>& use) {
    if (!use)
      return;
    use->texture = shelf.of(index(use->texture));
    if (use->texture == none<TextureId>)
      use.reset();
  };
  for (auto& material : scene.materials)
    for (auto* use :
         {&material.base_color_texture, &material.metallic_roughness_texture,
          &material.emissive_texture, &material.transmission_texture, &material.thickness_texture,
          &material.normal_texture, &material.diffuse_transmission_texture,
          &material.diffuse_transmission_color_texture, &material.anisotropy_texture,
          &material.iridescence_texture, &material.film_thickness_texture})
      settle(*use);
  // What is shown comes before what may be no more than a factor, as long as there is room.
  for (auto& material : scene.materials)
    for (auto* use : {&material.specular_texture, &material.specular_color_texture,
                      &material.clear_coat_texture, &material.clear_coat_roughness_texture,
                      &material.sheen_color_texture, &material.sheen_roughness_texture})
      settle(*use);
}

} // namespace meninas::gltf
