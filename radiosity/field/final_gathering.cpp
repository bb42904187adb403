#include "radiosity/field/final_gathering.h"

#include "radiosity/field/contact_vertices.h"
#include "radiosity/field/curves/curved_vertices.h"
#include "radiosity/field/emission_kernels.h"
#include "radiosity/field/curves/smoothing_groups.h"
#include "radiosity/field/gap_vertices.h"
#include "radiosity/mesh/subdivision.h"
#include "radiosity/field/penumbra_resampling.h"
#include "radiosity/field/vertex_fill.h"
#include "radiosity/field/vertex_light.h"
#include "scenes/sampling.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

namespace meninas {

namespace {

template <typename Change>
void for_each_array(VertexIrradiance& field, const Change& change) {
  for (auto* values :
       {&field.irradiance, &field.mirrored, &field.indirect, &field.indirect_mirrored})
    change(*values);
}

/// Adds direct light to that of the lamps at a vertex, and sets indirect light.
void take_by_lamp(const PointWorkspace& work, std::size_t v, VertexIrradiance& field) {
  for (std::size_t l = 0; l < field.by_lamp.size(); ++l) {
    if (!work.direct_by_lamp.empty())
      field.by_lamp[l].direct[v] += glm::vec3(work.direct_by_lamp[l]);
    field.by_lamp[l].indirect[v] =
        work.indirect_by_lamp.empty() ? glm::vec3(0.0F) : glm::vec3(work.indirect_by_lamp[l]);
  }
}

} // namespace

VertexSamples make_samples(ElementMesh mesh) {
  VertexSamples found;
  found.mesh = std::move(mesh);
  found.around = elements_around(found.mesh);
  found.receivers = vertex_receivers(found.mesh, found.around);
  const std::size_t count = found.mesh.vertices.size();
  found.states.assign(count, VertexState::unknown);
  found.seen.assign(count, Visibility::uniform);
  for_each_array(found.field, [&](auto& values) { values.assign(count, glm::vec3(0.0F)); });
  return found;
}

void make_room_for_lamps(const LightScene& light, VertexSamples& found) {
  const std::vector<glm::vec3> dark(found.mesh.vertices.size(), glm::vec3(0.0F));
  found.field.by_lamp.assign(light.lamps.count, {dark, dark});
}

VertexSamples make_samples(const LightScene& light, const VertexElements& facets) {
  VertexSamples found = make_samples(light.mesh);
  receive_on_curves(light, found);
  make_room_for_lamps(light, found);
  for (std::size_t v = 0; v < found.states.size(); ++v)
    if (is_averaged(facets, v))
      found.states[v] = VertexState::smoothed;
  return found;
}

PointGathering gathering_from(const LightScene& light, SentLight reflected,
                              const VertexGathering& how, RayShare share, double spared,
                              std::optional<RayShare> before) {
  const auto rays_of = [asked = how.interpolation.rays](RayShare of) {
    return of.times * std::max(std::min(asked, 128), asked / of.part);
  };
  DirectSettings direct = how.direct;
  direct.penumbra_samples = PenumbraSamples::together;
  return {light,
          std::move(reflected),
          how.form_factors,
          direct,
          {.rays = rays_of(share),
           .rays_before = before ? rays_of(*before) : 0,
           .cluster_shadow_rays = std::max(1, how.interpolation.cluster_shadow_rays / share.part),
           .clusters_spared = spared}};
}

namespace {

/// Whether a vertex is open that has direct light alone, as few rays tell.
bool is_open_so_far(const VertexSource& source, const VertexSamples& found, std::uint32_t v) {
  const PointGathering& gathering = source.gathering;
  const Receiver& receiver = found.receivers[v];
  const double size = size_of(found.mesh, found.mesh.element_of_vertex[v]);
  if (found.field.irradiance[v] != glm::vec3(0.0F))
    return !is_under_something(gathering.light, receiver, size);
  return clearance_of_unlit(gathering.light, gathering.form_factors, receiver, size,
                           hash(v, gathering.form_factors.seed, 0xc07e),
                           source.workspaces.local()) == Clearance::open;
}

/// Whether any corner of the elements around a vertex is open. Hanging corners do not count.
bool has_open_beside(const VertexSource& source, const VertexSamples& found, std::uint32_t vertex) {
  const auto is_open = [&](ElementVertexId v) {
    switch (found.states[index(v)]) {
    case VertexState::smoothed:
    case VertexState::gathered:
      return true;
    case VertexState::direct_only:
      return is_open_so_far(source, found, index(v));
    default:
      return false;
    }
  };
  return std::ranges::any_of(around(found.around, vertex), [&](ElementId element) {
    return std::ranges::any_of(found.mesh.corners[index(element)], is_open);
  });
}

/// Vertices under a low cover become covered if something open is beside them.
void cover_low(const VertexSource& source, VertexSamples& found) {
  std::vector<std::uint32_t> low;
  for (std::uint32_t v = 0; v < found.states.size(); ++v)
    if (found.states[v] == VertexState::low_clearance)
      low.push_back(v);
  std::vector<std::uint8_t> beside_open(low.size(), 0);
  tbb::parallel_for(std::size_t{0}, low.size(), [&](std::size_t k) {
    beside_open[k] = has_open_beside(source, found, low[k]) ? 1 : 0;
  });
  for (std::size_t k = 0; k < low.size(); ++k)
    if (beside_open[k] != 0)
      found.states[low[k]] = VertexState::covered;
}

/// A step of lighting: the state of the vertices that are lit, as far as they are marked, and their state
/// afterwards. `level` as of vertex_seed().
struct VertexStep {
  VertexState now, then;
  std::span<const std::uint8_t> marked = {}; ///< by ElementVertexId; empty: all
  std::uint32_t level = 0;
};

/// Takes what `value(v, size, seed, workspace)` finds for these vertices, but for those that hang.
template <typename Value>
void light_each(const VertexSource& source, const VertexStep& step, VertexSamples& found,
                const Value& value) {
  constexpr std::size_t chunk_size = 64;
  const ElementMesh& mesh = found.mesh;
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < found.states.size(); ++v)
    if (found.states[v] == step.now && (step.marked.empty() || step.marked[v] != 0))
      vertices.push_back(v);
  std::vector<std::uint8_t> hangs(mesh.vertices.size(), 0);
  for (const HangingVertex& hanging : mesh.hanging)
    hangs[index(hanging.vertex)] = 1;
  std::erase_if(vertices, [&](std::uint32_t v) { return hangs[v] != 0; });

  std::vector<VertexEmission> emission(vertices.size());
  const auto light_vertex = [&](std::size_t k, PointWorkspace& work) {
    const std::uint32_t v = vertices[k];
    const double size = size_of(mesh, mesh.element_of_vertex[v]);
    work.direct_by_lamp.clear();
    work.indirect_by_lamp.clear();
    const VertexValue found_here = value(v, size, vertex_seed(source, v, step.level), work);
    found.field.irradiance[v] += glm::vec3(found_here.irradiance.total);
    found.field.mirrored[v] += glm::vec3(found_here.irradiance.mirrored);
    found.field.indirect[v] = glm::vec3(found_here.indirect.total);
    found.field.indirect_mirrored[v] = glm::vec3(found_here.indirect.mirrored);
    emission[k] = {v, found_here.hits, glm::vec3(found_here.emission.total),
                   glm::vec3(found_here.emission.mirrored)};
    take_by_lamp(work, v, found.field);
    if (!found.entering.empty())
      found.entering[v] += glm::vec3(found_here.irradiance.entering);
    if (found_here.irradiance.in_part)
      found.seen[v] = Visibility::partial;
    found.states[v] = found_here.clearance == Clearance::open  ? step.then
                      : found_here.clearance == Clearance::low ? VertexState::low_clearance
                                                       : VertexState::covered;
  };
  const std::size_t chunks = (vertices.size() + chunk_size - 1) / chunk_size;
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
    PointWorkspace& work = source.workspaces.local();
    for (std::size_t k = c * chunk_size; k < std::min(vertices.size(), (c + 1) * chunk_size); ++k)
      light_vertex(k, work);
    report(source.part, double(++done) / double(chunks));
  });
  // Covered vertices take their light from beside them.
  std::vector<std::uint8_t> taken(mesh.vertices.size(), 0);
  for (const std::uint32_t v : vertices)
    taken[v] = has_value(found.states[v]) ? 1 : 0;
  std::erase_if(emission, [](const VertexEmission& of_vertex) { return of_vertex.hits == 0; });
  spread_emission(emission, taken, found);
  cover_low(source, found);
}

} // namespace

void gather_at_vertices(const VertexSource& source, std::uint32_t level, VertexSamples& found) {
  light_each(source, {VertexState::unknown, VertexState::gathered, {}, level}, found,
             [&](std::uint32_t v, double size, std::uint32_t seed, PointWorkspace& work) {
               return value_at(source.gathering, source.irradiance,
                               {found.receivers[v], size, seed}, work);
             });
  resample_near_penumbrae(source, level, found);
}

/// Marks the dark vertices of an element that has a bright one, one that is covered,
/// or one that has all of its light; those once asked no more.
static bool mark_dark_beside_bright(const VertexSamples& found, ElementId element,
                                    std::vector<std::uint8_t>& marked,
                                    std::vector<std::uint8_t>& asked) {
  const auto is_dark = [&](std::size_t v) {
    return found.states[v] == VertexState::direct_only && found.field.irradiance[v] == glm::vec3(0.0F);
  };
  const auto is_beside = [&](ElementVertexId v) {
    return found.states[index(v)] == VertexState::covered ||
           found.states[index(v)] == VertexState::gathered ||
           (found.states[index(v)] == VertexState::direct_only && !is_dark(index(v)));
  };
  const ElementCorners& corners = found.mesh.corners[index(element)];
  bool any = false;
  if (std::ranges::any_of(corners, is_beside))
    for (const ElementVertexId v : corners)
      if (is_dark(index(v)) && asked[index(v)] == 0) {
        marked[index(v)] = asked[index(v)] = 1;
        any = true;
      }
  return any;
}

/// Finds the dark vertices that are covered, inwards from where light ends.
/// Deep in the dark, others hurt nobody. After the first step, what is new to be asked lies beside vertices
/// that the step before has found covered.
static void cover_shut_in(const VertexSource& source, VertexSamples& found) {
  std::vector<std::uint8_t> marked(found.states.size(), 0), asked(found.states.size(), 0);
  bool any = false;
  for (std::uint32_t e = 0; e < found.mesh.corners.size(); ++e)
    any = mark_dark_beside_bright(found, ElementId{e}, marked, asked) || any;
  while (any) {
    light_each(
        source, {VertexState::direct_only, VertexState::direct_only, marked}, found,
        [&](std::uint32_t v, double size, std::uint32_t seed, PointWorkspace& work) -> VertexValue {
          return {{},
                  {},
                  clearance_of_unlit(source.gathering.light, source.gathering.form_factors,
                                    found.receivers[v], size, seed, work)};
        });
    std::vector<std::uint32_t> covered;
    for (std::uint32_t v = 0; v < marked.size(); ++v)
      if (marked[v] != 0 && found.states[v] == VertexState::covered)
        covered.push_back(v);
    std::ranges::fill(marked, 0);
    any = false;
    for (const std::uint32_t v : covered)
      for (const ElementId element : around(found.around, v))
        any = mark_dark_beside_bright(found, element, marked, asked) || any;
  }
  // Under a low cover that goes on all around, indirect light is still to be gathered.
  std::ranges::replace(found.states, VertexState::low_clearance, VertexState::direct_only);
}

void light_vertices(const VertexSource& source, std::uint32_t level, VertexSamples& found) {
  // The mean over an element is that of four corners, as it is that of four and more points of its own.
  const DirectSettings& where_seen = source.gathering.direct;
  DirectSettings elsewhere = where_seen;
  elsewhere.images = std::min(where_seen.images, where_seen.images_in_element);
  light_each(source, {VertexState::unknown, VertexState::direct_only, {}, level}, found,
             [&](std::uint32_t v, double, std::uint32_t seed, PointWorkspace& work) -> VertexValue {
               return {direct_light_by(source.gathering,
                                       is_seen(source, v) ? where_seen : elsewhere,
                                       found.receivers[v], seed, work),
                       {}};
             });
  resample_near_penumbrae(source, level, found);
  cover_shut_in(source, found);
}

void gather_at_lit(const VertexSource& source, std::span<const std::uint8_t> marked,
                   VertexSamples& found) {
  const PointGathering& gathering = source.gathering;
  const bool keeps =
      source.kept != nullptr && gathering.form_factors.method != FormFactorMethod::hemicube;
  if (keeps && source.keeps_more) {
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < marked.size(); ++v)
      if (marked[v] != 0 && found.states[v] == VertexState::direct_only)
        vertices.push_back(v);
    source.kept->make_room(vertices, gathering.net.points.size());
  }
  light_each(source, {VertexState::direct_only, VertexState::gathered, marked}, found,
             [&](std::uint32_t v, double size, std::uint32_t seed, PointWorkspace& work) {
               return indirect_value_at(gathering, source.irradiance,
                                        {found.receivers[v], size, seed}, work,
                                        keeps ? source.kept->of(v) : nullptr);
             });
}

namespace {

/// Vertices on which something stands, or at whose side it does, take what is gathered beside it;
/// those of facets keep their means.
void light_contacts(const VertexSource& source, const VertexSamples& found,
                    std::vector<std::uint8_t>& valid, VertexIrradiance& field) {
  const ElementMesh& mesh = found.mesh;
  const PointGathering& gathering = source.gathering;
  const std::vector<Receiver>& receivers = found.receivers;
  std::vector<std::uint8_t> open = valid;
  tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t v) {
    if (found.states[v] == VertexState::low_clearance ||
        (found.states[v] == VertexState::gathered && touches_wall(gathering.light, receivers[v])))
      open[v] = 0;
  });
  const std::vector<ContactEdge> edges = contact_edges(mesh, open);
  std::vector<ContactLight> lights(edges.size());
  tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t k) {
    const auto [covered, exposed] = edges[k];
    lights[k] =
        light_at_contact(gathering, source.irradiance,
                         {receivers[exposed], size_of(mesh, mesh.element_of_vertex[exposed]),
                          hash(covered, exposed, gathering.form_factors.seed)},
                         receivers[covered].position, source.workspaces.local());
  });
  extend_to_contacts(edges, lights, valid, field);
}

/// The corners of elements that are open only in between take what is gathered there.
void light_gaps(const VertexSource& source, const ElementMesh& mesh,
                std::vector<std::uint8_t>& valid, VertexIrradiance& field) {
  const std::vector<ElementId> covered = covered_elements(mesh, valid);
  std::vector<std::optional<GapLight>> lights(covered.size());
  tbb::parallel_for(std::size_t{0}, covered.size(), [&](std::size_t k) {
    lights[k] = light_in_gap(source.gathering, source.irradiance, mesh, covered[k],
                             source.workspaces.local());
  });
  take_from_gaps(mesh, covered, lights, valid, field);
}

} // namespace

std::vector<std::uint8_t> with_values(const VertexSamples& found) {
  std::vector<std::uint8_t> valid;
  for (const VertexState state : found.states)
    valid.push_back(has_value(state) ? 1 : 0);
  return valid;
}

VertexIrradiance complete_field(const VertexSource& source, const VertexSamples& found) {
  VertexIrradiance field = found.field;
  std::vector<std::uint8_t> valid = with_values(found);
  // Vertices without light of their own take each lamp's light from their neighbours as well.
  for (auto& [direct, indirect] : field.by_lamp)
    for (auto* values : {&direct, &indirect}) {
      settle_hanging(found.mesh, *values);
      fill_vertices(found.mesh, valid, *values);
      settle_hanging(found.mesh, *values);
    }
  join_on_curves(source.gathering.light, found, valid, field);
  for_each_array(field, [&](auto& values) { settle_hanging(found.mesh, values); });
  light_contacts(source, found, valid, field);
  extend_over_regions(found.mesh, found.receivers, valid, field);
  light_gaps(source, found.mesh, valid, field);
  for_each_array(field, [&](auto& values) {
    fill_vertices(found.mesh, valid, values);
    settle_hanging(found.mesh, values);
  });
  return field;
}

std::vector<glm::vec3> filled(const VertexSamples& found, std::vector<glm::vec3> values) {
  settle_hanging(found.mesh, values);
  fill_vertices(found.mesh, with_values(found), values);
  settle_hanging(found.mesh, values);
  return values;
}

} // namespace meninas
