// Materials and textures: defaults, extensions, and what is made physical with a warning.
#include "scenes/materials/lobes.h"
#include "tests/scenes/gltf/gltf_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace meninas::test {

static GltfFile with_material(Json material) {
  auto file = square();
  file.json["materials"][0] = std::move(material);
  return file;
}

TEST(GltfMaterials, ReadsFactorsAndExtensions) {
  const auto scene =
      load(with_material({{"name", "Glass"},
                          {"doubleSided", true},
                          {"alphaMode", "MASK"},
                          {"alphaCutoff", 0.25},
                          {"pbrMetallicRoughness",
                           {{"baseColorFactor", {0.1, 0.2, 0.3, 1.0}},
                            {"metallicFactor", 0.5},
                            {"roughnessFactor", 0.125}}},
                          {"emissiveFactor", {1.0, 0.5, 0.0}},
                          {"extensions",
                           {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8.0}}},
                            {"KHR_materials_ior", {{"ior", 1.33}}},
                            {"KHR_materials_specular",
                             {{"specularFactor", 0.75}, {"specularColorFactor", {1.0, 0.5, 2.0}}}},
                            {"KHR_materials_transmission", {{"transmissionFactor", 0.9}}}}}}));
  const auto& material = scene.materials.at(0);
  EXPECT_EQ(material.name, "Glass");
  EXPECT_EQ(material.base_color, Rgb(0.1, 0.2, 0.3));
  EXPECT_EQ(material.metallic, 0.5);
  EXPECT_EQ(material.roughness, 0.125);
  EXPECT_EQ(material.emission, Rgb(8, 4, 0)) << "radiance is factor times strength";
  EXPECT_TRUE(material.double_sided);
  EXPECT_EQ(material.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(material.alpha_cutoff, 0.25);
  EXPECT_EQ(material.ior, 1.33);
  EXPECT_EQ(material.specular, 0.75);
  EXPECT_EQ(material.specular_color, Rgb(1.0, 0.5, 2.0));
  EXPECT_EQ(material.transmission, 0.9);
}

TEST(GltfMaterials, GlassIsThereFromBothSidesAndMayBeSolid) {
  const auto with_volume = [](const Json& volume) {
    return load(with_material({{"name", "Jar"},
                               {"pbrMetallicRoughness", {{"metallicFactor", 0.0}}},
                               {"extensions",
                                {{"KHR_materials_transmission", {{"transmissionFactor", 1.0}}},
                                 {"KHR_materials_volume", volume}}}}));
  };
  const auto jar = with_volume({{"thicknessFactor", 0.5},
                                {"attenuationDistance", 2.0},
                                {"attenuationColor", {0.25, 1.0, 0.5}}});
  EXPECT_TRUE(jar.materials.at(0).double_sided);
  EXPECT_TRUE(is_solid_glass(jar.materials.at(0)));
  EXPECT_EQ(jar.materials.at(0).attenuation_distance, 2.0);
  EXPECT_EQ(jar.materials.at(0).attenuation_color, Rgb(0.25, 1.0, 0.5));
  EXPECT_TRUE(jar.ignored.empty());
  const auto thin = with_volume(Json::object());
  EXPECT_TRUE(is_glass(thin.materials.at(0)));
  EXPECT_FALSE(is_solid_glass(thin.materials.at(0)));
  const auto odd = with_volume({{"thicknessFactor", -1.0}, {"attenuationColor", {2.0, 1.0, 0.5}}});
  EXPECT_FALSE(is_solid_glass(odd.materials.at(0)));
  EXPECT_TRUE(warns(odd, {"volumes", "'Jar'"}));
}

TEST(GltfMaterials, GlassHasTexturesOfTransmissionAndThickness) {
  const Json use{{"index", 0},
                 {"texCoord", 1},
                 {"extensions", {{"KHR_texture_transform", {{"scale", {2.0, 3.0}}}}}}};
  const auto with_glass = [&](double transmission, double thickness, double distance) {
    auto file =
        with_material({{"name", "Jar"},
                       {"pbrMetallicRoughness", {{"metallicFactor", 0.0}}},
                       {"extensions",
                        {{"KHR_materials_transmission",
                          {{"transmissionFactor", transmission}, {"transmissionTexture", use}}},
                         {"KHR_materials_volume",
                          {{"thicknessFactor", thickness},
                           {"thicknessTexture", use},
                           {"attenuationDistance", distance}}}}}});
    file.json["images"] = Json::array({{{"uri", "data:image/png;base64,iVBORw0KGgo="}}});
    file.json["textures"] = Json::array({{{"source", 0}}});
    return load(file);
  };
  const auto solid = with_glass(0.5, 1.0, 2.0);
  for (const auto& read :
       {solid.materials.at(0).transmission_texture, solid.materials.at(0).thickness_texture}) {
    ASSERT_TRUE(read);
    EXPECT_EQ(read->texture, TextureId{0});
    EXPECT_EQ(read->texcoord_set, 1);
    EXPECT_EQ(read->scale, Vec2(2.0, 3.0));
  }
  EXPECT_TRUE(solid.ignored.empty());
  EXPECT_FALSE(warns(solid, {"transmission"}));
  EXPECT_FALSE(warns(solid, {"thickness"}));
  const auto thin = with_glass(0.5, 0.0, 2.0);
  EXPECT_TRUE(thin.materials.at(0).transmission_texture);
  EXPECT_FALSE(thin.materials.at(0).thickness_texture) << "of nothing";
  const auto opaque = with_glass(0.0, 1.0, 2.0);
  EXPECT_FALSE(opaque.materials.at(0).transmission_texture) << "of nothing";
}

TEST(GltfMaterials, WithoutAMaterialItIsGrey) {
  auto file = square();
  file.json["meshes"][0]["primitives"][0].erase("material");
  const auto scene = load(file);
  ASSERT_EQ(scene.materials.size(), 1u) << "materials that nothing uses stay out";
  EXPECT_EQ(diffuse_reflectance(scene.materials[0]), Rgb(0.8));
  EXPECT_FALSE(is_mirror(scene.materials[0]));
  EXPECT_TRUE(warns(scene, {"without a material", "'Quad'"}));
}

TEST(GltfMaterials, WithoutMetallicFactorItIsNotMetallic) {
  const auto scene = load(with_material({{"name", "Sloppy"}}));
  EXPECT_EQ(scene.materials.at(0).metallic, 0.0);
  EXPECT_EQ(scene.materials.at(0).roughness, 1.0);
  EXPECT_EQ(scene.materials.at(0).base_color, Rgb(1.0));
  EXPECT_TRUE(warns(scene, {"without metallicFactor", "'Sloppy'"}));

  const auto mirror = load(with_material(
      {{"pbrMetallicRoughness", {{"metallicFactor", 1.0}, {"roughnessFactor", 0.0}}}}));
  EXPECT_TRUE(is_mirror(mirror.materials.at(0)));
  EXPECT_EQ(mirror.materials[0].name, "material0");
  EXPECT_TRUE(mirror.warnings.empty());
}

TEST(GltfMaterials, RoughnessAloneMeansTheMetalOfTheSpecification) {
  // Blender leaves out a metallicFactor of 1,
  // glTF's default, and writes the roughness of its mirrors.
  const auto mirror = load(with_material({{"pbrMetallicRoughness", {{"roughnessFactor", 0.0}}}}));
  EXPECT_TRUE(is_mirror(mirror.materials.at(0)));
  EXPECT_TRUE(mirror.warnings.empty());
}

TEST(GltfMaterials, ClampsWhatIsNotPhysical) {
  const auto scene = load(with_material({{"name", "Wild"},
                                         {"pbrMetallicRoughness",
                                          {{"baseColorFactor", {1.5, -0.5, 0.5, 1.0}},
                                           {"metallicFactor", 7.0},
                                           {"roughnessFactor", -1.0}}},
                                         {"emissiveFactor", {-1.0, 2.0, 0.0}},
                                         {"extensions", {{"KHR_materials_ior", {{"ior", 0.5}}}}}}));
  const auto& material = scene.materials.at(0);
  EXPECT_EQ(material.base_color, Rgb(1.0, 0.0, 0.5));
  EXPECT_EQ(material.metallic, 1.0);
  EXPECT_EQ(material.roughness, 0.0);
  EXPECT_EQ(material.emission, Rgb(0.0, 2.0, 0.0));
  EXPECT_EQ(material.ior, 1.0);
  for (const auto* part : {"reflectances", "factors outside", "negative emission", "refraction"})
    EXPECT_TRUE(warns(scene, {part, "'Wild'"})) << part;

  EXPECT_THAT(
      error_of(with_material(
          {{"name", "Sun"},
           {"emissiveFactor", {1e200, 1.0, 1.0}},
           {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 1e200}}}}}})),
      testing::HasSubstr("materials[0] 'Sun': its emission is over"));
}

TEST(GltfMaterials, OfUnlitOnesTheBaseColourRemains) {
  const auto scene = load(with_material(
      {{"pbrMetallicRoughness", {{"baseColorFactor", {0.2, 0.4, 0.6, 1}}, {"metallicFactor", 1}}},
       {"emissiveFactor", {1, 1, 1}},
       {"extensions",
        {{"KHR_materials_unlit", Json::object()},
         {"KHR_materials_transmission", {{"transmissionFactor", 1.0}}}}}}));
  const Material& material = scene.materials[0];
  EXPECT_TRUE(material.unlit);
  EXPECT_EQ(material.base_color, Rgb(0.2, 0.4, 0.6));
  EXPECT_FALSE(is_emitter(material) || is_glass(material) || is_glossy(material));
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfMaterials, WarnsOfOcclusionMapsAndUnknownModes) {
  const auto scene = load(with_material(
      {{"name", "Leaf"},
       {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.5}}, {"metallicFactor", 0}}},
       {"occlusionTexture", {{"index", 0}}}}));
  EXPECT_TRUE(warns(scene, {"occlusion", "'Leaf'"}));
  EXPECT_TRUE(warns(load(with_material({{"alphaMode", "GLOW"}})), {"alphaMode"}));
}

TEST(GltfMaterials, ClearCoatsTakeThePlaceOfDullerGloss) {
  auto file = square();
  const auto read = [&](double metallic, double roughness, Json coat) {
    file.json["materials"][0] = {
        {"name", "Car"},
        {"pbrMetallicRoughness", {{"metallicFactor", metallic}, {"roughnessFactor", roughness}}},
        {"extensions", {{"KHR_materials_clearcoat", std::move(coat)}}}};
    return load(file);
  };
  const Json lacquer{{"clearcoatFactor", 0.75}, {"clearcoatRoughnessFactor", 0.125}};
  const auto paint = read(0.0, 0.5, lacquer);
  EXPECT_EQ(paint.materials.at(0).roughness, 0.125);
  EXPECT_EQ(paint.materials.at(0).specular, 0.75);
  EXPECT_TRUE(has_visible_coat(paint.materials.at(0)));
  EXPECT_TRUE(warns(paint, {"clear coats are shown", "'Car'"}));
  EXPECT_THAT(paint.ignored, testing::IsEmpty());
  for (const auto& [metallic, roughness] : {std::pair(1.0, 0.5), std::pair(0.0, 0.0625)}) {
    const auto kept = read(metallic, roughness, lacquer);
    EXPECT_EQ(kept.materials.at(0).roughness, roughness);
    EXPECT_EQ(kept.materials.at(0).specular, 1.0);
    EXPECT_TRUE(warns(kept, {"clear coats", "left out", "'Car'"}));
  }
  EXPECT_FALSE(warns(read(0.0, 0.5, Json::object()), {"clear coat"})) << "there is none by default";
}

TEST(GltfMaterials, TexturesOfCoatsAreReadForWhatTheySayEverywhere) {
  auto file = square();
  const Json use{{"index", 0}};
  const auto read = [&](double factor) -> Material {
    file.json["materials"][0] = {
        {"name", "Car"},
        {"pbrMetallicRoughness", {{"metallicFactor", 0.0}}},
        {"extensions",
         {{"KHR_materials_specular",
           {{"specularFactor", factor}, {"specularTexture", use}, {"specularColorTexture", use}}},
          {"KHR_materials_clearcoat",
           {{"clearcoatFactor", factor},
            {"clearcoatRoughnessFactor", 0.5},
            {"clearcoatTexture", use},
            {"clearcoatRoughnessTexture", use}}}}}};
    file.json["images"] = Json::array({{{"uri", "data:image/png;base64,iVBORw0KGgo="}}});
    file.json["textures"] = Json::array({{{"source", 0}}});
    const Scene scene = load(file);
    EXPECT_FALSE(warns(scene, {"'Car'"})) << "nothing is left out yet";
    return scene.materials.at(0);
  };
  const Material car = read(0.5);
  for (const auto& texture : {car.specular_texture, car.specular_color_texture,
                              car.clear_coat_texture, car.clear_coat_roughness_texture}) {
    ASSERT_TRUE(texture);
    EXPECT_EQ(texture->texture, TextureId{0});
  }
  EXPECT_EQ(car.clear_coat, 0.5);
  EXPECT_EQ(car.clear_coat_roughness, 0.5);
  EXPECT_EQ(car.roughness, 1.0) << "that is settled by what the textures say";
  const Material none = read(0.0);
  EXPECT_FALSE(none.specular_texture || none.specular_color_texture || none.clear_coat_texture ||
               none.clear_coat_roughness_texture)
      << "of nothing";
}

TEST(GltfMaterials, AThousandSloppyMaterialsMakeOneLine) {
  auto file = square();
  for (int k = 0; k < 1000; ++k) {
    auto primitive = square_primitive(file);
    primitive["material"] = file.add_material({{"name", fmt::format("M{}", k)}});
    file.json["meshes"][0]["primitives"].push_back(primitive);
  }
  const auto scene = load(file);
  EXPECT_EQ(scene.materials.size(), 1001u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_THAT(scene.warnings[0], testing::HasSubstr("'M7' and 992 more"));
}

/// A square whose base colour is texture 0: image 0 through sampler 0.
static GltfFile textured() {
  auto file = with_material(
      {{"name", "Paint"},
       {"pbrMetallicRoughness",
        {{"metallicFactor", 0.0},
         {"baseColorTexture",
          {{"index", 0},
           {"texCoord", 1},
           {"extensions",
            {{"KHR_texture_transform",
              {{"offset", {0.5, 0.25}}, {"rotation", 1.5}, {"scale", {2.0, 3.0}}}}}}}}}}});
  file.json["textures"] = Json::array({{{"source", 0}, {"sampler", 0}}});
  file.json["samplers"] = Json::array({{{"wrapS", 33071}, {"wrapT", 10497}}});
  file.json["images"] = Json::array({{{"name", "bricks"}, {"uri", data_uri({1, 2, 3, 4})}}});
  return file;
}

TEST(GltfTextures, KeepsBytesWrappingAndTransform) {
  const auto scene = load(textured());
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.textures[0].name, "bricks");
  EXPECT_THAT(scene.textures[0].encoded,
              testing::ElementsAre(std::byte{1}, std::byte{2}, std::byte{3}, std::byte{4}));
  EXPECT_EQ(scene.textures[0].wrap_u, Wrap::clamp);
  EXPECT_EQ(scene.textures[0].wrap_v, Wrap::repeat);
  const auto& use = scene.materials.at(0).base_color_texture;
  ASSERT_TRUE(use.has_value());
  EXPECT_EQ(index(use->texture), 0u);
  EXPECT_EQ(use->texcoord_set, 1);
  EXPECT_EQ(use->offset, Vec2(0.5, 0.25));
  EXPECT_EQ(use->rotation, 1.5);
  EXPECT_EQ(use->scale, Vec2(2.0, 3.0));
}

TEST(GltfTextures, NamesWhatHasNoCoordinatesForThem) {
  // The square has none, and its material asks for the second set.
  auto file = textured();
  EXPECT_TRUE(warns(load(file), {"coordinates that their materials ask for", "'Quad'"}));
  const auto set = file.add_accessor<float>({0, 0, 1, 0, 1, 1, 0, 1}, "VEC2");
  square_primitive(file)["attributes"]["TEXCOORD_0"] = set;
  EXPECT_TRUE(warns(load(file), {"coordinates that their materials ask for"}));
  square_primitive(file)["attributes"]["TEXCOORD_1"] = set;
  EXPECT_FALSE(warns(load(file), {"coordinates"}));
}

TEST(GltfTextures, ReadsImagesFromBufferViewsAndFiles) {
  auto in_view = textured();
  in_view.json["images"][0] = {{"bufferView", in_view.add_view({9, 8, 7})},
                               {"mimeType", "image/png"}};
  const auto from_view = load(in_view);
  EXPECT_THAT(from_view.textures.at(0).encoded,
              testing::ElementsAre(std::byte{9}, std::byte{8}, std::byte{7}));
  EXPECT_EQ(from_view.textures[0].name, "image0");

  auto in_file = textured();
  in_file.json["images"][0] = {{"uri", "maps/my%20wall.png"}};
  const TemporaryFolder folder;
  folder.write("maps/my wall.png", "pixels");
  const auto from_file = load_gltf(folder.write("scene.gltf", as_text(in_file)));
  EXPECT_EQ(from_file.textures.at(0).encoded.size(), 6u);
}

TEST(GltfTextures, SharesImagesAndKeepsOnlyThoseInUse) {
  auto file = textured();
  file.json["images"].push_back({{"uri", "never read.png"}});
  file.json["textures"].push_back({{"source", 1}});
  file.json["textures"].push_back({{"source", 0}, {"sampler", 0}});
  file.json["materials"][0]["emissiveTexture"] = {{"index", 2}};
  const auto scene = load(file);
  EXPECT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(index(scene.materials[0].emissive_texture->texture), 0u);
}

TEST(GltfTextures, MissingImagesAreWarnings) {
  for (const auto* uri : {"nowhere.png", "../outside.png", "https://example.com/a.png",
                          "data:image/png;base64,@@@@", "/etc/hostname"}) {
    auto file = textured();
    file.json["images"][0]["uri"] = uri;
    const auto scene = load(file);
    EXPECT_TRUE(scene.textures.empty()) << uri;
    EXPECT_FALSE(scene.materials[0].base_color_texture.has_value());
    EXPECT_TRUE(warns(scene, {"images[0] 'bricks'", "the factor alone is used"})) << uri;
  }
  auto basis = textured();
  basis.json["textures"][0].erase("source");
  EXPECT_TRUE(warns(load(basis), {"without an image", "'Paint'"}));
  auto third_set = textured();
  third_set.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0},
                                                                                {"texCoord", 2}};
  EXPECT_TRUE(warns(load(third_set), {"texCoord above 1", "'Paint'"}));
  auto unknown = textured();
  unknown.json["samplers"][0] = {{"wrapS", 5}, {"magFilter", 6}};
  EXPECT_TRUE(warns(load(unknown), {"unknown wrapping", "textures[0]"}));
  EXPECT_TRUE(warns(load(unknown), {"unknown filters", "textures[0]"}));
}

TEST(GltfTextures, AFolderOfMissingImagesIsNotAFloodOfLines) {
  auto file = textured();
  file.json["images"] = file.json["textures"] = file.json["materials"] = Json::array();
  const Json primitive = square_primitive(file);
  for (int k = 0; k < 300; ++k) {
    file.json["images"].push_back({{"uri", "gone" + std::to_string(k) + ".png"}});
    file.json["textures"].push_back({{"source", k}});
    file.add_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", k}}}}}});
    file.json["meshes"][0]["primitives"][k] = primitive;
    file.json["meshes"][0]["primitives"][k]["material"] = k;
  }
  const auto scene = load(file);
  EXPECT_TRUE(warns(scene, {"images[0]: 'gone0.png': no such file"}));
  EXPECT_TRUE(warns(scene, {"more images cannot be used", "'images[20]'", "and 272 more"}));
  EXPECT_LT(scene.warnings.size(), 30U);
}

TEST(GltfTextures, ReadsSamplersAndKeepsAnImageOnceForEach) {
  auto file = textured();
  file.json["samplers"] =
      Json::array({{{"wrapS", 33648}, {"wrapT", 33071}, {"magFilter", 9728}, {"minFilter", 9987}},
                   {{"magFilter", 9729}}});
  file.json["textures"].push_back({{"source", 0}, {"sampler", 1}});
  file.json["textures"].push_back({{"source", 0}});
  file.json["materials"][0]["emissiveTexture"] = {{"index", 1}};
  file.json["materials"][0]["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 2}};
  const Scene scene = load(file);
  ASSERT_EQ(scene.textures.size(), 2u) << "the sampler that says nothing is the same as none";
  EXPECT_EQ(scene.textures[0].wrap_u, Wrap::mirrored);
  EXPECT_EQ(scene.textures[0].wrap_v, Wrap::clamp);
  EXPECT_EQ(scene.textures[0].magnified, TexelFilter::nearest);
  EXPECT_EQ(scene.textures[1].wrap_u, Wrap::repeat);
  EXPECT_EQ(scene.textures[1].magnified, TexelFilter::linear);
}

} // namespace meninas::test
