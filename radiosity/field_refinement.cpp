#include "radiosity/field_refinement.h"

#include "radiosity/contact_vertices.h"
#include "radiosity/mesh_division.h"
#include "radiosity/vertex_fill.h"
#include "radiosity/vertex_places.h"
#include "scenes/sampling.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

namespace meninas {

namespace {

/// Integrals over an element, as its points tell; each of (w x)^2.
struct Found {
  bool known = false;
  int points = 0;     ///< that count
  double off = 0.0;   ///< x = H - H~
  double light = 0.0; ///< x = H
  double sigma = 0.0; ///< x = sigma, the standard deviation of a sample
};

/// What is known of a vertex.
enum class VertexState : std::uint8_t { unknown, covered, at_foot, exposed };

/// What is sampled on an edge beside a contact.
struct ContactSample {
  double place = 0.0; ///< as a share of the edge (contact_vertices.h); 0: there is none
  ArrivingLight light = {};
};
/// By the covered end of the edge, then by the other.
using ContactSamples = std::map<std::pair<std::uint32_t, std::uint32_t>, ContactSample>;

/// A mesh with what is known of the field on it.
struct Growing {
  ElementMesh mesh;
  std::vector<PointSample> samples; ///< by ElementVertexId
  std::vector<VertexState> known;   ///< by ElementVertexId
  std::vector<Found> found;         ///< by ElementId
  ContactSamples contacts;
};

/// What does not change from round to round.
struct Refinement {
  const LightScene& light;
  const FieldSampler& sampler;
  std::span<const double> weight;
  const MirrorOutlines& outlines;
  const RefinementSettings& settings;
};

template <typename Body>
void for_each_in_parallel(std::size_t count, Body&& body) {
  constexpr std::size_t chunk_size = 32;
  tbb::parallel_for(std::size_t{0}, (count + chunk_size - 1) / chunk_size, [&](std::size_t c) {
    for (std::size_t k = c * chunk_size; k < std::min(count, (c + 1) * chunk_size); ++k)
      body(k);
  });
}

/// Depends on the place and not on the numbers of a mesh that is still growing.
std::uint32_t seed_of(SideId side, Vec2 uv) {
  return hash(index(side), std::bit_cast<std::uint32_t>(static_cast<float>(uv.x)),
              std::bit_cast<std::uint32_t>(static_cast<float>(uv.y)));
}

std::vector<std::uint8_t> hanging_in(const ElementMesh& mesh) {
  std::vector<std::uint8_t> hanging(mesh.vertices.size(), 0);
  for (const HangingVertex& h : mesh.hanging)
    hanging[index(h.vertex)] = 1;
  return hanging;
}

/// Samples the vertices that have no sample; those that hang need none.
void sample_vertices(const Refinement& refinement, Growing& growing) {
  const ElementMesh& mesh = growing.mesh;
  const std::vector<std::uint8_t> hanging = hanging_in(mesh);
  const std::vector<Receiver> receivers = vertex_receivers(mesh);
  for_each_in_parallel(mesh.vertices.size(), [&](std::size_t v) {
    if (growing.known[v] != VertexState::unknown || hanging[v] != 0)
      return;
    const ElementId element = mesh.element_of_vertex[v];
    const SideId side = mesh.side_of_element[index(element)];
    const Patch& patch = refinement.light.surfaces.patches[index(mesh.sides[index(side)].patch)];
    growing.samples[v] = refinement.sampler.at_vertices(
        receivers[v], size_of(mesh, element), seed_of(side, uv_at(patch, mesh.vertices[v])));
    growing.known[v] = growing.samples[v].covered                   ? VertexState::covered
                       : is_at_foot(refinement.light, receivers[v]) ? VertexState::at_foot
                                                                    : VertexState::exposed;
  });
}

/// Samples the edges between exposed vertices and others that have not been.
void sample_contacts(const Refinement& refinement, Growing& growing) {
  const ElementMesh& mesh = growing.mesh;
  const FieldSampler& sampler = refinement.sampler;
  std::vector<std::uint8_t> exposed;
  for (const VertexState known : growing.known)
    exposed.push_back(known == VertexState::exposed ? 1 : 0);
  const std::vector<ContactEdge> edges = contact_edges(mesh, exposed);
  const std::vector<Receiver> receivers = vertex_receivers(mesh);
  std::vector<ContactSample> samples(edges.size());
  for_each_in_parallel(edges.size(), [&](std::size_t k) {
    const auto [covered, open] = edges[k];
    if (const auto before = growing.contacts.find({covered, open});
        before != growing.contacts.end()) {
      samples[k] = before->second;
      return;
    }
    const ElementId element = mesh.element_of_vertex[open];
    const double size = size_of(mesh, element);
    const SideId side = mesh.side_of_element[index(element)];
    const Patch& patch = refinement.light.surfaces.patches[index(mesh.sides[index(side)].patch)];
    const Point3& end = mesh.vertices[covered];
    const std::uint32_t seed =
        hash(seed_of(side, uv_at(patch, mesh.vertices[open])), seed_of(side, uv_at(patch, end)));
    Receiver point = receivers[open];
    const double place = contact_place(point, end, [&](const Receiver& receiver) {
      return sampler.is_open(receiver, size, seed);
    });
    if (place == 0.0)
      return;
    point.position = glm::mix(point.position, end, place);
    const PointSample sample = sampler.at_vertices(point, size, seed);
    if (!sample.covered)
      samples[k] = {place, sample.light};
  });
  growing.contacts.clear();
  for (std::size_t k = 0; k < edges.size(); ++k)
    growing.contacts[{edges[k].covered, edges[k].exposed}] = samples[k];
}

/// The samples as a field: covered vertices follow what is beside them,
/// or take their neighbours' values, hanging ones those of their ends.
SampledField field_of(const Growing& growing) {
  const ElementMesh& mesh = growing.mesh;
  SampledField field;
  std::vector<std::uint8_t> valid(mesh.vertices.size(), 1);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    field.total.emplace_back(growing.samples[v].light.total);
    field.mirrored.emplace_back(growing.samples[v].light.mirrored);
    valid[v] = growing.known[v] == VertexState::exposed || growing.known[v] == VertexState::at_foot
                   ? 1
                   : 0;
  }
  for (auto* values : {&field.total, &field.mirrored})
    settle_hanging(mesh, *values);
  std::map<std::uint32_t, ContactLines> lines_to;
  for (const auto& [ends, contact] : growing.contacts)
    if (contact.place > 0.0)
      lines_to[ends.first].add({Rgb(field.total[ends.second]), Rgb(field.mirrored[ends.second])},
                               contact.light, contact.place);
  for (const auto& [v, lines] : lines_to) {
    const ArrivingLight light = lines.mean();
    field.total[v] = glm::vec3(light.total);
    field.mirrored[v] = glm::vec3(light.mirrored);
    valid[v] = 1;
  }
  for (auto* values : {&field.total, &field.mirrored}) {
    fill_vertices(mesh, valid, *values);
    settle_hanging(mesh, *values);
  }
  return field;
}

/// Number k of the points an element is looked at in; the first is its centre.
Vec2 point_of(bool triangle, std::uint32_t k, std::uint32_t seed) {
  if (k == 0)
    return Vec2(triangle ? 1.0 / 3.0 : 0.5);
  const auto sample = sobol4(k - 1, seed);
  const Vec2 st(sample[0], sample[1]);
  return triangle && st.x + st.y > 1.0 ? 1.0 - st : st;
}

/// What one element hides: so many points besides its centre, and those of outlines that pass it.
Found look_at(const Refinement& refinement, const ElementMesh& mesh,
              const std::vector<glm::vec3>& values, ElementId element, int points,
              std::span<const Vec2> on_outline) {
  const MeshCell& cell = cell_of(mesh, element);
  const MeshSide& side = mesh.sides[index(cell.side)];
  const Patch& patch = refinement.light.surfaces.patches[index(side.patch)];
  const double weight = refinement.weight[index(root_of(mesh, element))];
  Found sum{.known = true};
  if (weight <= 0.0)
    return sum;
  int open = 0;
  const auto look = [&](Vec2 uv, Vec2 st) {
    const PointSample sample = refinement.sampler.between(
        {point_at(patch, uv), side.normal, side.plane_class, side.tangent, side.coat},
        size_of(mesh, element), seed_of(cell.side, uv));
    if (sample.covered)
      return;
    ++open;
    const glm::vec3 light(sample.light.total);
    sum.off +=
        std::pow(weight * largest(glm::abs(light - value_in(mesh, values, {element, st}))), 2.0);
    sum.light += std::pow(weight * largest(light), 2.0);
    sum.sigma += weight * weight * sample.variance;
  };
  const std::uint32_t own_seed = seed_of(cell.side, patch_uv_of(mesh, cell, Vec2(0.25)));
  for (std::uint32_t k = 0; k <= static_cast<std::uint32_t>(points); ++k) {
    const Vec2 st = point_of(side.triangle, k, own_seed);
    look(patch_uv_of(mesh, cell, st), st);
  }
  for (const Vec2 uv : on_outline)
    look(uv, locate(mesh, cell.side, uv).st);
  const double share = open > 0 ? mesh.area[index(element)] / open : 0.0;
  return {true, open, share * sum.off, share * sum.light, share * sum.sigma};
}

/// By ElementId, of elements that are still to be looked at closely:
/// a few of the points at which outlines pass them.
using OutlinesIn = std::map<std::uint32_t, std::vector<Vec2>>;
OutlinesIn outlines_in(const Refinement& refinement, const Growing& growing) {
  constexpr int outline_levels = 3;
  constexpr std::size_t most = 16;
  OutlinesIn in;
  for (const OutlinePoint& point : refinement.outlines) {
    const ElementId element = locate(growing.mesh, point.side, point.uv).element;
    if (growing.found[index(element)].known ||
        cell_of(growing.mesh, element).level >= outline_levels)
      continue;
    in[index(element)].push_back(point.uv);
  }
  for (auto& [element, points] : in) {
    // Of many, every so many-th: outlines of all corners of all images take part.
    const std::size_t step = (points.size() + most - 1) / most;
    for (std::size_t k = 0; k * step < points.size(); ++k)
      points[k] = points[k * step];
    points.resize((points.size() + step - 1) / step);
  }
  return in;
}

/// Looks at the elements that have not been.
void look_at_elements(const Refinement& refinement, const SampledField& field, Growing& growing) {
  const ElementMesh& mesh = growing.mesh;
  const RefinementSettings& settings = refinement.settings;
  const OutlinesIn outlined = outlines_in(refinement, growing);
  for_each_in_parallel(element_count(mesh), [&](std::size_t e) {
    if (growing.found[e].known)
      return;
    const auto element = static_cast<ElementId>(e);
    const auto outlines = outlined.find(static_cast<std::uint32_t>(e));
    const bool passed = outlines != outlined.end();
    const bool closely = cell_of(mesh, element).level == 0 || passed;
    growing.found[e] = look_at(
        refinement, mesh, field.total, element, closely ? settings.root_points : settings.points,
        passed ? std::span<const Vec2>(outlines->second) : std::span<const Vec2>{});
  });
}

/// The samples' relative variance over all elements.
double variance_of_all(const Growing& growing) {
  double sigma = 0.0, light = 0.0;
  for (const Found& found : growing.found) {
    sigma += found.sigma;
    light += found.light;
  }
  return light > 0.0 ? sigma / light : 0.0;
}

/// The same by ElementId. The variance of one point says little: that of an element leans
/// on that of its root cell, the more the fewer points it has, and this on that of all.
std::vector<double> variance_of_each(const Refinement& refinement, const Growing& growing) {
  constexpr double leaning = 4.0;
  const ElementMesh& mesh = growing.mesh;
  std::vector<double> sum(refinement.weight.size(), leaning * variance_of_all(growing)),
      points(sum.size(), leaning);
  const auto own = [](const Found& found) {
    return found.light > 0.0 ? found.points * found.sigma / found.light : 0.0;
  };
  for (std::size_t e = 0; e < growing.found.size(); ++e) {
    const std::uint32_t root = index(root_of(mesh, static_cast<ElementId>(e)));
    sum[root] += own(growing.found[e]);
    points[root] += growing.found[e].points;
  }
  std::vector<double> variance;
  for (std::size_t e = 0; e < growing.found.size(); ++e) {
    const Found& found = growing.found[e];
    const std::uint32_t root = index(root_of(mesh, static_cast<ElementId>(e)));
    const double lean = leaning / std::max(found.points, 1);
    variance.push_back((own(found) + lean * sum[root] / points[root]) / (found.points + lean));
  }
  return variance;
}

/// What noise alone makes of the integral of (w (H - H~))^2,
/// in the middle of four vertices, by ElementId.
std::vector<double> made_by_noise(const Refinement& refinement, const Growing& growing) {
  std::vector<double> made = variance_of_each(refinement, growing);
  for (std::size_t e = 0; e < made.size(); ++e)
    made[e] *= 1.25 * growing.found[e].light;
  return made;
}

/// Area of what reflects.
double area_that_counts(const Refinement& refinement, const ElementMesh& mesh) {
  double area = 0.0;
  for (std::size_t e = 0; e < element_count(mesh); ++e)
    if (refinement.weight[index(root_of(mesh, static_cast<ElementId>(e)))] > 0.0)
      area += mesh.area[e];
  return area;
}

/// Elements with more than their share of the error; none where `error2`, that of all, is allowed.
std::vector<std::uint8_t> to_divide(const Refinement& refinement, const Growing& growing,
                                    double allowed, double& error2) {
  constexpr double stands_out = 2.0; // standard deviations
  const ElementMesh& mesh = growing.mesh;
  const std::vector<double> by_noise = made_by_noise(refinement, growing);
  std::vector<std::uint8_t> marked(element_count(mesh), 0);
  error2 = 0.0;
  for (std::size_t e = 0; e < marked.size(); ++e)
    error2 += growing.found[e].off - by_noise[e];
  error2 = std::max(error2, 0.0);
  if (error2 <= allowed)
    return marked;
  const double share = allowed / static_cast<double>(marked.size());
  for (std::size_t e = 0; e < marked.size(); ++e) {
    // A mean of k squares of noise is 1 +- sqrt(2 / k) of what it is on average.
    const Found& found = growing.found[e];
    const double noise =
        by_noise[e] * (1.0 + stands_out * std::sqrt(2.0 / std::max(1, found.points)));
    const int level = cell_of(mesh, static_cast<ElementId>(e)).level;
    marked[e] = found.off > share + noise && level < refinement.settings.most_levels ? 1 : 0;
  }
  return marked;
}

/// The divided mesh, with what was known of the one before.
Growing divided(const Refinement& refinement, const Growing& before,
                const std::vector<std::uint8_t>& marked) {
  Growing after;
  after.mesh = divide_elements(before.mesh, refinement.light.surfaces, marked);
  after.samples.resize(after.mesh.vertices.size());
  after.known.resize(after.mesh.vertices.size(), VertexState::unknown);
  after.found.resize(element_count(after.mesh));
  std::vector<std::uint32_t> vertex_now(before.mesh.vertices.size(), 0);
  const std::vector<CellId> now = same_cells(before.mesh, after.mesh);
  for (std::size_t e = 0; e < element_count(before.mesh); ++e) {
    const CellId cell = now[index(before.mesh.cell_of_element[e])];
    const ElementCorners corners = corners_of(after.mesh, cell);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const std::uint32_t from = index(before.mesh.corners[e][c]), to = index(corners[c]);
      vertex_now[from] = to;
      after.samples[to] = before.samples[from];
      after.known[to] = before.known[from];
    }
    if (is_leaf(after.mesh.cells[index(cell)]))
      after.found[after.mesh.cells[index(cell)].first_element] = before.found[e];
  }
  for (const auto& [ends, contact] : before.contacts)
    after.contacts[{vertex_now[ends.first], vertex_now[ends.second]}] = contact;
  return after;
}

} // namespace

static Growing undivided(const ElementMesh& mesh) {
  Growing growing;
  growing.mesh = mesh;
  growing.samples.resize(mesh.vertices.size());
  growing.known.resize(mesh.vertices.size(), VertexState::unknown);
  growing.found.resize(element_count(mesh));
  return growing;
}

SampledField refine_field(const LightScene& light, const FieldSampler& sampler,
                          std::span<const double> weight, const MirrorOutlines& outlines,
                          const RefinementSettings& settings) {
  const Refinement refinement{light, sampler, weight, outlines, settings};
  Growing growing = undivided(light.mesh);
  const double area = area_that_counts(refinement, light.mesh);
  const double allowed = settings.error * settings.error * area;
  for (;;) {
    sample_vertices(refinement, growing);
    sample_contacts(refinement, growing);
    SampledField field = field_of(growing);
    look_at_elements(refinement, field, growing);
    double error2 = 0.0;
    const auto marked = to_divide(refinement, growing, allowed, error2);
    const auto count = static_cast<std::size_t>(std::count(marked.begin(), marked.end(), 1));
    if (count == 0 || element_count(growing.mesh) + 3 * count > settings.max_elements) {
      field.error = area > 0.0 ? std::sqrt(error2 / area) : 0.0;
      field.noise = std::sqrt(variance_of_all(growing));
      field.mesh = std::move(growing.mesh);
      return field;
    }
    growing = divided(refinement, growing, marked);
  }
}

} // namespace meninas
