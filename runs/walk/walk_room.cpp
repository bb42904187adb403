#include "runs/walk/walk_room.h"

#include "radiosity/solution/element_triangles.h"
#include "radiosity/solution/scene_places.h"
#include "scenes/content_hash.h"
#include "scenes/materials/texture_lookup.h"
#include "scenes/shading_normal.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <tuple>
#include <unordered_map>

namespace meninas {

namespace {

using Corners = std::array<std::uint32_t, 3>;

/// Triangles that are drawn alike, as corners in the list of vertices, in fours and more or less to
/// an element.
struct Piece {
  WalkBatch key;
  std::vector<Corners> triangles;
  std::vector<std::uint32_t> ends; ///< of elements, in triangles
  std::vector<ElementId> elements;
};

auto order_of(const WalkBatch& b) {
  return std::tuple(b.section, b.colour, b.emission, b.mirror, b.node, b.shows_round);
}

/// One side of a patch.
struct Face {
  PatchId patch = none<PatchId>;
  Facing facing = Facing::front;
};

LightOrigin at_vertex(SideId side, const Point3& place, std::uint32_t vertex) {
  return {side, place, {vertex}, {1.0F}};
}

class RoomBuilder {
public:
  explicit RoomBuilder(const IrradianceField& field)
      : field_(field), light_(*field.scene), mesh_(field.mesh()) {
    const Bounds bounds = bounds_of(light_.scene);
    room_.middle = 0.5 * bounds.low + 0.5 * bounds.high;
  }

  WalkRoom build() {
    add_lit_faces();
    add_faces_without_field();
    std::stable_sort(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) {
      return order_of(a.key) < order_of(b.key);
    });
    for (const Piece& piece : pieces_)
      append(piece);
    add_lamps();
    return std::move(room_);
  }

private:
  /// The bytes of what makes a corner of a side differ from others at its vertex.
  using CornerKey = std::array<std::uint32_t, 14>;
  struct HashOfKey {
    std::size_t operator()(const CornerKey& key) const {
      return hash_of_bytes(std::as_bytes(std::span(key)));
    }
  };

  const Material& material_of_patch(const Patch& patch) const {
    return light_.scene.materials[index(patch.material)];
  }
  MirrorId mirror_of(const Face& face) const {
    const Patch& patch = light_.surfaces.patches[index(face.patch)];
    return light_.mirrors.mirror_of_surface[index(patch.surface)][index_of(face.facing)];
  }
  static std::size_t index_of(Facing facing) { return facing == Facing::front ? 0 : 1; }

  std::uint32_t look_of(const Face& face) {
    const Patch& patch = light_.surfaces.patches[index(face.patch)];
    const WalkFace kind = mirror_of(face) != none<MirrorId>             ? WalkFace::mirror
                          : is_mirror(material_of_patch(patch)) ? WalkFace::facet
                                                                        : WalkFace::plain;
    const std::uint32_t lamp =
        light_.lamp_groups ? lamp_of(*light_.lamp_groups, patch.node, patch.material) : no_lamp;
    const auto [place, is_new] =
        looks_.emplace(std::tuple(patch.material, kind, lamp), std::uint32_t(room_.looks.size()));
    if (is_new) {
      room_.looks.push_back(walk_look(light_.scene, light_.textures, patch.material, kind));
      room_.looks.back().lamp = lamp;
    }
    return place->second;
  }

  std::uint32_t black_look() {
    if (!black_) {
      black_ = static_cast<std::uint32_t>(room_.looks.size());
      room_.looks.emplace_back();
    }
    return *black_;
  }

  static TextureId texture_of(const std::optional<TextureUse>& use) {
    return use ? use->texture : none<TextureId>;
  }

  WalkBatch key_of(const Face& face, std::uint32_t look) const {
    const Patch& patch = light_.surfaces.patches[index(face.patch)];
    const Material& material = material_of_patch(patch);
    const WalkLook& shown = room_.looks[look];
    WalkBatch key;
    const bool passes = shown.kind == WalkKind::pane || shown.kind == WalkKind::covering ||
                        shown.kind == WalkKind::unlit_covering;
    key.section = passes ? WalkSection::pane
                  : material.double_sided || shown.cutoff >= 0.0 ? WalkSection::both
                                                                 : WalkSection::single;
    key.colour = texture_of(material.base_color_texture);
    key.emission = texture_of(material.emissive_texture);
    key.mirror = mirror_of(face);
    key.node = patch.node;
    key.shows_round = shown.kind >= WalkKind::curved;
    return key;
  }

  /// Colour, textures and normal of a face at a point of a triangle of the scene.
  void dress(WalkVertex& vertex, const Face& face, const ScenePlace& at) const {
    const Scene& scene = light_.scene;
    const Material& material = material_of(scene, at.triangle);
    vertex.colour_place = texture_place(scene, material.base_color_texture, at);
    vertex.emission_place = texture_place(scene, material.emissive_texture, at);
    vertex.colour = vertex_colour(scene, at);
    if (const WalkKind kind = room_.looks[vertex.look].kind;
        kind >= WalkKind::curved) {
      const glm::vec3 normal(shading_normal(scene, at.triangle, at.barycentric));
      vertex.normal = face.facing == Facing::front ? normal : -normal;
    }
  }

  glm::vec3 from_middle(const Point3& x) const { return glm::vec3(x - room_.middle); }

  /// The vertex with these values, once. `of` tells apart what is at different places; what a vertex
  /// mirrors is its own.
  std::uint32_t vertex_index(std::uint32_t of, MirrorId mirror, const WalkVertex& vertex,
                             const LightOrigin& origin = {}) {
    CornerKey key{of, vertex.look};
    const auto put = [&](std::size_t at, float x) { std::memcpy(&key[at], &x, sizeof x); };
    put(2, vertex.colour_place.x);
    put(3, vertex.colour_place.y);
    put(4, vertex.emission_place.x);
    put(5, vertex.emission_place.y);
    for (std::size_t k = 0; k < 3; ++k)
      key[6 + k] = static_cast<std::uint32_t>(
          static_cast<std::int32_t>(std::lround(1e3F * vertex.normal[static_cast<int>(k)])));
    for (std::size_t k = 0; k < 4; ++k)
      put(9 + k, vertex.colour[static_cast<int>(k)]);
    key[13] = static_cast<std::uint32_t>(mirror);
    const auto [place, is_new] =
        known_.emplace(key, static_cast<std::uint32_t>(room_.vertices.size()));
    if (is_new) {
      room_.vertices.push_back(vertex);
      room_.origins.push_back(origin);
    }
    return place->second;
  }

  /// A point of a side, and its own H there. `of` tells it from those at other places.
  std::uint32_t lit_vertex(std::uint32_t of, const LightOrigin& origin) {
    const MeshSide& side = mesh_.sides[index(origin.side)];
    WalkVertex vertex;
    vertex.look = look_of_side_[index(origin.side)];
    vertex.position = from_middle(origin.place);
    vertex.irradiance = irradiance_from(light_, field_, origin);
    const Face face{side.patch, side.facing};
    dress(vertex, face,
          place_on(light_.scene, light_.surfaces.patches[index(side.patch)], origin.place));
    return vertex_index(of, mirror_of(face), vertex, origin);
  }

  /// The corner of an element's triangle: a vertex of the mesh, or a point of a region's outline.
  std::uint32_t lit_corner(const ElementTriangles& all, SideId id, std::uint32_t v) {
    if (v < mesh_.vertices.size())
      return lit_vertex(v, at_vertex(id, mesh_.vertices[v], v));
    const RegionPoint& point = all.points[v - mesh_.vertices.size()];
    LightOrigin origin{.side = id, .place = point.position};
    for (std::size_t c = 0; c < 4; ++c) {
      origin.vertices[c] = index(mesh_.corners[index(point.element)][c]);
      origin.weights[c] = point.weights[c];
    }
    return lit_vertex(v, origin);
  }

  /// Whether the field, bilinear in a quad, is far from linear in two triangles: by its cross
  /// difference, a quarter of which is their error in its middle.
  bool is_bent(ElementId element) const {
    const ElementCorners& c = mesh_.corners[index(element)];
    if (c[3] == c[2] || region_of(mesh_, element) != nullptr)
      return false;
    const auto h = [&](std::size_t k) { return field_.irradiance[index(c[k])]; };
    const glm::vec3 cross = glm::abs(h(0) - h(1) + h(2) - h(3));
    constexpr float bound = 0.02F;
    return largest(cross) > bound * largest(h(0) + h(1) + h(2) + h(3));
  }

  /// Four triangles or more about the middle in place of a fan from a corner.
  void add_about_middle(const ElementTriangles& all, ElementId element,
                        std::span<const Corners> fan, std::vector<Corners>& to) {
    const ElementCorners& c = mesh_.corners[index(element)];
    const SideId id = mesh_.side_of_element[index(element)];
    LightOrigin origin{.side = id, .place = Point3(0.0), .weights = {0.25F, 0.25F, 0.25F, 0.25F}};
    for (std::size_t k = 0; k < 4; ++k) {
      origin.place += 0.25 * mesh_.vertices[index(c[k])];
      origin.vertices[k] = index(c[k]);
    }
    const auto number = static_cast<std::uint32_t>(mesh_.vertices.size() + all.points.size());
    const std::uint32_t middle = lit_vertex(number + index(element), origin);
    const Corners &first = fan.front(), &last = fan.back();
    if (mesh_.sides[index(id)].facing == Facing::front)
      to.insert(to.end(), {{middle, first[0], first[1]}, {middle, last[2], last[0]}});
    else
      to.insert(to.end(), {{middle, first[2], first[0]}, {middle, last[0], last[1]}});
    for (const Corners& triangle : fan)
      to.push_back({middle, triangle[1], triangle[2]});
  }

  void add_lit_faces() {
    const ElementTriangles all = element_triangles(mesh_);
    const auto piece_of_side = pieces_of_sides();
    std::vector<Corners> fan;
    for (std::size_t t = 0; t < all.elements.size();) {
      const ElementId element = all.elements[t];
      const SideId id = mesh_.side_of_element[index(element)];
      fan.clear();
      for (; t < all.elements.size() && all.elements[t] == element; ++t)
        fan.push_back({lit_corner(all, id, all.indices[3 * t]),
                       lit_corner(all, id, all.indices[3 * t + 1]),
                       lit_corner(all, id, all.indices[3 * t + 2])});
      Piece& piece = pieces_[piece_of_side[index(id)]];
      auto& triangles = piece.triangles;
      if (is_bent(element))
        add_about_middle(all, element, fan, triangles);
      else
        triangles.insert(triangles.end(), fan.begin(), fan.end());
      piece.ends.push_back(static_cast<std::uint32_t>(triangles.size()));
      piece.elements.push_back(element);
    }
    known_.clear();
  }

  std::vector<std::size_t> pieces_of_sides() {
    std::vector<std::size_t> pieces;
    for (const MeshSide& side : mesh_.sides) {
      const Face face{side.patch, side.facing};
      look_of_side_.push_back(look_of(face));
      pieces.push_back(pieces_.size());
      pieces_.push_back({key_of(face, look_of_side_.back()), {}, {}, {}});
    }
    return pieces;
  }

  void add_faces_without_field() {
    for (std::size_t p = 0; p < light_.surfaces.patches.size(); ++p) {
      const Patch& patch = light_.surfaces.patches[p];
      const Material& material = material_of_patch(patch);
      for (const Facing facing : {Facing::front, Facing::back}) {
        if ((facing == Facing::back && !material.double_sided) ||
            mesh_.sides_of_patch[p][index_of(facing)] != none<SideId>)
          continue;
        add_plain({static_cast<PatchId>(p), facing});
      }
    }
  }

  /// The triangles of the scene: a mirror, a pane, or black.
  void add_plain(const Face& face) {
    const Patch& patch = light_.surfaces.patches[index(face.patch)];
    const Material& material = material_of_patch(patch);
    const bool shows = is_mirror(material) || is_glass(material);
    const std::uint32_t look = shows ? look_of(face) : black_look();
    Piece piece{key_of(face, look), {}, {}, {none<ElementId>}};
    for (const TriangleId id : patch.triangles) {
      if (id == none<TriangleId>)
        continue;
      const auto p = corners(light_.scene, id);
      const auto& ids = light_.scene.triangles[index(id)].vertices;
      Corners triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        WalkVertex vertex;
        vertex.look = look;
        vertex.position = from_middle(p[k]);
        dress(vertex, face, {id, Vec2(k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0)});
        triangle[k] = vertex_index(index(ids[k]), piece.key.mirror, vertex);
      }
      if (face.facing == Facing::back)
        std::swap(triangle[1], triangle[2]);
      piece.triangles.push_back(triangle);
    }
    piece.ends.push_back(static_cast<std::uint32_t>(piece.triangles.size()));
    pieces_.push_back(std::move(piece));
  }

  void append(const Piece& piece) {
    if (piece.triangles.empty())
      return;
    const auto first = static_cast<std::uint32_t>(room_.indices.size() / 3);
    const auto count = static_cast<std::uint32_t>(piece.triangles.size());
    for (const Corners& triangle : piece.triangles)
      room_.indices.insert(room_.indices.end(), triangle.begin(), triangle.end());
    for (const std::uint32_t end : piece.ends)
      room_.element_ends.push_back(first + end);
    room_.elements.insert(room_.elements.end(), piece.elements.begin(), piece.elements.end());
    if (!room_.batches.empty() && order_of(room_.batches.back()) == order_of(piece.key)) {
      room_.batches.back().count += count;
      return;
    }
    room_.batches.push_back(piece.key);
    room_.batches.back().first = first;
    room_.batches.back().count = count;
  }

  /// The same mean of what each lamp sends.
  void add_lamps() {
    for (const VertexLightOfLamp& lamp : field_.by_lamp) {
      VertexIrradiance alone{.irradiance = lamp.direct, .mirrored = {}, .indirect = {}, .indirect_mirrored = {}};
      for (std::size_t v = 0; v < alone.irradiance.size(); ++v)
        alone.irradiance[v] += lamp.indirect[v];
      room_.irradiance_by_lamp.push_back(irradiance_from(light_, alone, room_.origins));
    }
  }

  const IrradianceField& field_;
  const LightScene& light_;
  const ElementMesh& mesh_;
  WalkRoom room_;
  std::vector<Piece> pieces_;
  std::vector<std::uint32_t> look_of_side_;
  std::map<std::tuple<MaterialId, WalkFace, std::uint32_t>, std::uint32_t> looks_;
  std::optional<std::uint32_t> black_;
  std::unordered_map<CornerKey, std::uint32_t, HashOfKey> known_;
};

} // namespace

WalkRoom walk_room(const IrradianceField& field) { return RoomBuilder(field).build(); }

std::vector<glm::vec3> irradiance_of(const WalkRoom& room) {
  std::vector<glm::vec3> irradiance;
  irradiance.reserve(room.vertices.size());
  for (const WalkVertex& vertex : room.vertices)
    irradiance.push_back(vertex.irradiance);
  return irradiance;
}

} // namespace meninas
