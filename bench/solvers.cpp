// What solving costs: a sweep beside the memory's bandwidth, one band beside three,
// the solvers beside one another, and how time and memory grow with the number of elements.
//
//   solvers [SCENE.gltf]          a sweep, bands, and the solvers beside one another
//   solvers SCENE.gltf growth     time and memory from a thousand elements to a million, with the rays of --quality draft: of nodes, of shots by
//                                 rays, which keep no form factors,
//                                 then of rows and the solvers that read them
//
// A sweep reads every form factor once: its bytes over its time is the rate that counts,
// beside that of a plain sum over an array of the same size,
// read by all threads in the same process. The two take turns; rates are medians.
#include "radiosity/pass_one.h"
#include "radiosity/solvers/solve.h"
#include "raytrace/two_pass.h"
#include "runs/resources.h"
#include "runs/run_settings.h"
#include "scenes/errors.h"
#include "scenes/gltf/gltf.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string_view>

using namespace meninas;

namespace {

constexpr int turns = 21;

double seconds_of(const std::function<void()>& work) {
  Stopwatch watch;
  work();
  return watch.lap();
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// Sums an array of 64-bit words with all threads.
std::uint64_t read_all(const std::vector<std::uint64_t>& words) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, words.size(), 1 << 16), std::uint64_t{0},
      [&](const auto& range, std::uint64_t sum) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
          sum += words[i];
        return sum;
      },
      std::plus<>());
}

std::size_t bytes_of(const Transport& transport) {
  return transport.columns.size() * sizeof(transport.columns[0]) +
         transport.weights.size() * sizeof(transport.weights[0]) +
         transport.row_begin.size() * sizeof(transport.row_begin[0]);
}

struct System {
  Transport transport;
  std::vector<Rgb> source, reflectance;
  double seconds_of_factors = 0.0;
};

System system_of(const char* file, double target_elements, const RunSettings& run = {}) {
  TwoPassSettings settings = two_pass_settings(run);
  settings.pass_one.mesh.target_elements = target_elements;
  const auto prepared = prepare_scene(load_gltf(file), settings.pass_one);
  System system;
  system.seconds_of_factors = seconds_of([&] {
    system.transport =
        assemble_transport(*prepared->light(), settings.pass_one.form_factors).transport;
  });
  // Solvers only care for the pattern: a little light everywhere, walls as they are.
  system.reflectance = prepared->mesh.reflectance;
  for (const Rgb& emission : prepared->mesh.emission)
    system.source.push_back(Rgb(1.0) + emission);
  return system;
}

void compare_with_memory(const System& system) {
  const std::size_t size = bytes_of(system.transport);
  const std::vector<std::uint64_t> words(size / 8, 1);
  const std::vector<Rgb> coloured(system.transport.size, Rgb(1.0, 0.9, 0.8));
  std::vector<double> memory, three, one;
  std::uint64_t sum = 0;
  for (int turn = 0; turn < turns; ++turn) {
    memory.push_back(seconds_of([&] { sum += read_all(words); }));
    three.push_back(seconds_of([&] { (void)apply_transport(system.transport, coloured); }));
  }
  const auto rate = [&](const std::vector<double>& seconds) {
    return 1e-9 * static_cast<double>(size) / median(seconds);
  };
  fmt::print("factors {:.1f} MB, {:.2f} ns an entry; memory {:.1f} GB/s{}, sweep {:.1f} GB/s: "
             "{:.2f} of it\n",
             1e-6 * static_cast<double>(size),
             1e9 * median(three) / static_cast<double>(system.transport.columns.size()),
             rate(memory), sum == 0 ? "!" : "", rate(three), rate(three) / rate(memory));
}

/// Elimination is cubic, and shots of single elements look for the brightest of all:
/// neither is for large systems.
bool takes_seconds(SolverMethod method, const System& system) {
  return system.transport.size <=
         (method == SolverMethod::direct || method == SolverMethod::progressive ? 2500U : ~0U);
}

/// The same room with grey walls and light,
/// and with the same values in three channels that differ in one place.
void compare_bands(System system) {
  if (system.transport.bands != 1)
    return;
  for (auto* values : {&system.source, &system.reflectance})
    for (auto& value : *values)
      value = Rgb(value.g);
  System coloured{system.transport, system.source, system.reflectance};
  coloured.source[0].r *= 1.5;
  for (const SolverMethod method : solver_methods) {
    if (!takes_seconds(method, system))
      continue;
    std::vector<double> ratios;
    for (int turn = 0; turn < (method == SolverMethod::direct ? 1 : turns); ++turn) {
      const double grey = seconds_of([&] {
        (void)solve(system.transport, system.source, system.reflectance, {method, 1e-6});
      });
      ratios.push_back(
          grey / seconds_of([&] {
            (void)solve(coloured.transport, coloured.source, coloured.reflectance, {method, 1e-6});
          }));
    }
    fmt::print("one band takes {:.2f} of the time of three: {}\n", median(ratios), name_of(method));
  }
}

void compare_solvers(const System& system) {
  for (const double tolerance : {1e-4, 1e-8})
    for (const SolverMethod method : solver_methods) {
      if (!takes_seconds(method, system))
        continue;
      SolverResult result;
      std::vector<double> seconds;
      for (int turn = 0; turn < (method == SolverMethod::direct ? 1 : 5); ++turn)
        seconds.push_back(seconds_of([&] {
          result = solve(system.transport, system.source, system.reflectance, {method, tolerance});
        }));
      fmt::print("{:<14}to {:.0e}: {:>4} iterations {:>9.4f} s, bound {:.1e}\n", name_of(method),
                 tolerance, result.iterations, median(seconds), result.error_bound);
    }
}

struct Figure {
  const char* name;
  double value;
};

/// Measurements at one size.
struct Measured {
  double elements = 0.0;
  std::vector<Figure> figures;
};

/// Prints the last of them, and its log-log slopes from the one before.
void print_growth(const std::vector<Measured>& sizes) {
  const Measured& now = sizes.back();
  fmt::print("{:>8.0f} elements:", now.elements);
  for (const Figure& figure : now.figures)
    fmt::print(" {} {:.4g};", figure.name, figure.value);
  fmt::print("\n");
  if (sizes.size() < 2)
    return;
  const Measured& before = sizes[sizes.size() - 2];
  fmt::print("  log-log slopes:");
  for (std::size_t k = 0; k < now.figures.size(); ++k)
    fmt::print(" {} {:.2f};", now.figures[k].name,
               std::log(now.figures[k].value / before.figures[k].value) /
                   std::log(now.elements / before.elements));
  fmt::print("\n");
}

constexpr std::array growing{1e3, 1e4, 1e5, 1e6};

RunSettings draft() {
  RunSettings settings;
  settings.quality = Quality::draft;
  settings.mesh = MeshCut::uniform;
  return settings;
}

/// Pass one by shots; memory is the most that the process has had.
void grow_shots(const char* file) {
  std::vector<Measured> sizes;
  for (const double target : growing) {
    PassOneSettings settings = two_pass_settings(draft()).pass_one;
    settings.mesh.target_elements = target;
    settings.solver.method = SolverMethod::progressive;
    settings.interpolation.method = Interpolation::average;
    const auto prepared = prepare_scene(load_gltf(file), settings);
    Stopwatch watch;
    const RadiositySolution solution = shoot_pass_one(prepared->light(), settings);
    sizes.push_back({static_cast<double>(element_count(prepared->mesh)),
                     {{"shots", static_cast<double>(solution.solver.iterations)},
                      {"s of shots", solution.seconds.solve},
                      {"s of pass one", watch.lap()},
                      {"rays", static_cast<double>(solution.form_factor_rays)},
                      {"peak MB", 1e-6 * static_cast<double>(peak_memory_bytes())}}});
    print_growth(sizes);
  }
}

/// Pass one by nodes, at the same link error for all sizes.
void grow_nodes(const char* file) {
  std::vector<Measured> sizes;
  for (const double target : growing) {
    PassOneSettings settings = two_pass_settings(draft()).pass_one;
    settings.mesh.target_elements = target;
    settings.cut = MeshCut::hierarchical;
    const auto prepared = prepare_scene(load_gltf(file), settings);
    Stopwatch watch;
    const RadiositySolution solution = solve_pass_one(prepared->light(), settings);
    const auto elements = static_cast<double>(element_count(prepared->mesh));
    sizes.push_back({elements,
                     {{"receivers", static_cast<double>(solution.links->receivers)},
                      {"links", static_cast<double>(solution.links->links)},
                      {"bytes an element", static_cast<double>(solution.links->bytes) / elements},
                      {"s of pass one", watch.lap()},
                      {"rays", static_cast<double>(solution.form_factor_rays)}}});
    print_growth(sizes);
  }
}

/// Rows and the solvers that read them; memory is that of the rows.
void grow_rows(const char* file) {
  std::vector<Measured> sizes;
  for (const double target : growing) {
    const System system = system_of(file, target, draft());
    Measured now{static_cast<double>(system.transport.size),
                 {{"s of form factors", system.seconds_of_factors},
                  {"MB of rows", 1e-6 * static_cast<double>(bytes_of(system.transport))}}};
    for (const SolverMethod method :
         {SolverMethod::bicgstab, SolverMethod::gauss_seidel, SolverMethod::jacobi})
      now.figures.push_back({name_of(method), seconds_of([&] {
                               (void)solve(system.transport, system.source, system.reflectance,
                                           {method});
                             })});
    sizes.push_back(std::move(now));
    print_growth(sizes);
  }
}

void run(const char* file) {
  for (const double target : {1e3, 4e3, 16e3, 64e3}) {
    const System system = system_of(file, target);
    fmt::print("--- {} elements\n", system.transport.size);
    compare_with_memory(system);
    compare_solvers(system);
    compare_bands(system);
  }
}

} // namespace

int main(int argc, char** argv) {
  try {
    if (argc > 2 && std::string_view(argv[2]) == "growth") {
      grow_nodes(argv[1]);
      grow_shots(argv[1]);
      grow_rows(argv[1]);
    } else {
      run(argc > 1 ? argv[1] : MENINAS_BENCH_SCENE);
    }
  } catch (const UserError& error) {
    fmt::print(stderr, "solvers: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
