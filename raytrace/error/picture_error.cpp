#include "raytrace/error/picture_error.h"

#include "radiosity/field/vertex_places.h"
#include "raytrace/error/noise_choice.h"
#include "raytrace/error/probe_choice.h"
#include "scenes/sampling.h"
#include "scenes/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <tuple>
#include <numbers>

namespace meninas {

namespace {

using Radiances = std::vector<glm::vec3>;

using Cost = std::pair<double, double>; ///< seconds, rays

/// Pixels on demand, and what they have taken.
struct Probing {
  const IrradianceField& field;
  const Camera& camera;
  const TwoPassSettings& settings;
  std::uint64_t rays = 0;
  Stopwatch watch = {};
  double seconds = 0.0; ///< up to its last lap

  Cost so_far() {
    seconds += watch.lap();
    return {seconds, double(rays)};
  }

  /// By hit.
  Cost each_since(const Cost& before, std::size_t hits) {
    const Cost now = so_far();
    const double n = double(std::max<std::size_t>(hits, 1));
    return {(now.first - before.first) / n, (now.second - before.second) / n};
  }

  Radiances operator()(const RenderSettings& render, std::span<const glm::ivec2> pixels) {
    ProbedPixels probed = render_pixels(field, camera, render, pixels);
    rays += probed.rays;
    return std::move(probed.radiance);
  }
};

/// Squares of radiances beside a lamp are too large for floats.
glm::dvec3 product_of(double weight, const glm::vec3& a, const glm::vec3& b) {
  return weight * glm::dvec3(a) * glm::dvec3(b);
}

/// The mean over pixels and channels of a b.
template <typename Product>
double mean_of(std::size_t count, const Product& product) {
  double sum = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const glm::dvec3 p = product(k);
    sum += p.r + p.g + p.b;
  }
  return count > 0 ? sum / (3.0 * static_cast<double>(count)) : 0.0;
}

/// The mean of products that is a square: at least the standard error of the mean, below which it is not known.
template <typename Product>
double known_mean(std::size_t count, const Product& product) {
  double sum = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const glm::dvec3 p = product(k);
    const double mean = (p.r + p.g + p.b) / 3.0;
    sum += mean;
    squares += mean * mean;
  }
  if (count == 0)
    return 0.0;
  return std::max(sum, std::sqrt(squares)) / static_cast<double>(count);
}

double mean_outside(const Image& picture, const std::vector<std::uint8_t>& emits) {
  double sum = 0.0, count = 0.0;
  for (std::size_t p = 0; p < emits.size(); ++p)
    if (emits[p] == 0) {
      const glm::dvec3 c(picture.pixels[p]);
      sum += c.r + c.g + c.b;
      count += 3.0;
    }
  return count > 0.0 ? sum / count : 0.0;
}

/// One camera ray a pixel, and gathering as vertices do, with no cap on mirrors.
RenderSettings gathering_settings(const TwoPassSettings& settings, bool within_pixels) {
  RenderSettings render = settings.render;
  const PassOneSettings& pass_one = settings.pass_one;
  render.samples = 1;
  render.max_bounces = RenderSettings{}.max_bounces;
  render.diffuse.term = DiffuseTerm::gather;
  if (settings.render.diffuse.term == DiffuseTerm::interpolated) {
    constexpr int few = 16, many = 128; // or else their noise hides what is looked for
    auto& direct = render.diffuse.direct = pass_one.direct;
    if (within_pixels) {
      direct.shadow_rays = std::max(direct.shadow_rays, few);
      direct.penumbra_rays = std::max(direct.penumbra_rays, many);
    }
  }
  render.diffuse.gather = pass_one.form_factors;
  render.diffuse.gather.method = FormFactorMethod::rays;
  render.diffuse.gather.max_bounces = FormFactorSettings{}.max_bounces;
  render.diffuse.points.rays = pass_one.form_factors.rays;
  return render;
}

bool is_capped(const TwoPassSettings& settings) {
  return settings.render.max_bounces < RenderSettings{}.max_bounces ||
         settings.pass_one.form_factors.max_bounces < FormFactorSettings{}.max_bounces;
}

RenderSettings redrawn(RenderSettings settings, std::uint32_t draw) {
  settings.diffuse.draw = draw;
  return settings;
}

/// Other camera rays of the same pixels.
RenderSettings elsewhere(RenderSettings settings) {
  settings.seed = hash(settings.seed, 0xe15e);
  return settings;
}

/// The squared errors, in units of radiance squared.
struct SquaredErrors {
  double field = 0.0, source = 0.0, vertices = 0.0, tail = 0.0, pixels = 0.0;
};

/// The squared error of gathered light due to the field it is gathered from.
/// The compared gatherings are the same but for that.
double estimated_error(Probing& probe, std::span<const glm::ivec2> pixels,
                      std::span<const double> weight) {
  constexpr int places = 16;
  RenderSettings shown = probe.settings.render;
  shown.samples = 1;
  RenderSettings again = shown;
  again.diffuse.places = places;
  const auto change = [&](std::uint32_t draw) {
    Radiances more = probe(redrawn(again, draw), pixels);
    const Radiances as_shown = probe(redrawn(shown, draw), pixels);
    std::ranges::transform(more, as_shown, more.begin(), std::minus<>{});
    return more;
  };
  const Radiances c1 = change(3), c2 = change(4);
  return mean_of(pixels.size(), [&](std::size_t k) { return product_of(weight[k], c1[k], c2[k]); });
}

/// Light from emitters as it is, and as the picture has it; one ray a pixel each.
struct SourceSettings {
  RenderSettings exact, shown;
};

/// The squared error of direct light in the mean of a pixel.
/// Cells as small as pixels are off to either side of edges: several rays in fewer pixels tell means with less noise.
double error_of_means(Probing& probe, SourceSettings settings, const ProbeChoice& choice, PictureError& error) {
  constexpr int rays = 16, fewer = 4, shadow_rays = 16; // from each of these
  const std::size_t count = (choice.pixels.size() + fewer - 1) / fewer;
  const auto pixels = std::span(choice.pixels).first(count);
  auto& [exact, shown] = settings;
  exact.samples = shown.samples = rays;
  // All are sent whatever the first ones met: if few that agree counted as the whole, frames would hide nothing.
  exact.diffuse.direct.penumbra_samples = PenumbraSamples::everywhere;
  exact.diffuse.direct.penumbra_rays = exact.diffuse.direct.shadow_rays = shadow_rays;
  const auto off = [&](bool other, std::uint32_t draw) {
    const auto at = [&](const RenderSettings& render) { return other ? elsewhere(render) : render; };
    Radiances changes = probe(at(redrawn(exact, draw)), pixels);
    const Radiances as_shown = probe(at(redrawn(shown, draw)), pixels);
    std::ranges::transform(changes, as_shown, changes.begin(), std::minus<>{});
    return changes;
  };
  const Cost before = probe.so_far();
  const Radiances a = off(false, 3), b = off(true, 4);
  std::tie(error.direct_seconds, error.direct_rays) = probe.each_since(before, 2 * count * rays);
  return known_mean(count, [&](std::size_t k) { return product_of(choice.weight[k], a[k], b[k]); });
}

struct TwoDraws {
  const Radiances &a, &b;
};

/// Squared: what two gatherings have that such with as many mirrors as the picture has have not.
double light_beyond(Probing& probe, RenderSettings capped, const TwoDraws& all, const ProbeChoice& choice) {
  const auto pixels = std::span(choice.pixels).first(all.a.size());
  capped.diffuse.gather.max_bounces = probe.settings.pass_one.form_factors.max_bounces;
  const Radiances a = probe(redrawn(capped, 3), pixels), b = probe(redrawn(capped, 4), pixels);
  return mean_of(pixels.size(), [&](std::size_t k) {
    return product_of(choice.weight[k], all.a[k] - a[k], all.b[k] - b[k]);
  });
}

/// The error of the light that one camera ray a pixel shows:
/// by two gatherings at the first pixels, and by direct light at all.
void probe_field(Probing& probe, const ProbeChoice& choice, std::size_t gathered,
                 bool within_pixels, SquaredErrors& errors, PictureError& error) {
  const std::span<const glm::ivec2> pixels = choice.pixels;
  const RenderSettings gathering = gathering_settings(probe.settings, within_pixels);
  RenderSettings shown = probe.settings.render;
  shown.samples = 1;
  const bool interpolated = shown.diffuse.term == DiffuseTerm::interpolated;
  const auto first = pixels.first(std::min(gathered, pixels.size()));
  if (shown.diffuse.term == DiffuseTerm::gather) {
    errors.field = estimated_error(probe, first, choice.weight);
    return;
  }
  // Light computed at the hit is drawn alike in L_k, and is not in the difference:
  // its noise is the pixels'.
  const Radiances l1 = probe(redrawn(shown, 3), interpolated && !within_pixels ? pixels : first);
  const Radiances l2 = interpolated ? l1 : probe(redrawn(shown, 4), first);
  const Cost before = probe.so_far();
  const Radiances g1 = probe(redrawn(gathering, 3), first),
                  g2 = probe(redrawn(gathering, 4), first);
  std::tie(error.gather_seconds, error.gather_rays) = probe.each_since(before, 2 * first.size());
  const auto& weight = choice.weight;
  errors.field = mean_of(first.size(), [&](std::size_t k) {
    return product_of(weight[k], g1[k] - l1[k], g2[k] - l2[k]);
  });

  // Without direct light, whose noise is the pixels' or the mesh's,
  // draw 3 and 4 are those of the gathering alone.
  Radiances s1 = l1, s2 = l2;
  if (interpolated && !probe.field.indirect.empty()) {
    RenderSettings source = gathering;
    source.max_bounces = shown.max_bounces;
    source.diffuse.term = DiffuseTerm::direct;
    const Cost unprobed = probe.so_far();
    s1 = probe(redrawn(source, 3), within_pixels ? first : pixels);
    s2 = probe(redrawn(source, 4), within_pixels ? first : pixels);
    if (within_pixels) {
      errors.source = error_of_means(probe, {source, shown}, choice, error);
      errors.field = errors.source + known_mean(first.size(), [&](std::size_t k) {
                       return product_of(weight[k], g1[k] - s1[k], g2[k] - s2[k]);
                     });
    } else {
      std::tie(error.direct_seconds, error.direct_rays) = probe.each_since(unprobed, 2 * pixels.size());
      const auto product = [&](std::size_t k) {
        return product_of(weight[k], s1[k] - l1[k], s2[k] - l1[k]);
      };
      errors.source = mean_of(pixels.size(), product);
      errors.field += errors.source - mean_of(first.size(), product);
    }
  }
  const auto apart = [&](std::size_t k) {
    const glm::vec3 change = (g1[k] - s1[k]) - (g2[k] - s2[k]);
    return product_of(weight[k], change, change);
  };
  errors.vertices = 0.5 * mean_of(first.size(), apart);
  if (is_capped(probe.settings)) {
    RenderSettings capped = gathering;
    capped.max_bounces = shown.max_bounces;
    errors.tail = light_beyond(probe, capped, {g1, g2}, choice);
  }
}

/// The pixels outside emitters by the number of their samples.
std::map<std::uint32_t, std::vector<glm::ivec2>>
pixels_by_samples(const SampledPicture& picture, const std::vector<std::uint8_t>& emits,
                  int samples) {
  std::map<std::uint32_t, std::vector<glm::ivec2>> groups;
  for (std::size_t p = 0; p < emits.size(); ++p)
    if (emits[p] == 0) {
      const auto width = static_cast<std::size_t>(picture.image.width);
      groups[picture.samples.empty() ? static_cast<std::uint32_t>(samples) : picture.samples[p]]
          .emplace_back(static_cast<int>(p % width), static_cast<int>(p / width));
    }
  return groups;
}

/// Another draw of all camera rays of some pixels.
void probe_samples(Probing& probe, const SampledPicture& picture,
                   const std::vector<std::uint8_t>& emits, int wanted, SquaredErrors& errors) {
  RenderSettings again = probe.settings.render;
  again.seed = hash(again.seed, 0xa9a17);
  const auto groups = pixels_by_samples(picture, emits, again.samples);
  const std::vector<double> contrasts = squared_contrasts(picture.image, emits);
  std::size_t all = 0;
  for (const auto& [samples, group] : groups)
    all += group.size();
  for (const auto& [samples, group] : groups) {
    again.samples = static_cast<int>(samples);
    // Pixels of few samples are cheap; and one in a hundred may have all of the error.
    constexpr std::uint32_t few = 16;
    const std::size_t share = static_cast<std::size_t>(wanted) / groups.size();
    const ProbeChoice choice =
        choose_redrawn(group, contrasts, picture.image.width, share * std::max(1U, few / samples),
                       hash(again.seed, samples));
    const Radiances other = probe(again, choice.pixels);
    const auto square = [&](std::size_t k) {
      const glm::ivec2 pixel = choice.pixels[k];
      const glm::vec3 change = other[k] - picture.image.at(pixel.x, pixel.y);
      return product_of(choice.weight[k], change, change);
    };
    errors.pixels +=
        0.5 * double(group.size()) / double(all) * mean_of(choice.pixels.size(), square);
  }
}

/// The largest radiosity that surfaces reflect.
double largest_reflected(const IrradianceField& field) {
  double largest = 0.0;
  for (const Rgb& b : reflected_by_elements(field))
    largest = std::max({largest, b.r, b.g, b.b});
  return largest;
}

} // namespace

PictureErrorSettings error_settings(const TwoPassSettings& settings, std::size_t elements) {
  constexpr double share =
      0.02; // of the elements, each of which takes its rays twice: here and at a vertex
  PictureErrorSettings how;
  how.gathered_pixels = static_cast<int>(std::clamp(share * double(elements), 64.0, 512.0));
  how.pixels = std::min(8 * how.gathered_pixels, settings.render.width * settings.render.height);
  return how;
}

PictureError estimate_error(const IrradianceField& coarse, const Camera& camera,
                            const TwoPassSettings& asked, const SolverResult& solver,
                            const SampledPicture& picture, const PictureErrorSettings& how) {
  const IrradianceField& field = picture.finer ? *picture.finer : coarse;
  TwoPassSettings settings = asked;
  if (picture.finer)
    settings.render.diffuse.term = DiffuseTerm::interpolated;
  constexpr int emitter_samples = 4; // slivers of lamps that one misses are the error of no light
  constexpr double noise_of_interpolated = 4.0 / 9.0;
  Stopwatch watch;
  PictureError error;
  Probing probe{field, camera, settings};
  RenderSettings sized = settings.render;
  sized.layers = WithLayers::no;
  const auto emits = emitter_pixels(field, camera, sized, picture.image, emitter_samples);
  error.mean_radiance = mean_outside(picture.image, emits);
  const ProbeChoice choice =
      choose_probes(field, field_content(field, settings.render.diffuse), camera,
                    settings.render, emits, how.pixels);
  if (!(error.mean_radiance > 0.0) || choice.pixels.empty())
    return error;

  SquaredErrors squared;
  probe_field(probe, choice, static_cast<std::size_t>(how.gathered_pixels),
              picture.finer != nullptr, squared, error);
  probe_samples(probe, picture, emits, how.pixels, squared);

  // The parts make up the whole that was found, also where one of them alone was found larger.
  const double whole = std::max(squared.field, 0.0);
  const double tail = std::clamp(squared.tail, 0.0, whole);
  const double noise = std::min(noise_of_interpolated * squared.vertices, whole - tail);
  const auto relative = [&](double square) { return std::sqrt(square) / error.mean_radiance; };
  error.mirror_tail = relative(tail);
  error.form_factors = relative(noise);
  error.mesh = relative(whole - tail - noise);
  error.mesh_direct = relative(std::clamp(squared.source, 0.0, whole - tail - noise));
  error.pixels = relative(squared.pixels);
  error.solver = std::min(solver.relative_error, std::min(solver.error_bound, 1.0) * largest_reflected(field) /
                                                     (std::numbers::pi * error.mean_radiance));
  error.total =
      std::sqrt(whole + squared.pixels + std::pow(error.solver * error.mean_radiance, 2.0)) /
      error.mean_radiance;
  error.rays = probe.rays;
  error.seconds = watch.lap();
  return error;
}

} // namespace meninas
