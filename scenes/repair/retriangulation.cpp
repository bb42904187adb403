#include "scenes/repair/retriangulation.h"

#include "scenes/repair/plane_mesh.h"
#include "scenes/sampling.h"
#include "scenes/materials/texture_lookup.h"
#include "scenes/surfaces/topology.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>

namespace meninas {
namespace {

constexpr double max_wanted_of_surface = 3.0; ///< of a surface's area
constexpr double worth_it = 0.6;    ///< of what it took before

/// What a patch takes, in units of an element's area.
double wanted_area(const Patch& patch) {
  const auto edge = [&](std::size_t a, std::size_t b) {
    return glm::distance(patch.corners[a], patch.corners[b]);
  };
  if (patch.corner_count == 3) {
    const double longest = std::max({edge(0, 1), edge(1, 2), edge(2, 0)});
    return 0.5 * longest * longest;
  }
  return std::max(edge(0, 1), edge(2, 3)) * std::max(edge(1, 2), edge(3, 0));
}

/// An affine function of the place in the plane.
struct Affine {
  glm::dvec4 at_origin{0.0}, along_x{0.0}, along_y{0.0};
  glm::dvec4 operator()(const Vec2& p) const { return at_origin + p.x * along_x + p.y * along_y; }
};

/// Through the values at three points that span the plane.
Affine affine_through(const std::array<Vec2, 3>& p, const std::array<glm::dvec4, 3>& value) {
  const Vec2 a = p[1] - p[0], b = p[2] - p[0];
  const double twice = a.x * b.y - a.y * b.x;
  const glm::dvec4 da = value[1] - value[0], db = value[2] - value[0];
  Affine affine;
  affine.along_x = (b.y * da - a.y * db) / twice;
  affine.along_y = (a.x * db - b.x * da) / twice;
  affine.at_origin = value[0] - p[0].x * affine.along_x - p[0].y * affine.along_y;
  return affine;
}

constexpr std::size_t tangent_part = 3;

/// What a vertex carries besides its place: texture coordinates, colour and tangent.
using Carried = std::array<glm::dvec4, 4>;
Carried carried_by(const Scene& scene, VertexId id) {
  const auto& [texcoord, color] = attributes_of(scene, id);
  const bool has_tangent = index(id) < scene.tangents.size();
  return {glm::dvec4(texcoord[0], 0.0, 0.0), glm::dvec4(texcoord[1], 0.0, 0.0), glm::dvec4(color),
          has_tangent ? glm::dvec4(scene.tangents[index(id)]) : glm::dvec4(0.0)};
}

/// A vertex that is added.
struct NewVertex {
  Point3 position{0.0};
  VertexAttributes attributes;
  glm::vec4 tangent{0.0F};
};

class Surgeon {
public:
  Surgeon(const Scene& scene, const Topology& topology, const SurfaceModel& model,
          const Surface& surface)
      : scene_(scene), topology_(topology), surface_(surface) {
    for (const PatchId id : surface.patches)
      for (const TriangleId triangle : model.patches[index(id)].triangles)
        if (triangle != none<TriangleId>)
          triangles_.push_back(triangle);
    std::ranges::sort(triangles_);
    origin_ = position(scene, scene.triangles[index(triangles_[0])].vertices[0]);
    frame_ = tangent_frame(surface.plane.normal);
  }

  /// The triangulation in the plane; none where the triangles do not make a surface.
  std::optional<PlaneMesh> mesh() {
    PlaneMesh mesh;
    for (const TriangleId id : triangles_) {
      const Triangle& triangle = scene_.triangles[index(id)];
      if (triangle.curved || triangle.node != scene_.triangles[index(triangles_[0])].node)
        return std::nullopt;
      PlaneTriangle flat;
      for (std::size_t k = 0; k < 3; ++k)
        flat.corners[k] = number_of(triangle.vertices[k], mesh);
      if (!(area_of(mesh, flat) > 0.0))
        return std::nullopt;
      mesh.triangles.push_back(flat);
    }
    return connect(mesh) ? std::optional(mesh) : std::nullopt;
  }

  /// Whether what vertices carry, as far as it is used, is affine over the surface.
  bool carries_affine(const PlaneMesh& mesh) {
    const Material& material = scene_.materials[index(surface_.material)];
    const bool framed = material.normal_texture || material.anisotropy > 0.0;
    const bool textures =
        is_textured(material) || framed || material.alpha_mode == AlphaMode::mask;
    const bool colours =
        std::ranges::any_of(triangles_, [&](TriangleId t) { return has_vertex_colors(scene_, t); });
    const auto largest = std::ranges::max_element(
        mesh.triangles, {}, [&](const PlaneTriangle& t) { return area_of(mesh, t); });
    const bool tangents = framed && !scene_.tangents.empty();
    const std::array used{textures, textures, colours, tangents};
    std::array<Vec2, 3> places;
    for (std::size_t k = 0; k < 3; ++k)
      places[k] = mesh.points[largest->corners[k]];
    for (std::size_t part = 0; part < used.size(); ++part) {
      std::array<glm::dvec4, 3> values;
      for (std::size_t k = 0; k < 3; ++k)
        values[k] = carried_by(scene_, vertices_[largest->corners[k]])[part];
      carried_[part] = affine_through(places, values);
      if (used[part] && !fits(mesh, part))
        return false;
    }
    return true;
  }

  /// The new triangles, and their new vertices behind those of the scene.
  std::vector<Triangle> replace(const PlaneMesh& mesh, std::vector<NewVertex>& added,
                                std::size_t vertices_before) {
    for (std::size_t p = vertices_.size(); p < mesh.points.size(); ++p) {
      vertices_.push_back(static_cast<VertexId>(vertices_before + added.size()));
      added.push_back(vertex_at(mesh.points[p]));
    }
    std::vector<Triangle> triangles;
    Triangle like = scene_.triangles[index(triangles_[0])];
    for (const PlaneTriangle& flat : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k)
        like.vertices[k] = vertices_[flat.corners[k]];
      triangles.push_back(like);
    }
    return triangles;
  }

  const std::vector<TriangleId>& triangles() const { return triangles_; }

private:
  static double area_of(const PlaneMesh& mesh, const PlaneTriangle& t) {
    const Vec2 a = mesh.points[t.corners[1]] - mesh.points[t.corners[0]];
    const Vec2 b = mesh.points[t.corners[2]] - mesh.points[t.corners[0]];
    return 0.5 * (a.x * b.y - a.y * b.x);
  }

  /// Vertices that stand at one place are one.
  std::uint32_t number_of(VertexId vertex, PlaneMesh& mesh) {
    const auto [found, is_new] = numbers_.try_emplace(
        index(topology_.welded[index(vertex)]), static_cast<std::uint32_t>(mesh.points.size()));
    if (is_new) {
      const Vec3 at = position(scene_, vertex) - origin_;
      mesh.points.emplace_back(glm::dot(at, frame_.tangent), glm::dot(at, frame_.bitangent));
      vertices_.push_back(vertex);
    }
    all_.emplace_back(vertex, found->second);
    return found->second;
  }

  /// Finds neighbours. False where more than two triangles share an edge, or two run along it one
  /// way.
  static bool connect(PlaneMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::uint32_t, std::size_t>> open;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      mesh.triangles[t].neighbours.fill(PlaneTriangle::outline);
      for (std::size_t k = 0; k < 3; ++k)
        if (!open.try_emplace(
                     {mesh.triangles[t].corners[k], mesh.triangles[t].corners[(k + 1) % 3]}, t, k)
                 .second)
          return false;
    }
    for (const auto& [edge, use] : open)
      if (const auto back = open.find({edge.second, edge.first}); back != open.end())
        mesh.triangles[use.first].neighbours[use.second] = back->second.first;
    // Two that share two edges are folded onto one another.
    return std::ranges::none_of(mesh.triangles, [](const PlaneTriangle& t) {
      const auto& n = t.neighbours;
      return (n[0] == n[1] && n[0] != PlaneTriangle::outline) ||
             (n[1] == n[2] && n[1] != PlaneTriangle::outline) ||
             (n[2] == n[0] && n[2] != PlaneTriangle::outline);
    });
  }

  bool fits(const PlaneMesh& mesh, std::size_t part) const {
    constexpr double close = 1e-4; // of the range: far less than a texel
    double range = part == tangent_part ? 1.0 : 0.0, worst = 0.0;
    const glm::dvec4 first = carried_by(scene_, vertices_[0])[part];
    for (const auto& [vertex, number] : all_) {
      const glm::dvec4 value = carried_by(scene_, vertex)[part];
      range = std::max(range, glm::length(value - first));
      worst = std::max(worst, glm::length(value - carried_[part](mesh.points[number])));
    }
    return worst <= close * range;
  }

  NewVertex vertex_at(const Vec2& p) const {
    NewVertex made;
    made.tangent = glm::vec4(carried_[tangent_part](p));
    const Point3 x = origin_ + p.x * frame_.tangent + p.y * frame_.bitangent;
    made.position = x - signed_distance(surface_.plane, x) * surface_.plane.normal;
    for (std::size_t k = 0; k < 2; ++k)
      made.attributes.texcoord[k] = glm::vec2(glm::dvec2(carried_[k](p)));
    made.attributes.color = glm::vec4(carried_[2](p));
    return made;
  }

  const Scene& scene_;
  const Topology& topology_;
  const Surface& surface_;
  std::vector<TriangleId> triangles_;
  Point3 origin_{0.0};
  TangentFrame frame_;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers_; ///< of points, by welded vertex
  std::vector<VertexId> vertices_;                           ///< by point
  std::vector<std::pair<VertexId, std::uint32_t>> all_;      ///< every corner, and its point
  std::array<Affine, 4> carried_;
};

double wanted_by(const SurfaceModel& model, const Surface& surface) {
  double wanted = 0.0;
  for (const PatchId id : surface.patches)
    wanted += wanted_area(model.patches[index(id)]);
  return wanted;
}

/// Mirrors and glass have no elements, and of lamps fewer patches are better.
bool is_meshed(const Material& material) {
  return !is_mirror(material) && !is_glass(material) && !is_emitter(material);
}

/// More vertices far away would change what counts as the detail of the scene (precision.h).
bool is_in_detail(const SurfaceModel& model, const Surface& surface) {
  return model.detail.is_all || std::ranges::all_of(surface.patches, [&](PatchId id) {
           return std::ranges::all_of(
               polygon_of(model.patches[index(id)]), [&](const Point3& corner) {
                 return glm::distance(corner, model.detail.centre) <= model.detail.radius;
               });
         });
}

/// The surfaces that take too much, in their order.
std::vector<SurfaceId> wasteful_surfaces(const Scene& scene, const SurfaceModel& model) {
  constexpr std::size_t few = 8;
  std::vector<SurfaceId> wasteful;
  for (std::size_t s = 0; s < model.surfaces.size(); ++s) {
    const Surface& surface = model.surfaces[s];
    if (surface.patches.size() >= few && is_meshed(scene.materials[index(surface.material)]) &&
        wanted_by(model, surface) > max_wanted_of_surface * surface.area && is_in_detail(model, surface))
      wasteful.push_back(static_cast<SurfaceId>(s));
  }
  return wasteful;
}

double wanted_by(const PlaneMesh& mesh) {
  double wanted = 0.0;
  for (const PlaneTriangle& triangle : mesh.triangles)
    wanted += wanted_area(mesh, triangle);
  return wanted;
}

} // namespace

bool retriangulate_slivers(Scene& scene, const SurfaceModel& model) {
  const std::vector<SurfaceId> wasteful = wasteful_surfaces(scene, model);
  if (wasteful.empty())
    return false;
  const Topology topology = find_topology(scene, Precision(scene));
  std::vector<NewVertex> added;
  std::vector<std::uint8_t> removed(scene.triangles.size(), 0);
  std::map<TriangleId, std::vector<Triangle>> replaced; ///< by the first one of their surface
  for (const SurfaceId id : wasteful) {
    const Surface& surface = model.surfaces[index(id)];
    Surgeon surgeon(scene, topology, model, surface);
    auto mesh = surgeon.mesh();
    if (!mesh || !surgeon.carries_affine(*mesh))
      continue;
    make_delaunay(*mesh);
    refine(*mesh, 4 * mesh->points.size() + 64);
    if (!(wanted_by(*mesh) < worth_it * wanted_by(model, surface)))
      continue;
    for (const TriangleId triangle : surgeon.triangles())
      removed[index(triangle)] = 1;
    replaced[surgeon.triangles()[0]] = surgeon.replace(*mesh, added, scene.vertices.size());
  }
  if (replaced.empty())
    return false;
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    if (const auto found = replaced.find(static_cast<TriangleId>(t)); found != replaced.end())
      triangles.insert(triangles.end(), found->second.begin(), found->second.end());
    else if (removed[t] == 0)
      triangles.push_back(scene.triangles[t]);
  }
  scene.triangles = std::move(triangles);
  if (!scene.tangents.empty())
    scene.tangents.resize(scene.vertices.size(), glm::vec4(0.0F));
  for (const NewVertex& made : added) {
    scene.vertices.push_back({.position = made.position});
    if (made.attributes != VertexAttributes{})
      own_attributes(scene, scene.vertices.back()) = made.attributes;
    if (!scene.tangents.empty())
      scene.tangents.push_back(made.tangent);
  }
  return true;
}

} // namespace meninas
