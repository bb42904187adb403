#include "scenes/gallery/generator/gltf_document.h"

#include "scenes/gallery/generator/picture_file.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace meninas::gallery {

static constexpr int array_buffer = 34962, element_array_buffer = 34963, float_type = 5126,
                     unsigned_short = 5123, unsigned_int = 5125;

static void append_little_endian(std::vector<std::uint8_t>& bytes, std::uint32_t value, int size) {
  for (int k = 0; k < size; ++k)
    bytes.push_back(static_cast<std::uint8_t>(value >> (8 * k)));
}

static Json json(const Rgb& v) { return Json::array({v.x, v.y, v.z}); }

static bool is_cut_out(const Picture& picture) {
  return std::ranges::any_of(picture.palette, [](const auto& colour) { return colour[3] == 0; });
}

static Json material_json(const Paint& paint) {
  Json material{{"name", paint.name}};
  material["pbrMetallicRoughness"] = {
      {"baseColorFactor", Json::array({paint.color.x, paint.color.y, paint.color.z, 1.0})},
      {"metallicFactor", paint.finish == Finish::metal ? 1.0 : 0.0},
      {"roughnessFactor", paint.roughness}};
  if (paint.finish == Finish::glass) {
    material["extensions"] = {{"KHR_materials_transmission", {{"transmissionFactor", 1.0}}}};
    material["doubleSided"] = true;
  }

  if (paint.finish == Finish::solid) {
    material["pbrMetallicRoughness"]["baseColorFactor"] = Json::array({1.0, 1.0, 1.0, 1.0});
    material["extensions"] = {{"KHR_materials_transmission", {{"transmissionFactor", 1.0}}},
                              {"KHR_materials_volume",
                               {{"thicknessFactor", paint.thickness},
                                {"attenuationDistance", paint.thickness},
                                {"attenuationColor", json(paint.color)}}}};
    material["doubleSided"] = true;
  }

  if (paint.transmission > 0.0)
    material["extensions"] = {{"KHR_materials_diffuse_transmission",
                               {{"diffuseTransmissionFactor", paint.transmission},
                                {"diffuseTransmissionColorFactor", json(paint.color)}}}};

  // emissiveFactor ends at 1; what is brighter is carried by the strength.
  const auto brightest = std::max({paint.radiance.x, paint.radiance.y, paint.radiance.z});
  if (brightest > 1.0) {
    material["emissiveFactor"] = json(paint.radiance / brightest);
    material["extensions"] = {
        {"KHR_materials_emissive_strength", {{"emissiveStrength", brightest}}}};
  } else if (brightest > 0.0) {
    material["emissiveFactor"] = json(paint.radiance);
  }
  return material;
}

/// The texture of a picture, which the file holds once.
static std::size_t texture_index(Document& document, const Picture& picture) {
  const auto known = std::ranges::find(document.pictures, picture);
  const auto index = static_cast<std::size_t>(known - document.pictures.begin());
  if (known != document.pictures.end())
    return index;
  document.pictures.push_back(picture);
  document.images.push_back(png_bytes(picture));
  constexpr int mirrored_repeat = 33648, repeated = 10497;
  const int wrap = picture.mirrored ? mirrored_repeat : repeated;
  document.samplers.push_back({{"wrapS", wrap}, {"wrapT", wrap}});
  document.textures.push_back({{"source", index}, {"sampler", index}});
  return index;
}

static std::size_t material_index(Document& document, const Paint& paint) {
  auto material = material_json(paint);
  if (!paint.picture.texels.empty())
    material["pbrMetallicRoughness"]["baseColorTexture"] = {
        {"index", texture_index(document, paint.picture)}};
  if (is_cut_out(paint.picture)) {
    material["alphaMode"] = "MASK";
    material["doubleSided"] = true;
  }
  const auto known = std::ranges::find(document.materials, material);
  const auto index = static_cast<std::size_t>(known - document.materials.begin());
  if (known == document.materials.end())
    document.materials.push_back(material);
  const bool solid = paint.finish == Finish::solid;
  document.has_solids |= solid;
  document.has_glass |= solid || paint.finish == Finish::glass;
  document.has_cloth |= paint.transmission > 0.0;
  document.has_strength |= material.contains("extensions") &&
                           material["extensions"].contains("KHR_materials_emissive_strength");
  return index;
}

/// An attribute of floats as a buffer, a view and an accessor of its own.
template <typename Vectors>
static std::size_t add_attribute(Document& document, const Vectors& vectors, const char* type) {
  std::vector<std::uint8_t> bytes;
  for (const auto& vector : vectors)
    for (int k = 0; k < vector.length(); ++k)
      append_little_endian(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(vector[k])), 4);
  document.views.push_back({{"buffer", document.buffers.size()},
                            {"byteLength", bytes.size()},
                            {"target", array_buffer}});
  document.buffers.push_back(std::move(bytes));
  document.accessors.push_back({{"bufferView", document.views.size() - 1},
                                {"componentType", float_type},
                                {"count", vectors.size()},
                                {"type", type}});
  return document.accessors.size() - 1;
}

static Json mesh_json(Document& document, const Part& part) {
  std::vector<std::uint8_t> bytes;
  glm::vec3 low(std::numeric_limits<float>::infinity());
  glm::vec3 high(-low);
  for (const auto& position : part.mesh.positions) {
    // Adding zero turns -0 into 0, so that mirrored and plain coordinates have the same bits.
    const auto rounded = glm::vec3(position) + 0.0f;
    for (int k = 0; k < 3; ++k)
      append_little_endian(bytes, std::bit_cast<std::uint32_t>(rounded[k]), 4);
    low = glm::min(low, rounded);
    high = glm::max(high, rounded);
  }
  const auto position_bytes = bytes.size();
  const bool many = part.mesh.positions.size() > std::numeric_limits<std::uint16_t>::max();
  for (const auto& triangle : part.mesh.triangles)
    for (const auto vertex : triangle)
      append_little_endian(bytes, vertex, many ? 4 : 2);

  const auto buffer = document.buffers.size();
  const auto index_bytes = bytes.size() - position_bytes;
  document.buffers.push_back(std::move(bytes));

  const auto first_view = document.views.size();
  document.views.push_back({{"buffer", buffer},
                            {"byteOffset", 0},
                            {"byteLength", position_bytes},
                            {"target", array_buffer}});
  document.views.push_back({{"buffer", buffer},
                            {"byteOffset", position_bytes},
                            {"byteLength", index_bytes},
                            {"target", element_array_buffer}});

  const auto first_accessor = document.accessors.size();
  document.accessors.push_back({{"bufferView", first_view},
                                {"componentType", float_type},
                                {"count", part.mesh.positions.size()},
                                {"type", "VEC3"},
                                {"min", json(low)},
                                {"max", json(high)}});
  document.accessors.push_back({{"bufferView", first_view + 1},
                                {"componentType", many ? unsigned_int : unsigned_short},
                                {"count", 3 * part.mesh.triangles.size()},
                                {"type", "SCALAR"}});

  Json primitive{{"attributes", {{"POSITION", first_accessor}}},
                 {"indices", first_accessor + 1},
                 {"material", material_index(document, part.paint)}};
  if (!part.mesh.normals.empty())
    primitive["attributes"]["NORMAL"] = add_attribute(document, part.mesh.normals, "VEC3");
  if (!part.mesh.texcoords.empty())
    primitive["attributes"]["TEXCOORD_0"] = add_attribute(document, part.mesh.texcoords, "VEC2");
  if (!part.mesh.colors.empty())
    primitive["attributes"]["COLOR_0"] = add_attribute(document, part.mesh.colors, "VEC3");
  return {{"name", part.name}, {"primitives", Json::array({primitive})}};
}

static void add_part(Document& document, const Part& part) {
  document.nodes.push_back({{"name", part.name}, {"mesh", document.meshes.size()}});
  document.meshes.push_back(mesh_json(document, part));
}

/// What looks or shines along -z of its node, with +y up.
static Json pose_json(const Point3& eye, const Point3& target) {
  const auto back = glm::normalize(eye - target);
  const auto right = glm::normalize(glm::cross(Vec3(0.0, 1.0, 0.0), back));
  const auto up = glm::cross(back, right);
  Json matrix = Json::array();
  for (const auto& column :
       {glm::dvec4(right, 0.0), glm::dvec4(up, 0.0), glm::dvec4(back, 0.0), glm::dvec4(eye, 1.0)})
    for (int k = 0; k < 4; ++k)
      matrix.push_back(column[k] + 0.0);
  return matrix;
}

static void add_view(Document& document, const View& view) {
  document.nodes.push_back({{"name", view.name},
                            {"camera", document.cameras.size()},
                            {"matrix", pose_json(view.eye, view.target)}});
  document.cameras.push_back({{"name", view.name},
                              {"type", "perspective"},
                              {"perspective",
                               {{"aspectRatio", view.aspect},
                                {"yfov", glm::radians(view.vertical_fov)},
                                {"znear", 0.01},
                                {"zfar", 1000.0}}}});
}

static void add_lamp(Document& document, const Lamp& lamp) {
  document.nodes.push_back(
      {{"name", lamp.name},
       {"matrix", pose_json(lamp.eye, lamp.target)},
       {"extensions", {{"KHR_lights_punctual", {{"light", document.lights.size()}}}}}});
  const auto brightest = std::max({lamp.intensity.x, lamp.intensity.y, lamp.intensity.z});
  Json light{{"name", lamp.name},
             {"type", lamp.type},
             {"color", json(lamp.intensity / brightest)},
             {"intensity", brightest}};
  if (lamp.type == "spot")
    light["spot"] = {{"innerConeAngle", glm::radians(lamp.inner_cone)},
                     {"outerConeAngle", glm::radians(lamp.outer_cone)}};
  document.lights.push_back(light);
}

Document document_of(const Stage& stage) {
  Document document;
  for (const auto& view : stage.views)
    add_view(document, view);
  for (const auto& lamp : stage.lamps)
    add_lamp(document, lamp);
  for (const auto& part : stage.parts)
    add_part(document, part);

  return document;
}

std::vector<std::string> extensions_used(const Document& document) {
  std::vector<std::string> used;
  if (document.has_strength)
    used.emplace_back("KHR_materials_emissive_strength");
  if (document.has_glass)
    used.emplace_back("KHR_materials_transmission");
  if (document.has_solids)
    used.emplace_back("KHR_materials_volume");
  if (document.has_cloth)
    used.emplace_back("KHR_materials_diffuse_transmission");
  if (!document.lights.empty())
    used.emplace_back("KHR_lights_punctual");
  return used;
}

} // namespace meninas::gallery
