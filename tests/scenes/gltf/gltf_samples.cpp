#include "tests/scenes/gltf/gltf_samples.h"

namespace meninas::test {

GltfFile everything() {
  auto file = square();
  const auto sparse_indices = file.add_view({2, 0});
  const auto sparse_values = file.add_view(Bytes(24, 0x3f));
  file.json["accessors"][0]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", sparse_indices}, {"componentType", 5121}}},
      {"values", {{"bufferView", sparse_values}}}};
  square_primitive(file)["attributes"]["TEXCOORD_0"] =
      file.add_accessor<std::uint16_t>({0, 0, 9, 9, 99, 99, 999, 999}, "VEC2");
  square_primitive(file)["attributes"]["NORMAL"] =
      file.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  square_primitive(file)["attributes"]["TANGENT"] =
      file.add_accessor<float>({1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, -1, 0, 1, 0, -1}, "VEC4");
  file.json["materials"][0]["normalTexture"] = {{"index", 0}, {"scale", 0.5}};
  const auto strip = file.add_accessor<std::int16_t>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
  file.json["meshes"][0]["primitives"].push_back(
      {{"attributes", {{"POSITION", strip}}}, {"mode", 5}});
  Json without_tangents = square_primitive(file);
  without_tangents["attributes"].erase("TANGENT");
  file.json["meshes"][0]["primitives"].push_back(without_tangents);
  file.json["materials"][0]["emissiveFactor"] = {1, 1, 1};
  file.json["materials"][0]["extensions"] = {
      {"KHR_materials_emissive_strength", {{"emissiveStrength", 3}}},
      {"KHR_materials_ior", {{"ior", 1.4}}},
      {"KHR_materials_specular", {{"specularFactor", 0.5}}},
      {"KHR_materials_transmission",
       {{"transmissionFactor", 0.5}, {"transmissionTexture", {{"index", 0}}}}}};
  file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {
      {"index", 0},
      {"extensions", {{"KHR_texture_transform", {{"offset", {0, 1}}, {"scale", {1, 2}}}}}}};
  file.json["textures"] = Json::array({{{"source", 0}, {"sampler", 0}}});
  file.json["samplers"] = Json::array({{{"wrapS", 33071}}});
  file.json["images"] = Json::array({{{"bufferView", sparse_values}}});
  file.json["cameras"] =
      Json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"aspectRatio", 1}}}},
                   {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}}}}});
  file.json["extensions"]["KHR_lights_punctual"]["lights"] =
      Json::array({{{"type", "spot"}, {"intensity", 2}, {"spot", {{"outerConeAngle", 0.5}}}}});
  const std::string ies = "IESNA91\nTILT=NONE\n1 9 1 2 1 1 2 0 0 0\n1 1 1\n0 90\n0\n9 0\n";
  file.json["extensions"]["EXT_lights_ies"]["lights"] =
      Json::array({{{"uri", data_uri(Bytes(ies.begin(), ies.end()))}}});
  file.json["extensionsUsed"] = {"EXT_lights_ies", "KHR_lights_punctual", "KHR_materials_ior"};
  file.add_node({{"camera", 0},
                 {"rotation", {0, 0, 0, 1}},
                 {"extensions", {{"EXT_lights_ies", {{"light", 0}, {"multiplier", 2}, {"color", {1, 1, 0}}}}}}});
  file.add_node({{"camera", 1}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
  file.add_node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}},
                 {"children", {0, 1, 2}},
                 {"scale", {1, -2, 1}}});
  file.json["scenes"] = Json::array({{{"nodes", {3}}}});
  file.json["scene"] = 0;
  animate(file, 0, "rotation", "CUBICSPLINE", {0, 1},
          {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0});
  file.json["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = false;
  file.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = {2};
  file.json["extensions"]["KHR_materials_variants"]["variants"] = Json::array({{{"name", "day"}}});
  square_primitive(file)["extensions"]["KHR_materials_variants"]["mappings"] =
      Json::array({{{"material", 0}, {"variants", {0}}}});
  return file;
}

GltfFile skinned_square() {
  auto file = square();
  auto& attributes = square_primitive(file)["attributes"];
  attributes["JOINTS_0"] =
      file.add_accessor<std::uint8_t>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  attributes["WEIGHTS_0"] =
      file.add_accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  file.json["nodes"][0]["skin"] = 0;
  file.json["nodes"][0]["translation"] = {100, 100, 100};
  file.add_node({{"name", "Root"}, {"children", {2}}, {"translation", {1, 0, 0}}});
  file.add_node({{"name", "Arm"}, {"translation", {0, 2, 0}}});
  file.json["skins"] = Json::array({{{"joints", {1, 2}}}});
  return file;
}

GltfFile morphed_square() {
  auto file = square();
  const auto shift = file.add_accessor<float>({0, 0, 4, 0, 0, 4, 0, 0, 4, 0, 0, 4}, "VEC3");
  square_primitive(file)["targets"] = Json::array({{{"NORMAL", shift}}, {{"POSITION", shift}}});
  file.json["meshes"][0]["weights"] = {1.0, 0.25};
  return file;
}

void animate(GltfFile& file, std::size_t node, const std::string& path,
             const std::string& interpolation, const std::vector<float>& times,
             const std::vector<float>& values) {
  const std::string type = path == "rotation" ? "VEC4" : path == "weights" ? "SCALAR" : "VEC3";
  const auto input = file.add_accessor<float>(times, "SCALAR");
  const auto output = file.add_accessor<float>(values, type);
  const Json channel{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}};
  const Json sampler{{"input", input}, {"output", output}, {"interpolation", interpolation}};
  file.json["animations"].push_back(
      {{"channels", Json::array({channel})}, {"samplers", Json::array({sampler})}});
}

GltfFile animated_square() {
  auto file = morphed_square();
  animate(file, 0, "translation", "CUBICSPLINE", {0, 1},
          {0, 0, 0, 1, 2, 3, 0, 1, 0, 1, 0, 0, 4, 5, 6, 0, 0, 0});
  animate(file, 0, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 1, 0, 0});
  animate(file, 0, "scale", "STEP", {0, 1}, {1, 1, 1, 2, 2, 2});
  animate(file, 0, "weights", "LINEAR", {0, 1}, {0, 0, 1, 1});
  return file;
}

GltfFile instanced_square() {
  auto file = square();
  const auto moves = file.add_accessor<float>({0, 0, 0, 0, 0, 5}, "VEC3");
  const auto turns = file.add_accessor<float>({0, 0, 0, 1, 0, 1, 0, 0}, "VEC4");
  const auto sizes = file.add_accessor<float>({1, 1, 1, 2, 2, 2}, "VEC3");
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", moves}, {"ROTATION", turns}, {"SCALE", sizes}, {"_ID", moves}};
  file.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  return file;
}

GltfFile layered_square() {
  auto file = square();
  square_primitive(file)["attributes"]["TEXCOORD_1"] =
      file.add_accessor<float>({0, 0, 1, 0, 1, 1, 0, 1}, "VEC2");
  const Json texture{{"index", 0}, {"texCoord", 1}};
  file.json["materials"][0]["emissiveFactor"] = {1, 1, 1};
  file.json["materials"][0]["extensions"] = {
      {"KHR_materials_iridescence",
       {{"iridescenceFactor", 1},
        {"iridescenceTexture", texture},
        {"iridescenceIor", 1.3},
        {"iridescenceThicknessMinimum", 100},
        {"iridescenceThicknessMaximum", 400},
        {"iridescenceThicknessTexture", texture}}},
      {"KHR_materials_anisotropy",
       {{"anisotropyStrength", 0.5}, {"anisotropyRotation", 1}, {"anisotropyTexture", texture}}},
      {"KHR_materials_clearcoat",
       {{"clearcoatFactor", 1}, {"clearcoatRoughnessFactor", 0}, {"clearcoatTexture", texture}}}};
  file.add_material({{"alphaMode", "BLEND"},
                     {"extensions",
                      {{"KHR_materials_sheen",
                        {{"sheenColorFactor", {1, 0.5, 0}}, {"sheenRoughnessFactor", 0.5}}},
                       {"KHR_materials_diffuse_transmission",
                        {{"diffuseTransmissionFactor", 0.5},
                         {"diffuseTransmissionColorFactor", {1, 1, 0.5}}}}}}});
  file.add_material({{"extensions",
                      {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
                       {"KHR_materials_dispersion", {{"dispersion", 0.1}}},
                       {"KHR_materials_volume",
                        {{"thicknessFactor", 1},
                         {"attenuationDistance", 0.5},
                         {"attenuationColor", {0.5, 1, 1}}}}}}});
  for (std::size_t material : {1U, 2U}) {
    Json primitive = square_primitive(file);
    primitive["material"] = material;
    file.json["meshes"][0]["primitives"].push_back(primitive);
  }
  const auto view = file.add_view(Bytes(8, 0x89));
  file.json["textures"] = Json::array({{{"source", 0}}});
  file.json["images"] = Json::array({{{"bufferView", view}, {"mimeType", "image/png"}}});
  file.json["nodes"][0]["extras"]["lamp"] = "ceiling";
  file.json["asset"]["extras"]["light_units"] = "photometric";
  file.json["extensions"]["EXT_lights_image_based"]["lights"] = Json::array(
      {{{"specularImages", Json::array({{0, 0, 0, 0, 0, 0}})}, {"intensity", 2}, {"rotation", {0, 0, 0, 1}}}});
  file.json["scenes"] = Json::array({{{"nodes", {0}}, {"extensions", {{"EXT_lights_image_based", {{"light", 0}}}}}}});
  file.json["scene"] = 0;
  return file;
}

GltfFile old_material() {
  auto file = square();
  file.json["images"] = Json::array({{{"bufferView", 0}, {"name", "first"}}});
  file.json["textures"] = Json::array({{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}});
  file.json["materials"][0] = {{"name", "Old"},
                               {"extensions",
                                {{"KHR_materials_pbrSpecularGlossiness",
                                  {{"diffuseFactor", {0.5, 0.25, 0.125, 1}},
                                   {"specularFactor", {0.04, 0.04, 0.04}},
                                   {"glossinessFactor", 0.25},
                                   {"diffuseTexture", {{"index", 0}}}}}}}};
  return file;
}

} // namespace meninas::test
