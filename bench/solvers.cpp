// What solving costs: a sweep beside the memory's bandwidth, one band beside three, the solvers beside one another, and how time and memory
// grow with the number of elements.
//
//   solvers [SCENE.gltf]             all of them, while form factors fit
//   solvers SCENE.gltf progressive   shots by rays alone, to a million elements
//
// A sweep reads every form factor once: its bytes over its time is the rate that counts, beside that of a plain sum over an array of
// the same size, read by all threads in the same process. The two take turns; rates are medians.
#include "radiosity/pass_one.h"
#include "radiosity/solve.h"
#include "raytrace/two_pass.h"
#include "runs/resources.h"
#include "runs/run_settings.h"
#include "scenes/errors.h"
#include "scenes/gltf.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
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

System system_of(const char* file, double target_elements) {
  TwoPassSettings settings = two_pass_settings(RunSettings{});
  settings.pass_one.mesh.target_elements = target_elements;
  const auto prepared = prepare_scene(load_gltf(file), settings.pass_one);
  System system;
  system.seconds_of_factors = seconds_of([&] {
    system.transport =
        assemble_transport(*prepared->light, settings.pass_one.form_factors).transport;
  });
  // Solvers only care for the pattern: a little light everywhere, walls as they are.
  for (const SideId side : prepared->mesh.side_of_element) {
    system.reflectance.push_back(prepared->mesh.sides[index(side)].reflectance);
    system.source.push_back(Rgb(1.0) + prepared->mesh.sides[index(side)].emission);
  }
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

/// Elimination is cubic, and shots of single elements look for the brightest of all: neither is for large systems.
bool takes_seconds(SolverMethod method, const System& system) {
  return system.transport.size <=
         (method == SolverMethod::direct || method == SolverMethod::progressive ? 2500U : ~0U);
}

/// The same room with grey walls and light, and with the same values in three channels that differ in one place.
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

/// log-log slope between two measurements
double slope(double before, double after, double steps) {
  return std::log(after / before) / std::log(steps);
}

/// Pass one by shots, up to the radiosities; memory is the most the process has had.
void run_progressive(const char* file) {
  struct Measured {
    double elements = 0.0, solve = 0.0, all = 0.0, rays = 0.0, bytes = 0.0;
  } last;
  RunSettings draft;
  draft.quality = Quality::draft;
  for (const double target : {1e3, 1e4, 1e5, 1e6}) {
    PassOneSettings settings = two_pass_settings(draft).pass_one;
    settings.mesh.target_elements = target;
    settings.solver.method = SolverMethod::progressive;
    settings.interpolation.method = Interpolation::average;
    const auto prepared = prepare_scene(load_gltf(file), settings);
    Stopwatch watch;
    const RadiositySolution solution = solve_pass_one(*prepared->light, settings);
    const Measured now{static_cast<double>(element_count(prepared->mesh)), solution.seconds.solve,
                       watch.lap(), static_cast<double>(solution.form_factor_rays),
                       static_cast<double>(peak_memory_bytes())};
    fmt::print("{:>8.0f} elements: {:>6} shots {:>9.3f} s, pass one {:>9.3f} s, {:.3g} rays, peak "
               "memory {:.1f} MB, bound {:.1e}\n",
               now.elements, solution.solver.iterations, now.solve, now.all, now.rays,
               1e-6 * now.bytes, solution.solver.error_bound);
    if (last.elements > 0.0) {
      const double steps = now.elements / last.elements;
      fmt::print("log-log slopes: shots {:.2f}, pass one {:.2f}, rays {:.2f}, memory {:.2f}\n",
                 slope(last.solve, now.solve, steps), slope(last.all, now.all, steps),
                 slope(last.rays, now.rays, steps), slope(last.bytes, now.bytes, steps));
    }
    last = now;
  }
}

void run(const char* file) {
  double last_elements = 0.0, last_factors = 0.0, last_solve = 0.0, last_bytes = 0.0;
  for (const double target : {1e3, 4e3, 16e3, 64e3}) {
    const System system = system_of(file, target);
    const double elements = static_cast<double>(system.transport.size);
    const double bytes = static_cast<double>(bytes_of(system.transport));
    const double solving =
        seconds_of([&] { (void)solve(system.transport, system.source, system.reflectance); });
    fmt::print("--- {} elements: form factors {:.2f} s, solve {:.4f} s, {:.0f} bytes an element\n",
               elements, system.seconds_of_factors, solving, bytes / elements);
    if (last_elements > 0.0) {
      const double steps = elements / last_elements;
      fmt::print("log-log slopes: form factors {:.2f}, solve {:.2f}, memory {:.2f}\n",
                 slope(last_factors, system.seconds_of_factors, steps),
                 slope(last_solve, solving, steps), slope(last_bytes, bytes, steps));
    }
    last_elements = elements;
    last_factors = system.seconds_of_factors;
    last_solve = solving;
    last_bytes = bytes;
    compare_with_memory(system);
    compare_solvers(system);
    compare_bands(system);
  }
}

} // namespace

int main(int argc, char** argv) {
  try {
    if (argc > 2 && std::string_view(argv[2]) == "progressive")
      run_progressive(argv[1]);
    else
      run(argc > 1 ? argv[1] : MENINAS_BENCH_SCENE);
  } catch (const UserError& error) {
    fmt::print(stderr, "solvers: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
