#include "runs/bake/baked_document.h"

#include "runs/bake/document_edit.h"
#include "scenes/gltf/state/variants.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace meninas {

using gltf::Json;

namespace {

using PrimitiveKey = std::pair<std::size_t, std::size_t>; ///< mesh and number

bool is_lit(const std::vector<std::array<ChartPoint, 3>>& triangles) {
  return std::ranges::any_of(triangles, [](const auto& corners) { return corners[0].chart != no_chart; });
}

/// Which primitives get a lightmap, and which of them are also shown where they get none.
struct Rewriting {
  std::set<PrimitiveKey> lit;
  std::set<std::size_t> shown_elsewhere; ///< meshes of nodes outside of the scene
  std::set<PrimitiveKey> in_place;       ///< lit, and nowhere else

  explicit Rewriting(const BakedScene& scene) {
    std::set<std::size_t> nodes;
    for (std::size_t k = 0; k < scene.primitives.size(); ++k) {
      const gltf::PlacedPrimitive& primitive = scene.primitives[k];
      nodes.insert(primitive.file_node);
      if (is_lit(scene.charts.corners[k]))
        lit.insert({primitive.mesh, primitive.number});
    }
    for (std::size_t n = 0; n < gltf::count_of(scene.file.root, "nodes"); ++n)
      if (const auto mesh = gltf::index_at(gltf::element(scene.file.root, "nodes", n), "mesh"))
        if (!nodes.contains(n))
          shown_elsewhere.insert(*mesh);
    for (const PrimitiveKey& key : lit)
      if (!shown_elsewhere.contains(key.first))
        in_place.insert(key);
  }
};

int texcoord_sets_of(const Json& primitive) {
  int sets = 0;
  while (primitive["attributes"].contains(fmt::format("TEXCOORD_{}", sets)))
    ++sets;
  return sets;
}

/// The primitive's material, and those of its variants.
std::set<std::size_t> materials_of(const Json& primitive) {
  std::set<std::size_t> materials;
  if (const auto own = gltf::index_at(primitive, "material"))
    materials.insert(*own);
  if (const Json* mappings = gltf::find(primitive, {"extensions", "KHR_materials_variants", "mappings"}))
    for (const Json& mapping : *mappings)
      materials.insert(gltf::size_value(mapping["material"]));
  return materials;
}

class Baker {
public:
  Baker(const BakedScene& scene, const BakedImages& images)
      : scene_(scene), rewriting_(scene), edit_(scene.file, rewriting_.in_place) {
    const Json& root = scene.file.root;
    for (std::size_t m = 0; m < gltf::count_of(root, "meshes"); ++m) {
      const Json& primitives = gltf::element(root, "meshes", m)["primitives"];
      for (std::size_t p = 0; p < primitives.size(); ++p) {
        if (rewriting_.lit.contains({m, p}))
          baked_.texcoord = std::max(baked_.texcoord, texcoord_sets_of(primitives[p]));
        if (!rewriting_.in_place.contains({m, p}))
          used_without_light_.merge(materials_of(primitives[p]));
      }
    }
    // As they are without what is compressed.
    meshes_ = edit_.root().value("meshes", Json::array());
    add_images(images);
  }

  BakedDocument bake() {
    // Copies of one primitive follow one another: those of one place are gathered.
    for (std::size_t k = 0; k < scene_.primitives.size(); ++k)
      add_place(k);
    for (auto& [place, primitives] : places_)
      write_place(place, primitives);
    for (const std::string& node : expanded_)
      baked_.warnings.push_back(fmt::format("copies of EXT_mesh_gpu_instancing become nodes of their own: '{}'", node));
    baked_.binary = edit_.finish(baked_.warnings);
    baked_.root = std::move(edit_.root());
    return std::move(baked_);
  }

private:
  using Place = std::pair<std::size_t, std::size_t>; ///< node, and 1 + copy or 0

  void add_place(std::size_t k) {
    const gltf::PlacedPrimitive& primitive = scene_.primitives[k];
    places_[{primitive.file_node, primitive.copy ? *primitive.copy + 1 : 0}].push_back(k);
  }

  void add_images(const BakedImages& images) {
    texture_ = edit_.add_image(images.irradiance, "lightmap", images.extras);
    intensity_ = images.intensity;
    edit_.use_extension("MOZ_lightmap");
    if (images.shown.empty())
      return;
    shown_texture_ = edit_.add_image(images.shown, "baked", nullptr);
    const auto names = gltf::variant_names(scene_.file.root);
    baked_.variant = "baked";
    for (int k = 1; std::ranges::find(names, baked_.variant) != names.end(); ++k)
      baked_.variant = fmt::format("baked.{}", k);
    Json& variants = edit_.root()["extensions"]["KHR_materials_variants"]["variants"];
    variants.push_back({{"name", baked_.variant}});
    variant_ = variants.size() - 1;
    edit_.use_extension("KHR_materials_variants");
    edit_.use_extension("KHR_materials_unlit");
  }

  void write_place(const Place& place, const std::vector<std::size_t>& primitives) {
    const gltf::PlacedPrimitive& first = scene_.primitives[primitives.front()];
    const std::size_t mesh = mesh_for(first.mesh);
    for (const std::size_t k : primitives)
      if (rewriting_.lit.contains({first.mesh, scene_.primitives[k].number}))
        rewrite(edit_.root()["meshes"][mesh]["primitives"][scene_.primitives[k].number], k);
    if (place.second == 0)
      edit_.root()["nodes"][place.first]["mesh"] = mesh;
    else
      add_copy(first, mesh);
  }

  /// The mesh itself the first time, then another one like it.
  std::size_t mesh_for(std::size_t mesh) {
    if (!rewriting_.shown_elsewhere.contains(mesh) && placed_meshes_.insert(mesh).second)
      return mesh;
    edit_.root()["meshes"].push_back(meshes_[mesh]);
    return edit_.root()["meshes"].size() - 1;
  }

  void add_copy(const gltf::PlacedPrimitive& primitive, std::size_t mesh) {
    Json& nodes = edit_.root()["nodes"];
    const std::string name = gltf::text_or(nodes[primitive.file_node], "name", fmt::format("node{}", primitive.file_node));
    if (nodes[primitive.file_node].contains("mesh")) {
      nodes[primitive.file_node].erase("mesh");
      Json& extensions = nodes[primitive.file_node]["extensions"];
      extensions.erase("EXT_mesh_gpu_instancing");
      if (extensions.empty())
        nodes[primitive.file_node].erase("extensions");
      expanded_.push_back(name);
    }
    std::vector<double> matrix;
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row)
        matrix.push_back(row == 3 ? (column == 3 ? 1.0 : 0.0) : primitive.local[column][row]);
    nodes.push_back({{"name", fmt::format("{}.{}", name, *primitive.copy)}, {"mesh", mesh}, {"matrix", matrix}});
    const std::size_t child = nodes.size() - 1;
    nodes[primitive.file_node]["children"].push_back(child);
  }

  /// Vertices by chart: one of the file that is on several is there as often.
  struct SplitVertices {
    std::vector<std::uint32_t> indices, of_file;
    std::vector<glm::vec2> texcoords;
  };
  SplitVertices split(std::size_t k) const {
    SplitVertices split;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
    const auto& triangles = scene_.primitives[k].triangles;
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) {
        const ChartPoint& point = scene_.charts.corners[k][t][c];
        const auto [place, is_new] =
            known.emplace(std::pair(triangles[t][c], point.chart), static_cast<std::uint32_t>(split.of_file.size()));
        if (is_new) {
          split.of_file.push_back(triangles[t][c]);
          split.texcoords.push_back(texcoord_of(scene_.layout, point));
        }
        split.indices.push_back(place->second);
      }
    return split;
  }

  void rewrite(Json& primitive, std::size_t k) {
    const SplitVertices vertices = split(k);
    std::map<std::size_t, std::size_t> gathered;
    const auto gather = [&](Json& attributes) {
      for (auto& attribute : attributes.items()) {
        const std::size_t accessor = gltf::size_value(attribute.value());
        const auto [known, is_new] = gathered.emplace(accessor, 0);
        if (is_new)
          known->second = edit_.gathered(accessor, vertices.of_file);
        attribute.value() = known->second;
      }
    };
    const int sets = texcoord_sets_of(primitive);
    // The JSON is a part of the document that accessors are added to: it stays where it is.
    gather(primitive["attributes"]);
    if (primitive.contains("targets"))
      for (Json& target : primitive["targets"])
        gather(target);
    primitive["indices"] = edit_.add_indices(vertices.indices, vertices.of_file.size(), gltf::index_at(primitive, "indices"));
    primitive.erase("mode");
    const std::size_t texcoords = edit_.add_texcoords(vertices.texcoords);
    for (int set = sets; set <= baked_.texcoord; ++set)
      primitive["attributes"][fmt::format("TEXCOORD_{}", set)] = texcoords;
    set_materials(primitive, k);
  }

  const Material* material_in_scene(std::size_t k) const {
    for (const auto& corners : scene_.charts.corners[k])
      if (corners[0].chart != no_chart)
        return &material_of(scene_.field.scene->scene,
                            scene_.charts.charts[corners[0].chart].triangles.front());
    return nullptr;
  }

  void set_materials(Json& primitive, std::size_t k) {
    const auto own = gltf::index_at(primitive, "material");
    const auto with_light = lightmapped(own);
    if (with_light)
      primitive["material"] = *with_light;
    if (Json* mappings = mappings_of(primitive))
      for (Json& mapping : *mappings)
        if (const auto other = lightmapped(gltf::size_value(mapping["material"])))
          mapping["material"] = *other;
    const Material* material = material_in_scene(k);
    if (!shown_texture_ || !material || material->alpha_mode != AlphaMode::opaque || material->unlit ||
        is_mirror(*material) || is_glass(*material))
      return;
    primitive["extensions"]["KHR_materials_variants"]["mappings"].push_back(
        {{"material", unlit_material(material->double_sided)}, {"variants", Json::array({variant_})}});
  }

  static Json* mappings_of(Json& primitive) {
    return gltf::find(primitive, {"extensions", "KHR_materials_variants", "mappings"})
               ? &primitive["extensions"]["KHR_materials_variants"]["mappings"]
               : nullptr;
  }

  /// The material with the lightmap; none for one that takes no light.
  std::optional<std::size_t> lightmapped(std::optional<std::size_t> material) {
    const auto [known, is_new] = lightmapped_.emplace(material, std::nullopt);
    if (!is_new)
      return known->second;
    Json& materials = edit_.root()["materials"];
    if (material && gltf::find(materials[*material], {"extensions", "KHR_materials_unlit"}))
      return std::nullopt;
    std::size_t made = material.value_or(materials.size());
    if (!material || used_without_light_.contains(*material)) {
      made = materials.size();
      materials.push_back(material ? Json(materials[*material]) : Json::object());
    }
    materials[made]["extensions"]["MOZ_lightmap"] = {
        {"index", texture_}, {"texCoord", baked_.texcoord}, {"intensity", intensity_}};
    return known->second = made;
  }

  std::size_t unlit_material(bool double_sided) {
    std::optional<std::size_t>& made = unlit_[double_sided ? 1 : 0];
    if (made)
      return *made;
    Json material{{"name", double_sided ? "baked, both sides" : "baked"},
                  {"pbrMetallicRoughness",
                   {{"baseColorTexture", {{"index", *shown_texture_}, {"texCoord", baked_.texcoord}}},
                    {"metallicFactor", 0.0},
                    {"roughnessFactor", 1.0}}},
                  {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
    if (double_sided)
      material["doubleSided"] = true;
    Json& materials = edit_.root()["materials"];
    materials.push_back(std::move(material));
    made = materials.size() - 1;
    return *made;
  }

  const BakedScene& scene_;
  Rewriting rewriting_;
  DocumentEdit edit_;
  BakedDocument baked_;
  Json meshes_;
  std::set<std::size_t> used_without_light_, placed_meshes_;
  std::map<Place, std::vector<std::size_t>> places_;
  std::map<std::optional<std::size_t>, std::optional<std::size_t>> lightmapped_;
  std::array<std::optional<std::size_t>, 2> unlit_;
  std::vector<std::string> expanded_;
  std::size_t texture_ = 0, variant_ = 0;
  std::optional<std::size_t> shown_texture_;
  double intensity_ = 1.0;
};

} // namespace

BakedDocument baked_document(const BakedScene& scene, const BakedImages& images) {
  return Baker(scene, images).bake();
}

} // namespace meninas
