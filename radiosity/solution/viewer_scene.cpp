#include "radiosity/solution/viewer_scene.h"

#include "radiosity/solution/solution_format.h"
#include "radiosity/solution/viewer_colours.h"
#include "radiosity/solution/viewer_materials.h"

#include <algorithm>

namespace meninas {

namespace {

using nlohmann::json;

/// An array over points, `first` the number of the point that it begins with.
struct Attribute {
  const char* name;
  std::size_t view, size;
  const char* type;
  std::size_t first = 0;
};

json type_of(const Attribute& attribute) {
  return {{"componentType", gltf_float}, {"type", attribute.type}};
}

/// The points from the first to the last that a piece has.
struct Range {
  std::uint32_t first = 0, count = 0;
};

Range range_of(const ShownPiece& piece) {
  const auto [low, high] = std::ranges::minmax(piece.indices);
  return {low, high - low + 1};
}

class Writer {
public:
  Writer(GlbArrays& glb, const IrradianceField& field)
      : glb_(glb), light_(*field.scene), faces_(shown_faces(light_)), materials_(light_.scene) {
    const Bounds bounds = bounds_of(light_.scene);
    if (!light_.scene.vertices.empty())
      centre_ = 0.5 * bounds.low + 0.5 * bounds.high;
    add_lit_arrays(field);
    add_plain_arrays();
    add_indices();
  }

  ViewerScene write() {
    json root{{"scene", 0}};
    ViewerCameras cameras = viewer_cameras(light_.scene);
    if (!cameras.cameras.empty())
      root["cameras"] = std::move(cameras.cameras);
    nodes_ = std::move(cameras.nodes);
    json top = json::array();
    for (std::size_t k = 0; k <= nodes_.size(); ++k)
      top.push_back(k);
    root["scenes"] = json::array({{{"nodes", std::move(top)}}});
    add_room(root);
    root["nodes"] = std::move(nodes_);
    if (!faces_.pieces.empty())
      materials_.write(root, glb_);
    json field = json::object();
    for (const Attribute& a : lit_)
      if (*a.name == '_' && !lit_positions_.empty())
        field[a.name] = add_accessor(glb_, a.view, 0, lit_positions_.size(), type_of(a));
    return {std::move(root), std::move(field), scale_};
  }

private:
  void add_lit_arrays(const IrradianceField& field) {
    const ElementMesh& mesh = light_.mesh;
    for (const Point3& vertex : mesh.vertices)
      lit_positions_.emplace_back(vertex - centre_);
    std::vector<glm::vec2> places;
    for (const ShownPoint& point : faces_.points) {
      lit_positions_.emplace_back(point.at.position - centre_);
      places.push_back(point.texcoord);
    }
    if (lit_positions_.empty())
      return;
    const ViewerColours shown = viewer_colours(light_, faces_, field);
    scale_ = shown.scale;
    add(lit_, "POSITION", lit_positions_, "VEC3");
    add(lit_, "COLOR_0", shown.colours, "VEC4");
    for (const FieldPart& part : field_parts)
      if (!(field.*part.values).empty())
        add(lit_, part.attribute, with_points(mesh, faces_, field.*part.values), "VEC3");
    if (!places.empty()) {
      add(lit_, "TEXCOORD_0", places, "VEC2");
      lit_.back().first = mesh.vertices.size();
    }
  }

  void add_plain_arrays() {
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> places;
    for (const PlainPoint& point : faces_.plain) {
      plain_positions_.emplace_back(point.position - centre_);
      normals.push_back(point.normal);
      places.push_back(point.texcoord);
    }
    if (plain_positions_.empty())
      return;
    add(plain_, "POSITION", plain_positions_, "VEC3");
    add(plain_, "NORMAL", normals, "VEC3");
    add(plain_, "TEXCOORD_0", places, "VEC2");
  }

  template <typename Item>
  void add(std::vector<Attribute>& list, const char* name, const std::vector<Item>& items,
           const char* type) {
    list.push_back({name, add_view(glb_, items, false), sizeof(Item), type});
  }

  /// The indices of a piece count from the first point of its range.
  void add_indices() {
    std::vector<std::uint32_t> indices;
    for (const ShownPiece& piece : faces_.pieces) {
      starts_.push_back(sizeof(std::uint32_t) * indices.size());
      ranges_.push_back(range_of(piece));
      for (const std::uint32_t v : piece.indices)
        indices.push_back(v - ranges_.back().first);
    }
    if (!indices.empty())
      index_view_ = add_view(glb_, indices, true);
  }

  /// The node of the room, and below it one for each of the scene that shows something.
  void add_room(json& root) {
    const std::size_t room = nodes_.size();
    nodes_.push_back(
        {{"name", "radiosity"}, {"translation", {centre_.x, centre_.y, centre_.z}}});
    json children = json::array(), meshes = json::array();
    for (std::size_t p = 0; p < faces_.pieces.size(); ++p) {
      const NodeId node = faces_.pieces[p].node;
      if (p == 0 || faces_.pieces[p - 1].node != node) {
        const std::string name =
            node == none<NodeId> ? "" : light_.scene.nodes[index(node)].name;
        children.push_back(nodes_.size());
        nodes_.push_back({{"name", name}, {"mesh", meshes.size()}});
        meshes.push_back({{"name", name}, {"primitives", json::array()}});
      }
      meshes.back()["primitives"].push_back(primitive(p));
    }
    if (children.empty())
      return;
    nodes_[room]["children"] = std::move(children);
    root["meshes"] = std::move(meshes);
  }

  json primitive(std::size_t p) {
    const ShownPiece& piece = faces_.pieces[p];
    const bool lit = piece.shown_as == ShownAs::lit;
    const Range range = ranges_[p];
    const bool placed = shown_texture(light_.scene, light_.scene.materials[index(piece.material)])
                            .has_value();
    json attributes;
    for (const Attribute& a : lit ? lit_ : plain_) {
      const std::string_view name = a.name;
      if ((name == "TEXCOORD_0" && !placed) ||
          (name == "NORMAL" && piece.shown_as == ShownAs::dark))
        continue;
      json accessor = type_of(a);
      if (name == "POSITION")
        accessor.update(bounds_json(lit ? lit_positions_ : plain_positions_, range));
      attributes[a.name] =
          add_accessor(glb_, a.view, a.size * (range.first - a.first), range.count, accessor);
    }
    const std::size_t indices =
        add_accessor(glb_, index_view_, starts_[p], piece.indices.size(),
                     {{"componentType", gltf_unsigned_int}, {"type", "SCALAR"}});
    return {{"attributes", std::move(attributes)},
            {"indices", indices},
            {"material", materials_.add(piece)}};
  }

  static json bounds_json(const std::vector<glm::vec3>& points, const Range& range) {
    glm::vec3 low = points[range.first], high = low;
    for (std::uint32_t v = range.first; v < range.first + range.count; ++v) {
      low = glm::min(low, points[v]);
      high = glm::max(high, points[v]);
    }
    return {{"min", {low.x, low.y, low.z}}, {"max", {high.x, high.y, high.z}}};
  }

  GlbArrays& glb_;
  const LightScene& light_;
  const ShownFaces faces_;
  ViewerMaterials materials_;
  Point3 centre_{0.0};
  double scale_ = 1.0;
  std::vector<glm::vec3> lit_positions_, plain_positions_;
  std::vector<Attribute> lit_, plain_;
  std::vector<Range> ranges_;
  std::vector<std::size_t> starts_; ///< by piece, bytes in the view of indices
  std::size_t index_view_ = 0;
  json nodes_;
};

} // namespace

ViewerScene viewer_scene(GlbArrays& glb, const IrradianceField& field) {
  return Writer(glb, field).write();
}

} // namespace meninas
