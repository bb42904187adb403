#include "radiosity/transport/form_factors.h"

#include "radiosity/mesh/small_surfaces.h"
#include "radiosity/scene/small_elements.h"
#include "radiosity/transport/analytic_rows.h"
#include "radiosity/transport/element_hemicube.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <span>

namespace meninas {

namespace {

constexpr std::size_t chunk_size =
    64; ///< rows a task assembles; fixed, so that nothing depends on the number of threads

struct RowList {
  std::vector<std::uint32_t> lengths;
  std::vector<std::uint32_t> columns;
  std::vector<float> weights;
};

/// Rows of one chunk, to be strung together in order; storage reused from one to another.
struct RowChunk {
  RowList transport, beyond;
  std::uint64_t rays = 0;
};

/// Gathers the landings of one row by element: a dense table of places, reset by its own list.
struct RowAccumulator {
  std::vector<std::uint32_t> place; ///< by element: 1 + its place in `columns`, or 0
  std::vector<std::uint32_t> columns;
  std::vector<glm::vec3> weights;
  std::size_t used = 0; ///< of columns and weights

  void make_room(std::size_t entries) {
    if (columns.size() >= entries)
      return;
    columns.resize(entries);
    weights.resize(entries);
  }
  /// Without a branch on what no processor can foresee:
  /// whether the element is new. There must be room for it.
  void add(std::uint32_t element, const glm::vec3& weight) {
    const bool fresh = place[element] == 0;
    const std::size_t at = fresh ? used : place[element] - 1;
    columns[at] = element;
    weights[at] = (fresh ? 0.0F : 1.0F) * weights[at] + weight;
    place[element] = static_cast<std::uint32_t>(at + 1);
    used += fresh ? 1 : 0;
  }
  void clear() {
    for (std::size_t k = 0; k < used; ++k)
      place[columns[k]] = 0;
    used = 0;
  }
};

struct Workspace {
  GatherWorkspace gather;
  RowAccumulator row, beyond;
};

/// By ElementId: 1 where what lies beyond the enumerated worlds may matter.
std::vector<std::uint8_t> kept_beyond(const ElementMesh& mesh, const FormFactorSettings& settings) {
  std::vector<std::uint8_t> kept;
  kept.reserve(mesh.emission.size());
  for (const Rgb& emission : mesh.emission)
    kept.push_back(settings.relightable || emission != Rgb(0.0) ? 1 : 0);
  return kept;
}

Transport empty_transport(std::size_t size, int bands) {
  Transport transport;
  transport.size = size;
  transport.bands = bands;
  transport.row_begin.reserve(size + 1);
  transport.row_begin.push_back(0);
  return transport;
}

/// Appends the accumulated row to the others as fractions of the light that was not cut,
/// so that a row still closes.
void append_row(const RowAccumulator& row, const Rgb& kept, int bands, RowList& rows) {
  const auto columns = std::span(row.columns).first(row.used);
  rows.lengths.push_back(static_cast<std::uint32_t>(columns.size()));
  rows.columns.insert(rows.columns.end(), columns.begin(), columns.end());
  const glm::vec3 share(1.0 / kept);
  const std::size_t first = rows.weights.size();
  rows.weights.resize(first + columns.size() * static_cast<std::size_t>(bands));
  float* to = rows.weights.data() + first;
  for (const auto& weight : std::span(row.weights).first(row.used))
    for (int band = 0; band < bands; ++band)
      *to++ = weight[band] * share[band];
}

void clear(RowList& rows) {
  rows.lengths.clear();
  rows.columns.clear();
  rows.weights.clear();
}

void clear(RowChunk& chunk) {
  clear(chunk.transport);
  clear(chunk.beyond);
  chunk.rays = 0;
}

/// Makes room for more without moving what is there again and again:
/// as much as all rows need if they are like those so far.
template <typename Value>
void make_room(std::vector<Value>& values, std::size_t more, double share_done) {
  const std::size_t needed = values.size() + more;
  if (values.capacity() >= needed)
    return;
  constexpr double margin = 1.25; // room that is not used is never touched
  values.reserve(std::max(
      2 * needed, static_cast<std::size_t>(margin * static_cast<double>(needed) / share_done)));
}

/// Appends the rows of the next more.
void append_rows(const RowList& more, Transport& transport) {
  const std::size_t rows = transport.row_begin.size() - 1 + more.lengths.size();
  const double share_done = static_cast<double>(rows) / static_cast<double>(transport.size);
  make_room(transport.columns, more.columns.size(), share_done);
  make_room(transport.weights, more.weights.size(), share_done);
  for (const auto length : more.lengths)
    transport.row_begin.push_back(transport.row_begin.back() + length);
  transport.columns.insert(transport.columns.end(), more.columns.begin(), more.columns.end());
  transport.weights.insert(transport.weights.end(), more.weights.begin(), more.weights.end());
}

/// The data that the tasks share.
struct Assembly {
  const LightScene& light;
  const FormFactorSettings& settings;
  HemisphereSamples net; ///< `rays`: what is traced; `hemicube`: what finds the covered part
  HemisphereSamples few; ///< `rays`: what is traced of receivers on which little depends
  HemisphereSamples many; ///< `rays`: what is traced of clusters of faces
  Hemicube cube;    ///< `hemicube`
  std::vector<std::uint8_t>
      beyond; ///< by ElementId: 1 where its row beyond the enumerated worlds is kept
  int bands;
  const RowReceiver& receiver;
  std::size_t first_row; ///< of those that are made
};

/// A cluster stands for so many faces that noise of its row would show over all of them: with N rays it
/// leaves a squared error of N^-3/2, so that most is done where N goes with the area to the power of 0.4.
constexpr int rays_of_cluster = 4; // that of 32 faces

const HemisphereSamples& net_of(const Assembly& assembly, const ReceiverArea& element) {
  return element.reduced_rays ? assembly.few : element.faces.empty() ? assembly.net : assembly.many;
}

void gather(const Assembly& assembly, const ReceiverArea& element, std::uint32_t seed,
            GatherWorkspace& work) {
  switch (assembly.settings.method) {
  case FormFactorMethod::rays:
    gather_rays(assembly.light, net_of(assembly, element), element, seed, assembly.settings, work);
    break;
  case FormFactorMethod::hemicube:
    gather_element(assembly.light, {assembly.cube, assembly.net}, element, seed, assembly.settings,
                   work);
    break;
  case FormFactorMethod::analytic: // has rows of its own
    break;
  }
}

void assemble_row(const Assembly& assembly, std::size_t row, Workspace& work, RowChunk& chunk,
                  FormFactors& result) {
  const std::size_t number = assembly.first_row + row;
  const auto seed = hash(static_cast<std::uint32_t>(number), assembly.settings.seed, 0x9a7e);
  gather(assembly, assembly.receiver(number), seed, work.gather);
  const GatheredRays& gathered = work.gather.result;
  const Rgb kept = kept_light(gathered);
  result.covered[row] = gathered.covered;
  result.exposed[row] = gathered.exposed;
  result.closure[row] = closure_of(gathered);
  work.row.make_room(gathered.landings.size());
  work.beyond.make_room(gathered.landings.size());
  for (const auto& landing : gathered.landings) {
    work.row.add(landing.element, landing.light);
    if (landing.world == none<WorldId> && assembly.beyond[landing.element] != 0)
      work.beyond.add(landing.element, landing.light);
  }
  append_row(work.row, kept, assembly.bands, chunk.transport);
  append_row(work.beyond, kept, assembly.bands, chunk.beyond);
  work.row.clear();
  work.beyond.clear();
  chunk.rays += gathered.traced;
}

/// Strings chunks together in their order, whichever threads assemble them.
class OrderedRows {
public:
  OrderedRows(FormFactors& result, std::size_t count, const Progress& progress)
      : result_(result), count_(count), progress_(progress) {}

  /// An empty one, with the storage of another before it.
  RowChunk unused() {
    const std::lock_guard lock(mutex_);
    if (spare_.empty())
      return {};
    RowChunk chunk = std::move(spare_.back());
    spare_.pop_back();
    return chunk;
  }

  /// Chunk number c, which waits until all before it are there.
  void append(std::size_t c, RowChunk&& assembled) {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(c, std::move(assembled));
    for (auto first = waiting_.begin(); first != waiting_.end() && first->first == done_;
         first = waiting_.erase(first)) {
      RowChunk& chunk = first->second;
      append_rows(chunk.transport, result_.transport);
      append_rows(chunk.beyond, result_.beyond);
      result_.rays_traced += chunk.rays;
      clear(chunk);
      spare_.push_back(std::move(chunk));
      ++done_;
      if (progress_)
        progress_("form factors", static_cast<double>(done_) / static_cast<double>(count_));
    }
  }

private:
  FormFactors& result_;
  std::size_t count_, done_ = 0;
  const Progress& progress_;
  std::mutex mutex_;
  std::map<std::size_t, RowChunk> waiting_;
  std::vector<RowChunk> spare_;
};

} // namespace

static FormFactors assemble(const LightScene& light, RowRange range, const RowReceiver& receiver,
                            const FormFactorSettings& settings, const Progress& progress);

FormFactors assemble_transport(const LightScene& light, const FormFactorSettings& settings,
                               const Progress& progress) {
  if (settings.method == FormFactorMethod::analytic)
    return analytic_transport(light, settings, progress);
  return assemble_some_rows(light, {0, element_count(light.mesh)}, settings, progress);
}

FormFactors assemble_some_rows(const LightScene& light, RowRange rows,
                               const FormFactorSettings& settings, const Progress& progress) {
  const auto element = [&](std::size_t row) {
    ReceiverArea receiver = receiver_of(light, static_cast<ElementId>(row));
    receiver.reduced_rays = has_reduced_rays(light, static_cast<ElementId>(row));
    return receiver;
  };
  FormFactors factors = assemble(light, rows, element, settings, progress);
  for (std::size_t row = 0; row < rows.count; ++row)
    factors.exposed[row] *= light.mesh.solid[rows.first + row];
  return factors;
}

FormFactors assemble_rows(const LightScene& light, std::size_t size, const RowReceiver& receiver,
                          const FormFactorSettings& settings, const Progress& progress) {
  return assemble(light, {0, size}, receiver, settings, progress);
}

static FormFactors assemble(const LightScene& light, RowRange range, const RowReceiver& receiver,
                            const FormFactorSettings& settings, const Progress& progress) {
  expects(settings.method != FormFactorMethod::analytic, "rows of parts are sampled");
  const std::size_t size = range.count;
  const bool by_cubes = settings.method == FormFactorMethod::hemicube;
  const Assembly assembly{light,
                          settings,
                          by_cubes ? make_coverage_net() : make_direction_net(settings.rays),
                          make_direction_net(reduced_count(settings.rays, 16)),
                          is_finely_tessellated(light.mesh)
                              ? make_direction_net(rays_of_cluster * settings.rays)
                              : HemisphereSamples{},
                          by_cubes ? make_hemicube(settings.hemicube_resolution) : Hemicube{},
                          kept_beyond(light.mesh, settings),
                          grey_mirrors(light.scene) ? 1 : 3,
                          receiver,
                          range.first};
  FormFactors result;
  result.closure.resize(size);
  result.covered.resize(size);
  result.exposed.resize(size);
  result.transport = empty_transport(size, assembly.bands);
  result.beyond = empty_transport(size, assembly.bands);

  const std::size_t chunk_count = (size + chunk_size - 1) / chunk_size;
  tbb::enumerable_thread_specific<Workspace> workspaces;
  OrderedRows rows{result, chunk_count, progress};
  std::atomic<std::size_t> next{0};
  tbb::parallel_for(std::size_t{0}, chunk_count, [&](std::size_t) {
    const std::size_t c = next++; // begun in order, so that few wait for their turn
    RowChunk chunk = rows.unused();
    Workspace& work = workspaces.local();
    work.row.place.resize(element_count(light.mesh), 0);
    work.beyond.place.resize(element_count(light.mesh), 0);
    for (std::size_t row = c * chunk_size; row < std::min(size, (c + 1) * chunk_size); ++row)
      assemble_row(assembly, row, work, chunk, result);
    rows.append(c, std::move(chunk));
  });
  return result;
}

RowClosure closure_of(const GatheredRays& gathered) {
  const double exposed = gathered.rays - gathered.covered_rays;
  RowClosure closure;
  if (exposed == 0.0) {
    closure.black = 1.0F;
    closure.black_light = glm::vec3(1.0F);
    return closure;
  }
  closure.landed = static_cast<float>(gathered.landed / exposed);
  closure.escaped = static_cast<float>(gathered.escaped / exposed);
  closure.black = static_cast<float>((gathered.black - gathered.covered_rays) / exposed);
  closure.cut = static_cast<float>(gathered.cut / exposed);
  const auto share = static_cast<float>(1.0 / exposed);
  closure.mirror_absorbed = gathered.mirror_absorbed * share;
  closure.escaped_light = gathered.escaped_light * share;
  closure.sky = gathered.sky * share;
  closure.owned_light = gathered.owned_light * share;
  closure.by_portals = gathered.by_portals * share;
  closure.black_light = (gathered.black_light - static_cast<float>(gathered.covered_rays)) * share;
  closure.cut_light = gathered.cut_light * share;
  return closure;
}

} // namespace meninas
