// EXT_lights_image_based of the chosen scene: the largest faces of its cube, as they are encoded.
#include "scenes/gltf/stages.h"
#include "scenes/materials/image_size.h"

#include <fmt/format.h>

#include <algorithm>

namespace meninas::gltf {

/// The images of the first, largest level, +X -X +Y -Y +Z -Z; empty where they are not to be had.
static std::vector<std::size_t> face_images(const Document& document, const Json& light) {
  std::vector<std::size_t> images;
  const auto* levels = find(light, "specularImages");
  if (!levels || !levels->is_array() || levels->empty() || !levels->front().is_array() ||
      levels->front().size() != 6)
    return images;
  const std::size_t count = count_of(document.root, "images");
  for (const Json& face : levels->front()) {
    if (!face.is_number_unsigned() || face.get<std::uint64_t>() >= count)
      return {};
    images.push_back(face.get<std::size_t>());
  }
  return images;
}

void read_image_based_light(const Document& document, Scene& scene, Findings& findings) {
  const std::size_t chosen = size_or(document.root, "scene", 0);
  if (chosen >= count_of(document.root, "scenes"))
    return;
  const auto* use = find(element(document.root, "scenes", chosen),
                         {"extensions", "EXT_lights_image_based"});
  if (!use)
    return;
  const Json& light = element(document.root, "imageBasedLights", *index_at(*use, "light"));
  auto read = std::make_shared<ImageBasedLight>();
  const std::string name = name_of(light);
  read->name = name.empty() ? "EXT_lights_image_based" : name;
  const auto leave_out = [&](const std::string& why) {
    findings.say(fmt::format("EXT_lights_image_based is left out: {}", why));
  };
  const std::vector<std::size_t> images = face_images(document, light);
  if (images.empty())
    return leave_out("its first specularImages are not six images of the file");
  for (std::size_t k = 0; k < images.size(); ++k) {
    const Resource resource = image_bytes(document, images[k]);
    if (!resource.problem.empty() || resource.bytes.empty())
      return leave_out(fmt::format("{}: {}", place(document.root, "images", images[k]),
                                   resource.problem.empty() ? "the image is empty"
                                                            : resource.problem));
    constexpr double bytes_of_texel = 6.0 * 16.0; // of as many texels in each face, decoded
    if (const auto size = image_size(resource.bytes);
        size && bytes_of_texel * size->width * size->height >
                    static_cast<double>(document.settings.memory_limit))
      return leave_out(fmt::format("{} x {} pixels a face would take it over the memory limit",
                                   size->width, size->height));
    read->faces[k].resize(resource.bytes.size());
    std::ranges::transform(resource.bytes, read->faces[k].begin(),
                           [](unsigned char c) { return std::byte{c}; });
  }
  read->intensity = number_or(light, "intensity", 1.0) / light_unit(document);
  if (!(read->intensity >= 0.0))
    return leave_out("its intensity is negative");
  if (const auto rotation = numbers_at(light, "rotation"); rotation.size() == 4)
    std::ranges::copy(rotation, read->rotation.begin());
  scene.background.encoded = std::move(read);
}

} // namespace meninas::gltf
