#include "radiosity/form_factors.h"

#include "radiosity/gather_rays.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>

namespace meninas {

namespace {

constexpr std::size_t chunk_size = 64; ///< rows a task assembles; fixed, so that nothing depends on the number of threads

/// Rows of one chunk, to be strung together in order.
struct RowChunk {
  std::vector<std::uint32_t> lengths;
  std::vector<std::uint32_t> columns;
  std::vector<float> weights;
  std::uint64_t rays = 0;
};

/// Gathers the landings of one row by element: a dense table of places, reset by its own list.
struct RowAccumulator {
  std::vector<std::uint32_t> place; ///< by element: 1 + its place in `columns`, or 0
  std::vector<std::uint32_t> columns;
  std::vector<glm::vec3> weights;

  void add(std::uint32_t element, const glm::vec3& weight) {
    if (place[element] == 0) {
      columns.push_back(element);
      weights.push_back(weight);
      place[element] = static_cast<std::uint32_t>(columns.size());
    } else {
      weights[place[element] - 1] += weight;
    }
  }
  void clear() {
    for (const auto column : columns) place[column] = 0;
    columns.clear();
    weights.clear();
  }
};

struct Workspace {
  GatherWorkspace gather;
  RowAccumulator row;
};

bool grey_mirrors(const Scene& scene) {
  return std::all_of(scene.materials.begin(), scene.materials.end(), [](const Material& material) {
    const Rgb r = mirror_reflectance(material);
    return r.r == r.g && r.g == r.b;
  });
}

/// Fractions of the rays of the exposed part.
RowClosure closure_of(const GatheredRays& gathered, std::size_t rays) {
  const std::size_t exposed = rays - gathered.covered_rays;
  RowClosure closure;
  if (exposed == 0) {
    closure.black = 1.0F;
    closure.black_light = glm::vec3(1.0F);
    return closure;
  }
  const float share = 1.0F / static_cast<float>(exposed);
  const auto black = gathered.black - gathered.covered_rays;
  closure.escaped = static_cast<float>(gathered.escaped) * share;
  closure.black = static_cast<float>(black) * share;
  closure.cut = static_cast<float>(gathered.cut) * share;
  closure.landed = static_cast<float>(exposed - gathered.escaped - black - gathered.cut) * share;
  closure.mirror_absorbed = gathered.mirror_absorbed * share;
  closure.escaped_light = gathered.escaped_light * share;
  closure.black_light = (gathered.black_light - static_cast<float>(gathered.covered_rays)) * share;
  closure.cut_light = gathered.cut_light * share;
  return closure;
}

/// Appends the accumulated row to its chunk as fractions of the light that was not cut, so that a row still closes.
void append_row(const RowAccumulator& row, const Rgb& kept, int bands, RowChunk& chunk) {
  chunk.lengths.push_back(static_cast<std::uint32_t>(row.columns.size()));
  chunk.columns.insert(chunk.columns.end(), row.columns.begin(), row.columns.end());
  const glm::vec3 share(1.0 / kept);
  for (const auto& weight : row.weights)
    for (int band = 0; band < bands; ++band) chunk.weights.push_back(weight[band] * share[band]);
}

Transport string_together(std::vector<RowChunk>& chunks, std::size_t size, int bands) {
  Transport transport;
  transport.size = size;
  transport.bands = bands;
  std::size_t entries = 0;
  for (const auto& chunk : chunks) entries += chunk.columns.size();
  transport.row_begin.reserve(size + 1);
  transport.row_begin.push_back(0);
  transport.columns.reserve(entries);
  transport.weights.reserve(entries * static_cast<std::size_t>(bands));
  for (auto& chunk : chunks) {
    for (const auto length : chunk.lengths) transport.row_begin.push_back(transport.row_begin.back() + length);
    transport.columns.insert(transport.columns.end(), chunk.columns.begin(), chunk.columns.end());
    transport.weights.insert(transport.weights.end(), chunk.weights.begin(), chunk.weights.end());
    chunk = {};
  }
  return transport;
}

} // namespace

FormFactors assemble_transport(const LightScene& light, const FormFactorSettings& settings, const Progress& progress) {
  const std::size_t size = element_count(light.mesh);
  const DirectionNet net = make_direction_net(settings.rays);
  const std::size_t rays = net.points.size();
  const int bands = grey_mirrors(light.scene) ? 1 : 3;

  FormFactors result;
  result.closure.resize(size);
  result.covered.resize(size);
  result.exposed.resize(size);
  result.gathered_emission.resize(size);
  std::vector<RowChunk> chunks((size + chunk_size - 1) / chunk_size);
  tbb::enumerable_thread_specific<Workspace> workspaces;
  std::atomic<std::size_t> done{0};

  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    Workspace& work = workspaces.local();
    work.row.place.resize(size, 0);
    const std::size_t end = std::min(size, (c + 1) * chunk_size);
    for (std::size_t i = c * chunk_size; i < end; ++i) {
      const auto element = static_cast<ElementId>(i);
      const auto seed = hash(static_cast<std::uint32_t>(i), settings.seed, 0x9a7e);
      gather_rays(light, net, receiver_of(light, element), seed, settings, work.gather);
      const GatheredRays& gathered = work.gather.result;
      const Rgb kept = kept_light(gathered, rays);
      result.covered[i] = gathered.covered;
      result.exposed[i] = 1.0F - static_cast<float>(std::popcount(gathered.covered)) / 64.0F;
      for (const auto& landing : gathered.landings) {
        work.row.add(landing.element, landing.throughput);
        result.gathered_emission[i] += gathered_emission(light, landing) / kept;
      }
      result.closure[i] = closure_of(gathered, rays);
      append_row(work.row, kept, bands, chunks[c]);
      work.row.clear();
      chunks[c].rays += gathered.traced;
    }
    if (progress) progress("form factors", static_cast<double>(++done) / static_cast<double>(chunks.size()));
  });

  for (const auto& chunk : chunks) result.rays_traced += chunk.rays;
  result.transport = string_together(chunks, size, bands);
  return result;
}

} // namespace meninas
