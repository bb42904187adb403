#include "raytrace/views/seen_elements.h"

#include "radiosity/field/vertex_places.h"
#include "radiosity/scene/light_scene.h"
#include "raytrace/glossy_frustum.h"
#include "raytrace/views/sight.h"
#include "scenes/materials/normal_map.h"
#include "scenes/materials/refraction.h"
#include "scenes/sampling.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

constexpr double min_throughput = 0.02;
constexpr double max_paths = 1 << 19;
constexpr int max_legs = 32; ///< in a row

/// A leg of a path that is still to be followed.
struct Leg {
  Ray ray;
  Rgb throughput{1.0};
  int bounces = 0; ///< reflections
  int legs = 0;    ///< before it
  bool sight = true; ///< so far
  Backs backs = Backs::absorb;
};

/// The largest value that was given for each element, by any thread.
template <typename Value>
class Marks {
public:
  explicit Marks(std::size_t count) : marks_(count) {}
  void set(std::uint32_t element, Value value) {
    std::atomic<Value>& mark = marks_[element];
    for (Value now = mark.load(std::memory_order_relaxed);
         now < value && !mark.compare_exchange_weak(now, value, std::memory_order_relaxed);) {
    }
  }
  std::vector<Value> list() const { return {marks_.begin(), marks_.end()}; }

private:
  std::vector<std::atomic<Value>> marks_;
};

/// The seen elements, and the weight of the field's direct light.
struct SeenMarks {
  Marks<std::uint8_t> elements;
  Marks<float> direct;
  bool direct_at_sights; ///< is found for each pixel
};

/// Where a leg has met something.
struct Met {
  const LightScene& light;
  const Hit& hit;
  const FaceRecord& face;
  Direction along; ///< of the leg
};

/// The element that a leg meets, and that of the other side of what is translucent.
void mark(const Met& met, const Leg& leg, SeenMarks& seen) {
  if (met.face.side == FaceRecord::nothing)
    return;
  const TriangleId triangle = met.hit.triangle;
  const glm::vec2 b(met.hit.barycentric);
  const glm::vec2 uv = hit_uv(met.face, met.light.surfaces, index(triangle), b.x, b.y);
  const auto set = [&](std::uint32_t element) {
    seen.elements.set(element, 1);
    if (!leg.sight || !seen.direct_at_sights)
      seen.direct.set(element, static_cast<float>(std::min(largest(leg.throughput), 1.0)));
  };
  set(field_point(met.light.landing.elements, met.face.side, uv).element);
  if (const auto behind =
          place_behind(met.light, SideId{met.face.side}, triangle, met.hit.barycentric))
    set(field_point(met.light.landing.elements, behind->side, behind->uv).element);
}

/// The lobes of the surface, one direction each, by which it sends light to where the leg came from.
void continue_by_lobes(const Met& met, const Leg& leg, int max_bounces, Vec2 u,
                       std::vector<Leg>& legs) {
  const Material& material = material_of(met.light.scene, met.hit.triangle);
  if (!met.hit.front && !material.double_sided)
    return;
  const Bsdf front = make_bsdf(material, material_at(met.light.scene, met.light.textures,
                                                     met.hit.triangle, met.hit.barycentric));
  Bsdf bsdf = met.hit.front ? front : from_behind(front);
  const Direction normal = seen_normal(met.light, met.face, met.hit, met.along);
  const Direction out = local_out(normal, met.along);
  const SightStep step = leg.sight ? sight_step(met.light, met.face, met.hit) : SightStep::end;
  // Through glass nothing is reflected: backs that the eye looks through stay so, and it is no bounce.
  const auto go_on = [&](const Direction& towards, const Rgb& weight, bool through) {
    const Rgb throughput = leg.throughput * weight;
    const int bounces = leg.bounces + (through ? 0 : 1);
    if (largest(throughput) < min_throughput || bounces > max_bounces || leg.legs >= max_legs)
      return;
    const Point3 position = leg.ray.origin + met.hit.distance * leg.ray.direction;
    const auto goes = [&](const Direction& way) { return glm::dot(towards, way) > 1.0 - 1e-9; };
    const bool straight = through && goes(met.along);
    const bool mirrored = !through && goes(glm::reflect(met.along, normal));
    legs.push_back({{position, towards, static_cast<PlaneId>(met.face.plane_class)},
                    throughput,
                    bounces,
                    leg.legs + 1,
                    (straight && step == SightStep::through) ||
                        (mirrored && step == SightStep::mirror),
                    straight ? leg.backs : Backs::absorb});
  };
  if (is_open(bsdf)) {
    go_on(met.along, straight_transmission(bsdf, out.z), true);
    bsdf.glass = 0.0;
  }
  if (!has_round_facets(bsdf))
    bsdf.axis = facet_axis(met.light.scene, met.hit.triangle, met.hit.barycentric, bsdf.axis, normal);
  std::vector<LobeRay> rays;
  lobe_sample(bsdf, out, u, rays);
  for (const LobeRay& ray : rays)
    go_on(to_world(normal, ray.in), ray.weight, ray.through);
}

/// The path through one point of the picture, in all its branches.
void follow(const LightScene& light, const CameraRay& start, int max_bounces, std::uint32_t number,
            SeenMarks& seen) {
  std::vector<Leg> legs{{{start.origin, start.direction}, Rgb(1.0), 0, 0, true, Backs::transparent}};
  for (std::uint32_t k = 0; !legs.empty(); ++k) {
    const Leg leg = legs.back();
    legs.pop_back();
    const auto hit = closest_hit(light.rays, leg.ray, leg.backs);
    if (!hit)
      continue;
    const std::size_t face = 2 * std::size_t{index(hit->triangle)} + (hit->front ? 0 : 1);
    const Met met{light, *hit, light.landing.faces[face], leg.ray.direction};
    mark(met, leg, seen);
    const auto u = sobol4(number, hash(k, 0x5ee2));
    continue_by_lobes(met, leg, max_bounces, {u[0], u[1]}, legs);
  }
}

/// The largest mark of an element and of all that share a vertex with it.
template <typename Value>
std::vector<Value> with_neighbours(const ElementMesh& mesh, const VertexElements& around,
                                   const std::vector<Value>& marks) {
  std::vector<Value> more = marks;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto elements = meninas::around(around, static_cast<std::uint32_t>(v));
    Value most{};
    for (const ElementId e : elements)
      most = std::max(most, marks[index(e)]);
    for (const ElementId e : elements)
      more[index(e)] = std::max(more[index(e)], most);
  }
  return more;
}

} // namespace

SeenElements seen_elements(const LightScene& light, const Camera& camera,
                           const RenderSettings& settings) {
  const double pixels = double(settings.width) * settings.height;
  const double apart = std::max(1.0, std::sqrt(pixels / max_paths));
  const auto columns = static_cast<std::uint32_t>(std::ceil(settings.width / apart));
  const auto rows = static_cast<std::uint32_t>(std::ceil(settings.height / apart));
  const std::size_t count = element_count(light.mesh);
  SeenMarks marks{Marks<std::uint8_t>(count), Marks<float>(count), settings.diffuse.term == DiffuseTerm::direct};
  tbb::parallel_for(std::uint32_t{0}, rows, [&](std::uint32_t row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t number = row * columns + column;
      const auto u = sobol4(number, 0x1e45);
      const double radius = std::sqrt(double{u[0]}), turn = 2.0 * std::numbers::pi * u[1];
      const CameraRay start =
          camera_ray(camera, double(settings.width) / settings.height,
                     std::min((column + double{u[2]}) * apart / settings.width, 1.0),
                     std::min((row + double{u[3]}) * apart / settings.height, 1.0),
                     radius * Vec2(std::cos(turn), std::sin(turn)));
      follow(light, start, settings.max_bounces, number, marks);
    }
  });

  // Elements beside those that are met fill the rest of the pixels.
  const VertexElements around = elements_around(light.mesh);
  return {with_neighbours(light.mesh, around, marks.elements.list()),
          with_neighbours(light.mesh, around, marks.direct.list())};
}

} // namespace meninas
