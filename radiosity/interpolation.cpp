#include "radiosity/interpolation.h"

#include "radiosity/mesh_division.h"
#include "radiosity/point_gathering.h"
#include "radiosity/vertex_fill.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>

namespace meninas {

namespace {

Point3 centre_of(const ElementMesh& mesh, ElementId element) {
  const auto& corners = mesh.corners[index(element)];
  const int count = corners[3] == corners[2] ? 3 : 4;
  Point3 sum(0.0);
  for (int c = 0; c < count; ++c)
    sum += mesh.vertices[index(corners[static_cast<std::size_t>(c)])];
  return sum / double(count);
}

/// The elements around every vertex, in one list.
struct VertexElements {
  std::vector<std::uint32_t> begin; ///< vertices + 1
  std::vector<ElementId> elements;
};

VertexElements elements_around(const ElementMesh& mesh) {
  VertexElements around;
  around.begin.assign(mesh.vertices.size() + 1, 0);
  const auto for_each_corner = [&mesh](auto&& visit) {
    for (std::size_t e = 0; e < mesh.corners.size(); ++e) {
      const auto& corners = mesh.corners[e];
      for (std::size_t c = 0; c < (corners[3] == corners[2] ? 3U : 4U); ++c)
        visit(static_cast<ElementId>(e), corners[c]);
    }
  };
  for_each_corner([&](ElementId, ElementVertexId vertex) { ++around.begin[index(vertex) + 1]; });
  for (std::size_t v = 1; v < around.begin.size(); ++v)
    around.begin[v] += around.begin[v - 1];
  around.elements.resize(around.begin.back());
  auto place = around.begin;
  for_each_corner([&](ElementId element, ElementVertexId vertex) {
    around.elements[place[index(vertex)]++] = element;
  });
  return around;
}

std::span<const ElementId> around(const VertexElements& all, std::size_t vertex) {
  return std::span(all.elements)
      .subspan(all.begin[vertex], all.begin[vertex + 1] - all.begin[vertex]);
}

/// Mean of the elements around; at the border of a surface extrapolated from the elements behind: twice the mean at the
/// vertex less the mean one ring further in.
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
    // A vertex inside its surface lies at the centre of its elements; on the border they all lie to one side.
    const Vec3 inward = centre[v] - mesh.vertices[v];
    const double reach = glm::length(inward);
    if (reach < 0.2 * size_of(mesh, mesh.element_of_vertex[v]) * 0.5)
      continue;

    // Of the corners of those elements the one most straight inward carries the inner mean.
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

/// Where a vertex gathers: drawn a little towards the middle of one of its elements, so that it is inside its own surface and
/// not in the wall that stands on its edge.
Point3 gathering_point(const ElementMesh& mesh, const VertexElements& all, std::size_t vertex) {
  constexpr double inset = 0.02;
  const auto elements = around(all, vertex);
  Point3 centre(0.0);
  for (const ElementId element : elements)
    centre += centre_of(mesh, element) / double(elements.size());
  return glm::mix(mesh.vertices[vertex], centre, inset);
}

struct VertexValue {
  ArrivingLight irradiance;
  ArrivingLight indirect; ///< the part of it that does not come from the source
  bool covered;           ///< something stands on it: no value of its own
};

/// Whether something lies on the surface here: nearly all of the hemisphere is blocked within a fraction of an element, as under
/// a box that stands on a floor. What little light there is there must not be interpolated out into the open.
bool is_under_something(const LightScene& light, const Receiver& receiver, double element_size) {
  constexpr double reach = 0.35; // of an element
  constexpr int least = packet_size - 1;
  const TangentFrame frame = frame_along(receiver.normal, receiver.tangent);
  const RayFrame& ray_frame = light.rays.frame();
  const glm::vec3 origin = (receiver.position - ray_frame.centre) * ray_frame.scale;
  RayPacket packet;
  packet.count = packet_size;
  for (std::uint32_t k = 0; k < packet_size; ++k) {
    const auto sample = sobol4(k, 0xc0fe);
    const glm::vec3 local = cosine_hemisphere(sample[0], sample[1]);
    const glm::vec3 direction = double{local.x} * frame.tangent +
                                double{local.y} * frame.bitangent +
                                double{local.z} * receiver.normal;
    packet.origin_x[k] = origin.x;
    packet.origin_y[k] = origin.y;
    packet.origin_z[k] = origin.z;
    packet.direction_x[k] = direction.x;
    packet.direction_y[k] = direction.y;
    packet.direction_z[k] = direction.z;
    packet.max_distance[k] =
        static_cast<float>(reach * element_size * ray_frame.scale);
    packet.leaving[k] = index(receiver.plane_class);
    packet.arriving[k] = index(none<PlaneId>);
  }
  return std::popcount(occluded(light.rays, packet, Coherence::coherent)) >= least;
}

/// `irradiance` by ElementId tells which elements are lit.
VertexValue value_at(const PointGathering& gathering, const std::vector<Rgb>& irradiance,
                     const Receiver& receiver, double element_size, std::uint32_t seed,
                     PointWorkspace& work) {
  constexpr double most_black =
      0.9; // of the hemisphere: the vertex is inside something that stands on its surface
  const PointLight arrived = light_at(gathering, receiver, seed, work);
  const GatheredRays& gathered = work.gather.result;
  const auto lit = [&](const RayLanding& landing) {
    return irradiance[landing.element] != Rgb(0.0);
  };
  const bool enclosed =
      gathered.black > most_black * gathered.rays ||
      (!gathered.landings.empty() && std::ranges::none_of(gathered.landings, lit));
  const bool covered = (enclosed && arrived.from_source.total == Rgb(0.0)) ||
                       is_under_something(gathering.light, receiver, element_size);
  return {arrived.all(), arrived.indirect(), covered};
}

} // namespace

static InterpolatedField
gather_at_vertices(const LightScene& light, const ElementLight& elements,
                   const FormFactorSettings& form_factors, const DirectSettings& direct,
                   const InterpolationSettings& settings) {
  constexpr std::size_t chunk_size = 64;
  const ElementMesh& mesh = light.mesh;
  const VertexElements all = elements_around(mesh);
  const PointGathering gathering(
      light, elements.reflected, form_factors, direct,
      {.rays = settings.rays, .cluster_shadow_rays = settings.cluster_shadow_rays});

  InterpolatedField result;
  DiffuseField& field = result.field;
  field.irradiance.assign(mesh.vertices.size(), glm::vec3(0.0F));
  field.mirrored = field.indirect = field.indirect_mirrored = field.irradiance;
  std::vector<std::uint8_t> valid(mesh.vertices.size(), 1);
  tbb::enumerable_thread_specific<PointWorkspace> workspaces;
  tbb::parallel_for(
      std::size_t{0}, (mesh.vertices.size() + chunk_size - 1) / chunk_size, [&](std::size_t c) {
        PointWorkspace& work = workspaces.local();
        for (std::size_t v = c * chunk_size;
             v < std::min(mesh.vertices.size(), (c + 1) * chunk_size); ++v) {
          const MeshSide& side =
              mesh.sides[index(mesh.side_of_element[index(mesh.element_of_vertex[v])])];
          const Receiver receiver{gathering_point(mesh, all, v), side.normal, side.plane_class,
                                  side.tangent};
          const VertexValue value =
              value_at(gathering, elements.irradiance, receiver,
                       size_of(mesh, mesh.element_of_vertex[v]),
                       hash(static_cast<std::uint32_t>(v), form_factors.seed, 0x7e27), work);
          field.irradiance[v] = glm::vec3(value.irradiance.total);
          field.mirrored[v] = glm::vec3(value.irradiance.mirrored);
          field.indirect[v] = glm::vec3(value.indirect.total);
          field.indirect_mirrored[v] = glm::vec3(value.indirect.mirrored);
          valid[v] = value.covered ? 0 : 1;
        }
      });
  for (const auto& work : workspaces) {
    result.form_factor_rays += work.rays;
    result.shadow_rays += work.direct.shadow_rays;
  }
  for (auto* values :
       {&field.irradiance, &field.mirrored, &field.indirect, &field.indirect_mirrored}) {
    fill_vertices(mesh, valid, *values);
    settle_hanging(mesh, *values);
  }
  return result;
}

/// The means of elements know nothing of mirrors; what emitters send is known where it was found from the source.
static DiffuseField averaged_field(const ElementMesh& mesh, const ElementLight& elements) {
  DiffuseField field;
  field.irradiance = average_at_vertices(mesh, elements.irradiance);
  if (elements.from_source.empty())
    return field;
  std::vector<Rgb> indirect = elements.irradiance;
  for (std::size_t e = 0; e < indirect.size(); ++e)
    indirect[e] -= elements.from_source[e];
  field.indirect = average_at_vertices(mesh, indirect);
  return field;
}

InterpolatedField interpolate(const LightScene& light, const ElementLight& elements,
                              const FormFactorSettings& form_factors, const DirectSettings& direct,
                              const InterpolationSettings& settings) {
  if (settings.method == Interpolation::average)
    return {averaged_field(light.mesh, elements), 0, 0};
  return gather_at_vertices(light, elements, form_factors, direct, settings);
}

glm::vec3 irradiance_at(const ElementMesh& mesh, const DiffuseField& field, SideId side, Vec2 uv) {
  const ElementPoint at = locate(mesh, side, uv);
  const auto& corners = mesh.corners[index(at.element)];
  const auto value = [&](int c) {
    return field.irradiance[index(corners[static_cast<std::size_t>(c)])];
  };
  const auto s = static_cast<float>(at.st.x), t = static_cast<float>(at.st.y);
  if (mesh.sides[index(side)].triangle)
    return (1.0F - s - t) * value(0) + s * value(1) + t * value(2);
  return (1.0F - t) * ((1.0F - s) * value(0) + s * value(1)) +
         t * ((1.0F - s) * value(3) + s * value(2));
}

} // namespace meninas
