#include "radiosity/solution/viewer_colours.h"

#include "image/display.h"
#include "scenes/materials/lobes.h"
#include "scenes/materials/texture_lookup.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

std::vector<glm::vec3> with_points(const ElementMesh& mesh, const ShownFaces& faces,
                                   std::vector<glm::vec3> values) {
  for (const ShownPoint& point : faces.points) {
    glm::vec3 value(0.0F);
    for (std::size_t c = 0; c < 4; ++c)
      value += point.at.weights[c] * values[index(mesh.corners[index(point.at.element)][c])];
    values.push_back(value);
  }
  return values;
}

namespace {

/// tau H of the other side at a point of an element of a translucent surface, by its weights of the corners.
Rgb passed_at(const ElementMesh& mesh, const VertexIrradiance& field, ElementId element,
              const std::array<float, 4>& weights) {
  const SideId side = mesh.side_of_element[index(element)], behind = side_behind(mesh, side);
  if (behind == none<SideId>)
    return Rgb(0.0);
  const bool triangle = mesh.sides[index(side)].triangle;
  const std::array coordinates{Vec2(0.0), Vec2(1.0, 0.0), triangle ? Vec2(0.0, 1.0) : Vec2(1.0),
                               Vec2(0.0, 1.0)};
  Vec2 st(0.0);
  for (std::size_t c = 0; c < 4; ++c)
    st += double{weights[c]} * coordinates[c];
  return mesh.transmittance[index(element)] *
         Rgb(irradiance_at(mesh, field, behind, patch_uv_of(mesh, cell_of(mesh, element), st)));
}

/// At a vertex.
Rgb passed_at(const ElementMesh& mesh, const VertexIrradiance& field, ElementVertexId vertex) {
  const ElementId of = mesh.element_of_vertex[index(vertex)];
  std::array<float, 4> weights{};
  weights[static_cast<std::size_t>(std::ranges::find(mesh.corners[index(of)], vertex) -
                                   mesh.corners[index(of)].begin())] = 1.0F;
  return passed_at(mesh, field, of, weights);
}

/// B = E + rho H at a point without its texture, which a viewer multiplies it with, and what comes through.
Rgb dressed_radiosity(const LightScene& light, const ShownPoint& point, const glm::vec3& received,
                      const Rgb& passed) {
  const ElementMesh& mesh = light.mesh;
  const MeshSide& side = mesh.sides[index(mesh.side_of_element[index(point.at.element)])];
  const Material& material = light.scene.materials[index(side.material)];
  const Rgb colour(point.colour);
  if (material.unlit)
    return std::numbers::pi * material.base_color * colour;
  const bool textured = shown_texture(light.scene, material).has_value();
  // If the texture is not in the file, only the element's mean can be shown.
  const bool is_mean = !textured && is_textured(material);
  MaterialPoint whole = untextured(material);
  if (is_blended(material))
    whole.transmission = 0.0;
  const Rgb reflectance = is_mean ? mesh.reflectance[index(point.at.element)]
                                  : diffuse_reflectance(material, whole) * colour;
  // Alpha is the viewer's to weigh with.
  const double share = is_blended(material) && material.alpha > 0.0 ? material.alpha : 1.0;
  const Rgb emission = std::numbers::pi / share * material.emission;
  return emission + reflectance * Rgb(received) + passed;
}

/// B at the vertices and the points of pieces.
std::vector<Rgb> radiosities(const LightScene& light, const ShownFaces& faces,
                             const VertexIrradiance& field) {
  const ElementMesh& mesh = light.mesh;
  std::vector<Rgb> radiosity;
  const auto of_element = [&](ElementId of, const glm::vec3& received, const Rgb& passed) {
    const MeshSide& side = mesh.sides[index(mesh.side_of_element[index(of)])];
    if (light.scene.materials[index(side.material)].unlit)
      return std::numbers::pi * mesh.reflectance[index(of)];
    return mesh.emission[index(of)] + mesh.reflectance[index(of)] * Rgb(received) + passed;
  };
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    radiosity.push_back(of_element(mesh.element_of_vertex[v], field.irradiance[v],
                                   passed_at(mesh, field, ElementVertexId{v})));
  const std::vector<glm::vec3> irradiance = with_points(mesh, faces, field.irradiance);
  std::vector<std::uint8_t> dressed(faces.points.size(), 0);
  for (const ShownPiece& piece : faces.pieces)
    if (piece.dressed)
      for (const std::uint32_t v : piece.indices)
        dressed[v - mesh.vertices.size()] = 1;
  for (std::size_t p = 0; p < faces.points.size(); ++p) {
    const ShownPoint& point = faces.points[p];
    const glm::vec3& received = irradiance[mesh.vertices.size() + p];
    const Rgb passed = passed_at(mesh, field, point.at.element, point.at.weights);
    radiosity.push_back(dressed[p] ? dressed_radiosity(light, point, received, passed)
                                   : of_element(point.at.element, received, passed));
  }
  return radiosity;
}

/// So exposed that the brightest of what is well exposed is white.
double display_scale(std::span<const Rgb> radiosity) {
  Image all;
  all.pixels.reserve(radiosity.size());
  for (const Rgb& value : radiosity)
    all.pixels.emplace_back(value);
  all.width = static_cast<int>(all.pixels.size());
  all.height = 1;
  return std::exp2(automatic_exposure(all));
}

std::vector<glm::vec4> display_colours(const ElementMesh& mesh, const ShownFaces& faces,
                                       std::span<const Rgb> radiosity, double scale) {
  std::vector<glm::vec4> colours;
  for (std::size_t v = 0; v < radiosity.size(); ++v) {
    const bool is_vertex = v < mesh.vertices.size();
    const float alpha = is_vertex ? 1.0F : faces.points[v - mesh.vertices.size()].colour.a;
    colours.emplace_back(glm::clamp(scale * radiosity[v], Rgb(0.0), Rgb(1.0)),
                         std::clamp(alpha, 0.0F, 1.0F));
  }
  return colours;
}

} // namespace

ViewerColours viewer_colours(const LightScene& light, const ShownFaces& faces,
                             const VertexIrradiance& field) {
  const std::vector<Rgb> radiosity = radiosities(light, faces, field);
  const double scale = display_scale(radiosity);
  return {display_colours(light.mesh, faces, radiosity, scale), scale};
}

} // namespace meninas
