#include "radiosity/field/interpolation.h"

#include "radiosity/field/gathered_field.h"
#include "radiosity/mesh/subdivision.h"
#include "radiosity/field/vertex_places.h"

#include <algorithm>

namespace meninas {

namespace {

/// Mean of the elements around; at the border of a surface extrapolated from the elements behind:
/// twice the mean at the vertex less the mean one ring further in.
std::vector<glm::vec3> average_at_vertices(const ElementMesh& mesh,
                                           const std::vector<Rgb>& irradiance) {
  const VertexElements all = elements_around(mesh);
  std::vector<Rgb> mean(mesh.vertices.size(), Rgb(0.0));
  std::vector<Point3> centre(mesh.vertices.size(), Point3(0.0));
  for (std::size_t v = 0; v < mean.size(); ++v) {
    const auto elements = around(all, v);
    for (const ElementId element : elements) {
      mean[v] += irradiance[index(element)] / double(elements.size());
      centre[v] += centre_of(mesh, element) / double(elements.size());
    }
  }

  std::vector<glm::vec3> value(mean.begin(), mean.end());
  for (std::size_t v = 0; v < mean.size(); ++v) {
    // A vertex inside its surface lies at the centre of its elements;
    // on the border they all lie to one side.
    const Vec3 inward = centre[v] - mesh.vertices[v];
    const double reach = glm::length(inward);
    if (reach < 0.2 * size_of(mesh, mesh.element_of_vertex[v]) * 0.5)
      continue;

    // The corner of those elements that lies most straight inward carries the inner mean.
    double straightest = 0.0;
    std::size_t inner = v;
    for (const ElementId element : around(all, v))
      for (const auto corner : mesh.corners[index(element)]) {
        const Vec3 to = mesh.vertices[index(corner)] - mesh.vertices[v];
        const double cosine =
            index(corner) == v ? 0.0 : glm::dot(to, inward) / (glm::length(to) * reach);
        if (cosine > straightest) {
          straightest = cosine;
          inner = index(corner);
        }
      }
    const double further = glm::dot(centre[inner] - centre[v], inward) / reach;
    if (inner == v || further <= 0.25 * reach)
      continue;
    const double step = std::min(reach / further, 1.0);
    value[v] = glm::max(glm::vec3(mean[v] + step * (mean[v] - mean[inner])), glm::vec3(0.0F));
  }
  settle_hanging(mesh, value);
  return value;
}

} // namespace

/// The means of elements know nothing of mirrors;
/// what emitters send is known where it was computed as direct light.
static VertexIrradiance averaged_field(const ElementMesh& mesh, const ElementLight& elements) {
  VertexIrradiance field;
  field.irradiance = average_at_vertices(mesh, elements.irradiance);
  if (elements.direct.empty())
    return field;
  std::vector<Rgb> indirect = elements.irradiance;
  for (std::size_t e = 0; e < indirect.size(); ++e)
    indirect[e] -= elements.direct[e];
  field.indirect = average_at_vertices(mesh, indirect);
  return field;
}

InterpolatedField interpolate(const LightScene& light, const ElementLight& elements,
                              const FormFactorSettings& form_factors, const DirectSettings& direct,
                              const InterpolationSettings& settings, const Progress& progress) {
  if (settings.method == Interpolation::average)
    return {.field = averaged_field(light.mesh, elements)};
  return gathered_field(light, elements, form_factors, direct, settings, progress);
}

} // namespace meninas
