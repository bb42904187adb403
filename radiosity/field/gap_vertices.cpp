#include "radiosity/field/gap_vertices.h"

#include "scenes/rays/frame_geometry.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <bit>
#include <map>

namespace meninas {

namespace {

constexpr double max_points = 4.0; ///< that gather in an element

struct GapSum {
  GapLight light;
  double count = 0.0;

  void add(const GapLight& other) {
    light.irradiance = light.irradiance + other.irradiance;
    light.indirect = light.indirect + other.indirect;
    ++count;
  }
  GapLight mean() const {
    const auto share = [&](const ArrivingLight& sum) {
      return ArrivingLight{sum.total / count, sum.mirrored / count};
    };
    return {share(light.irradiance), share(light.indirect)};
  }
};

/// The k-th of the points that stand for an element, by its corners;
/// a triangle has its third twice.
Point3 point_in(const ElementMesh& mesh, ElementId element, std::uint32_t k) {
  const auto sample = sobol4(k, 0x6a9);
  if (const RegionElement* region = region_of(mesh, element)) {
    ReceiverArea area;
    area.region = region;
    return point_in_region(area, Vec2(sample[0], sample[1]));
  }
  const auto at = [&](std::size_t c) {
    return mesh.vertices[index(mesh.corners[index(element)][c])];
  };
  const double s = sample[0], t = sample[1];
  return glm::mix(glm::mix(at(0), at(1), s), glm::mix(at(3), at(2), s), t);
}

/// Whether what a ray has met is lit, or shows something that may be: nothing at all, too.
bool meets_light(const PointGathering& gathering, const std::vector<Rgb>& irradiance,
                 const HitPacket& hits, std::uint32_t k) {
  const LightScene& light = gathering.light;
  if (hits.triangle[k] == index(none<TriangleId>))
    return true;
  const FaceRecord& face = light.landing.faces[2 * hits.triangle[k] + (hits.front[k] != 0 ? 0 : 1)];
  if (face.side == FaceRecord::nothing)
    return face.mirrors;
  const glm::vec2 uv = hit_uv(face, light.surfaces, hits.triangle[k], hits.b1[k], hits.b2[k]);
  return irradiance[land(light.landing.elements, face.side, uv).element] != Rgb(0.0);
}

/// The points of an element from which the ray along the normal meets light, as bits.
std::uint32_t points_that_see_light(const PointGathering& gathering,
                                    const std::vector<Rgb>& irradiance, const ElementMesh& mesh,
                                    ElementId element, PointWorkspace& work) {
  const MeshSide& side = mesh.sides[index(mesh.side_of_element[index(element)])];
  const RayScene& rays = gathering.light.rays;
  RayPacket packet;
  HitPacket hits;
  packet.count = packet_size;
  for (std::uint32_t k = 0; k < packet_size; ++k)
    set_ray(packet, k, glm::vec3(to_frame(rays.frame(), point_in(mesh, element, k))),
            glm::vec3(side.normal), index(side.plane_class));
  closest_hits(rays, packet, hits, Backs::absorb, Coherence::coherent);
  work.rays += packet_size;
  std::uint32_t lit = 0;
  for (std::uint32_t k = 0; k < packet_size; ++k)
    lit |= meets_light(gathering, irradiance, hits, k) ? 1U << k : 0U;
  return lit;
}

} // namespace

std::optional<GapLight> light_in_gap(const PointGathering& gathering,
                                     const std::vector<Rgb>& irradiance, const ElementMesh& mesh,
                                     ElementId element, PointWorkspace& work) {
  const MeshSide& side = mesh.sides[index(mesh.side_of_element[index(element)])];
  const double size = size_of(mesh, element);
  GapSum open, low;
  for (std::uint32_t lit = points_that_see_light(gathering, irradiance, mesh, element, work);
       lit != 0 && open.count < max_points; lit &= lit - 1) {
    const auto k = static_cast<std::uint32_t>(std::countr_zero(lit));
    const Receiver receiver{point_in(mesh, element, k), side.normal, side.plane_class, side.tangent,
                            side.coat};
    if (low.count >= max_points && is_under_something(gathering.light, receiver, size))
      continue;
    const std::uint32_t seed = hash(index(element), k, gathering.form_factors.seed);
    const VertexValue value = value_at(gathering, irradiance, {receiver, size, seed}, work);
    // Where the one arrives at nothing but the void, so do the others.
    if (value.irradiance.total == Rgb(0.0) && value.clearance != Clearance::low)
      break;
    if (value.clearance != Clearance::enclosed)
      (value.clearance == Clearance::open ? open : low).add({value.irradiance, value.indirect});
  }
  // Points under a low cover count where none is open.
  const GapSum& sum = open.count > 0.0 ? open : low;
  return sum.count > 0.0 ? std::optional(sum.mean()) : std::nullopt;
}

std::vector<ElementId> covered_elements(const ElementMesh& mesh,
                                        std::span<const std::uint8_t> valid) {
  std::vector<ElementId> covered;
  for (std::uint32_t e = 0; e < element_count(mesh); ++e)
    if (std::ranges::all_of(mesh.corners[e],
                            [&](ElementVertexId v) { return valid[index(v)] == 0; }))
      covered.push_back(static_cast<ElementId>(e));
  return covered;
}

void take_from_gaps(const ElementMesh& mesh, std::span<const ElementId> elements,
                    std::span<const std::optional<GapLight>> lights,
                    std::vector<std::uint8_t>& valid, VertexIrradiance& field) {
  std::map<std::uint32_t, GapSum> sums;
  for (std::size_t k = 0; k < elements.size(); ++k)
    if (lights[k])
      for (const ElementVertexId v : mesh.corners[index(elements[k])])
        sums[index(v)].add(*lights[k]);
  for (const auto& [v, sum] : sums) {
    const GapLight light = sum.mean();
    field.irradiance[v] = glm::vec3(light.irradiance.total);
    field.mirrored[v] = glm::vec3(light.irradiance.mirrored);
    field.indirect[v] = glm::vec3(light.indirect.total);
    field.indirect_mirrored[v] = glm::vec3(light.indirect.mirrored);
    valid[v] = 1;
  }
}

} // namespace meninas
