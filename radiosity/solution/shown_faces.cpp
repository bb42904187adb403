#include "radiosity/solution/shown_faces.h"

#include "radiosity/solution/scene_places.h"
#include "scenes/shading_normal.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <tuple>

namespace meninas {

namespace {

bool is_png_or_jpeg(const Texture& texture) {
  const std::string_view text(reinterpret_cast<const char*>(texture.encoded.data()),
                              texture.encoded.size());
  return text.starts_with("\x89PNG") || text.starts_with("\xff\xd8\xff");
}

bool is_lobe(const Material& material) {
  if (material.unlit || is_blended(material) || is_emitter(material))
    return false;
  return is_mirror(material) || is_glass(material);
}

class Collector {
public:
  explicit Collector(const LightScene& light) : light_(light), mesh_(light.mesh) {}

  ShownFaces collect() {
    const ElementTriangles all = element_triangles(mesh_);
    collect_lit(all);
    for (auto& [key, lit] : lit_)
      finish_lit(all, lit);
    for (std::size_t p = 0; p < light_.surfaces.patches.size(); ++p)
      add_plain_faces(static_cast<PatchId>(p));
    std::stable_sort(shown_.pieces.begin(), shown_.pieces.end(),
                     [](const ShownPiece& a, const ShownPiece& b) {
                       return key_of(a) < key_of(b);
                     });
    return std::move(shown_);
  }

private:
  using Key = std::tuple<NodeId, MaterialId, ShownAs>;
  static Key key_of(const ShownPiece& piece) {
    return {piece.node, piece.material, piece.shown_as};
  }

  struct Lit {
    ShownPiece piece; ///< its indices those of ElementTriangles
    std::vector<ElementId> elements;
    bool has_points = false;
  };

  const Material& material_of_patch(const Patch& patch) const {
    return light_.scene.materials[index(patch.material)];
  }

  /// Whether the colour of a patch is not that of its elements' means.
  bool is_dressed(const Patch& patch) const {
    const Material& material = material_of_patch(patch);
    if (shown_texture(light_.scene, material) || material.alpha_mode != AlphaMode::opaque)
      return true;
    return std::ranges::any_of(patch.triangles, [&](TriangleId triangle) {
      return triangle != none<TriangleId> && has_vertex_colors(light_.scene, triangle);
    });
  }

  void collect_lit(const ElementTriangles& all) {
    for (std::size_t t = 0; t < all.elements.size(); ++t) {
      const MeshSide& side = mesh_.sides[index(mesh_.side_of_element[index(all.elements[t])])];
      const Patch& patch = light_.surfaces.patches[index(side.patch)];
      if (is_lobe(material_of_patch(patch)))
        continue;
      Lit& lit = lit_[{patch.node, patch.material, ShownAs::lit}];
      lit.piece.node = patch.node;
      lit.piece.material = patch.material;
      lit.piece.dressed = lit.piece.dressed || is_dressed(patch);
      lit.elements.push_back(all.elements[t]);
      for (std::size_t k = 3 * t; k < 3 * t + 3; ++k) {
        lit.piece.indices.push_back(all.indices[k]);
        lit.has_points = lit.has_points || all.indices[k] >= mesh_.vertices.size();
      }
    }
  }

  RegionPoint region_point(const ElementTriangles& all, ElementId element, std::uint32_t v) const {
    if (v >= mesh_.vertices.size())
      return all.points[v - mesh_.vertices.size()];
    RegionPoint point{mesh_.vertices[v], element, {}};
    const ElementCorners& corners = mesh_.corners[index(element)];
    if (const auto corner = std::ranges::find(corners, ElementVertexId{v});
        corner != corners.end()) {
      point.weights[std::size_t(corner - corners.begin())] = 1.0F;
      return point;
    }
    // It hangs in the middle of an edge: its value is that of an element that has it as a corner.
    point.element = mesh_.element_of_vertex[v];
    const ElementCorners& own = mesh_.corners[index(point.element)];
    point.weights[std::size_t(std::ranges::find(own, ElementVertexId{v}) - own.begin())] = 1.0F;
    return point;
  }

  /// Gives the piece points of its own, where it needs them.
  void finish_lit(const ElementTriangles& all, Lit& lit) {
    if (lit.piece.dressed || lit.has_points) {
      std::map<std::pair<std::uint32_t, PatchId>, std::uint32_t> known;
      for (std::size_t k = 0; k < lit.piece.indices.size(); ++k) {
        const ElementId element = lit.elements[k / 3];
        const PatchId patch = mesh_.sides[index(mesh_.side_of_element[index(element)])].patch;
        const auto next = std::uint32_t(mesh_.vertices.size() + shown_.points.size());
        const auto [place, is_new] = known.emplace(std::pair(lit.piece.indices[k], patch), next);
        if (is_new)
          shown_.points.push_back(
              shown_point(region_point(all, element, lit.piece.indices[k]), patch));
        lit.piece.indices[k] = place->second;
      }
    }
    shown_.pieces.push_back(std::move(lit.piece));
  }

  ShownPoint shown_point(const RegionPoint& at, PatchId id) const {
    const Patch& patch = light_.surfaces.patches[index(id)];
    const ScenePlace place = place_on(light_.scene, patch, at.position);
    return {at,
            texture_place(light_.scene, shown_texture(light_.scene, material_of_patch(patch)),
                          place),
            vertex_colour(light_.scene, place)};
  }

  /// Glass is there from both sides: its front stands for them.
  void add_plain_faces(PatchId id) {
    const Patch& patch = light_.surfaces.patches[index(id)];
    const Material& material = material_of_patch(patch);
    const bool lobe = is_lobe(material), once = lobe && is_glass(material);
    for (const Facing facing : {Facing::front, Facing::back}) {
      const bool has_side =
          mesh_.sides_of_patch[index(id)][std::size_t(facing)] != none<SideId>;
      const bool open = facing == Facing::back && (!material.double_sided || once);
      if (!open && (lobe || !has_side))
        add_plain(patch, facing, lobe ? ShownAs::lobe : ShownAs::dark);
    }
  }

  void add_plain(const Patch& patch, Facing facing, ShownAs shown_as) {
    const Key key{patch.node, patch.material, shown_as};
    const auto [place, is_new] = plain_.emplace(key, shown_.pieces.size());
    if (is_new)
      shown_.pieces.push_back({patch.node, patch.material, shown_as, false, {}});
    ShownPiece& piece = shown_.pieces[place->second];
    const std::optional<TextureUse>& texture =
        shown_texture(light_.scene, material_of_patch(patch));
    const bool back = facing == Facing::back;
    for (const TriangleId triangle : patch.triangles) {
      if (triangle == none<TriangleId>)
        continue;
      const auto at = corners(light_.scene, triangle);
      const auto normals = corner_normals(light_.scene, triangle);
      for (const std::size_t k : {std::size_t{0}, std::size_t{back ? 2U : 1U},
                                  std::size_t{back ? 1U : 2U}}) {
        const ScenePlace corner{triangle, Vec2(k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0)};
        piece.indices.push_back(static_cast<std::uint32_t>(shown_.plain.size()));
        shown_.plain.push_back({at[k], glm::vec3(back ? -normals[k] : normals[k]),
                                texture_place(light_.scene, texture, corner)});
      }
    }
  }

  const LightScene& light_;
  const ElementMesh& mesh_;
  ShownFaces shown_;
  std::map<Key, Lit> lit_;
  std::map<Key, std::size_t> plain_;
};

} // namespace

const std::optional<TextureUse>& shown_texture(const Scene& scene, const Material& material) {
  static const std::optional<TextureUse> nothing;
  const bool glows = is_emitter(material) && material.alpha_mode == AlphaMode::opaque;
  const auto& use =
      glows && material.emissive_texture ? material.emissive_texture : material.base_color_texture;
  const bool taken = use && is_png_or_jpeg(scene.textures[index(use->texture)]);
  return taken ? use : nothing;
}

ShownFaces shown_faces(const LightScene& light) { return Collector(light).collect(); }

} // namespace meninas
