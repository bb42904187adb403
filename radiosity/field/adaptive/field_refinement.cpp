#include "radiosity/field/adaptive/field_refinement.h"

#include "radiosity/field/adaptive/field_samples.h"
#include "radiosity/mesh/subdivision.h"
#include "radiosity/field/vertex_places.h"
#include "scenes/sampling.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace meninas {

namespace {

/// Integrals over an element, as its points tell; each of (w x)^2.
struct Found {
  bool known = false;
  bool quick = false; ///< by quick samples: plain, and taken for free of noise
  int points = 0;     ///< that count
  double off = 0.0;   ///< x = H - H~
  double light = 0.0; ///< x = H
  double sigma = 0.0; ///< x = sigma, the standard deviation of a sample
};

/// A mesh with what is known of the field on it.
struct Growing {
  ElementMesh mesh;
  FieldSamples samples;
  std::vector<Found> found; ///< by ElementId
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

/// Number k of the points an element is looked at in; the first is its centre.
Vec2 point_of(bool triangle, std::uint32_t k, std::uint32_t seed) {
  if (k == 0)
    return Vec2(triangle ? 1.0 / 3.0 : 0.5);
  const auto sample = sobol4(k - 1, seed);
  const Vec2 st(sample[0], sample[1]);
  return triangle && st.x + st.y > 1.0 ? 1.0 - st : st;
}

/// An element that is looked at, against what its vertices say.
class Look {
public:
  Look(const Refinement& refinement, const Growing& growing, const std::vector<glm::vec3>& values,
       ElementId element)
      : refinement_(refinement), mesh_(growing.mesh), values_(values), element_(element),
        cell_(cell_of(mesh_, element)), side_(mesh_.sides[index(cell_.side)]),
        patch_(refinement.light.surfaces.patches[index(side_.patch)]),
        weight_(refinement.weight[index(root_of(mesh_, element))]),
        low_(is_low(mesh_, growing.samples, element)) {}

  /// So many points besides the centre, and those of outlines that pass it.
  Found at(const SamplePoint& sample, int points, std::span<const Vec2> on_outline) const {
    Found sum{.known = true};
    if (weight_ <= 0.0)
      return sum;
    const std::uint32_t own_seed = seed_of(cell_.side, patch_uv_of(mesh_, cell_, Vec2(0.25)));
    for (std::uint32_t k = 0; k <= static_cast<std::uint32_t>(points); ++k) {
      const Vec2 st = point_of(side_.triangle, k, own_seed);
      const Vec2 uv = uv_of(st);
      add(sample, uv, region_of(mesh_, element_) ? locate(mesh_, cell_.side, uv).st : st, sum);
    }
    for (const Vec2 uv : on_outline)
      if (const ElementPoint at = locate(mesh_, cell_.side, uv); at.element == element_)
        add(sample, uv, at.st, sum);
    const double share = sum.points > 0 ? mesh_.area[index(element_)] / sum.points : 0.0;
    return {true, false, sum.points, share * sum.off, share * sum.light, share * sum.sigma};
  }

private:
  /// A point of the element, which may be a region of its leaf.
  Vec2 uv_of(Vec2 st) const {
    const RegionElement* region = region_of(mesh_, element_);
    if (region == nullptr)
      return patch_uv_of(mesh_, cell_, st);
    ReceiverArea area;
    area.region = region;
    return uv_at(patch_, point_in_region(area, st));
  }

  void add(const SamplePoint& at, Vec2 uv, Vec2 st, Found& sum) const {
    const PointSample sample =
        at({point_at(patch_, uv), side_.normal, side_.plane_class, side_.tangent, side_.coat},
           size_of(mesh_, element_), seed_of(cell_.side, uv));
    if (sample.cover == Cover::shut || (sample.cover == Cover::low && !low_))
      return;
    ++sum.points;
    const glm::vec3 light(sample.light.total);
    sum.off += std::pow(
        weight_ * largest(glm::abs(light - value_in(mesh_, values_, {element_, st}))), 2.0);
    sum.light += std::pow(weight_ * largest(light), 2.0);
    sum.sigma += weight_ * weight_ * sample.variance;
  }

  const Refinement& refinement_;
  const ElementMesh& mesh_;
  const std::vector<glm::vec3>& values_;
  ElementId element_;
  const MeshCell& cell_;
  const MeshSide& side_;
  const Patch& patch_;
  double weight_;
  bool low_;
};

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

/// Looks at the elements that have not been. `share` is what each may hide.
void look_at_elements(const Refinement& refinement, const SampledField& field, double share,
                      Growing& growing) {
  constexpr double next_to_nothing = 1.0 / 16.0; // of squares: a quarter of the error
  const ElementMesh& mesh = growing.mesh;
  const RefinementSettings& settings = refinement.settings;
  const FieldSampler& sampler = refinement.sampler;
  const OutlinesIn outlined = outlines_in(refinement, growing);
  for_each_in_parallel(element_count(mesh), [&](std::size_t e) {
    // What was plain for its share once may hide too much for one that has become smaller.
    Found& found = growing.found[e];
    const bool seen = found.known, told = !found.quick || found.off <= next_to_nothing * share;
    if (seen && told)
      return;
    const Look look(refinement, growing, field.total, static_cast<ElementId>(e));
    const auto outlines = outlined.find(static_cast<std::uint32_t>(e));
    const bool passed = outlines != outlined.end(),
               closely = cell_of(mesh, static_cast<ElementId>(e)).level == 0 || passed;
    const int points = closely ? settings.root_points : settings.points;
    const std::span<const Vec2> on_outline =
        passed ? std::span<const Vec2>(outlines->second) : std::span<const Vec2>{};
    if (sampler.quick && !seen) {
      found = look.at(sampler.quick, points, on_outline);
      found.quick = true;
    }
    if (!sampler.quick || found.off > next_to_nothing * share)
      found = look.at(sampler.between, points, on_outline);
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
/// in the middle of four vertices, by ElementId; nothing where quick samples have shown none.
std::vector<double> made_by_noise(const Refinement& refinement, const Growing& growing) {
  std::vector<double> made = variance_of_each(refinement, growing);
  for (std::size_t e = 0; e < made.size(); ++e)
    made[e] *= growing.found[e].quick ? 0.0 : 1.25 * growing.found[e].light;
  return made;
}

/// Area of what reflects, as it counts.
double area_that_counts(const Refinement& refinement, const ElementMesh& mesh) {
  double area = 0.0;
  for (std::size_t e = 0; e < element_count(mesh); ++e)
    if (refinement.weight[index(root_of(mesh, static_cast<ElementId>(e)))] > 0.0)
      area += counted_area(mesh, cell_of(mesh, static_cast<ElementId>(e)));
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
    const MeshCell& cell = cell_of(mesh, static_cast<ElementId>(e));
    const bool may_be = cell.level < refinement.settings.max_levels &&
                        is_divisible(mesh, refinement.light.surfaces, cell);
    marked[e] = found.off > share + noise && may_be ? 1 : 0;
  }
  return marked;
}

/// The divided mesh, with what was known of the one before.
Growing divided(const Refinement& refinement, const Growing& before,
                const std::vector<std::uint8_t>& marked) {
  Growing after;
  after.mesh = divide_elements(before.mesh, refinement.light.surfaces, marked);
  after.samples = carried(before.mesh, before.samples, after.mesh);
  after.found.resize(element_count(after.mesh));
  const std::vector<CellId> now = same_cells(before.mesh, after.mesh);
  for (std::size_t e = 0; e < element_count(before.mesh); ++e)
    if (const MeshCell& cell = after.mesh.cells[index(now[index(before.mesh.cell_of_element[e])])];
        is_leaf(cell))
      after.found[cell.first_element + e - cell_of(before.mesh, static_cast<ElementId>(e)).first_element] =
          before.found[e];
  return after;
}

} // namespace

SampledField refine_field(const LightScene& light, const FieldSampler& sampler,
                          std::span<const double> weight, const MirrorOutlines& outlines,
                          const RefinementSettings& settings) {
  const Refinement refinement{light, sampler, weight, outlines, settings};
  Growing growing{light.mesh, no_samples(light.mesh),
                  std::vector<Found>(element_count(light.mesh))};
  const double area = area_that_counts(refinement, light.mesh);
  const double allowed = settings.error * settings.error * area;
  for (;;) {
    sample_field(light, sampler, growing.mesh, growing.samples);
    SampledField field = field_of(growing.mesh, growing.samples);
    look_at_elements(refinement, field, allowed / double(element_count(growing.mesh)), growing);
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
