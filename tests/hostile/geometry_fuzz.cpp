// Throws hostile geometry at everything behind the loader: scene after scene from seeds that count
// up, each in a process of its own with a limit of processor time. What crashes, hangs or breaks
// what must hold (every_command.h) is a finding, and the seed says it all:
//
//   geometry_fuzz [--seed N] [--count N | --seconds S] [--limit S] [--write FOLDER]
//
// --limit is of processor time for a scene; --write keeps the file of each finding.
// The exit code is 1 where there are findings.
#include "tests/hostile/every_command.h"
#include "tests/hostile/hostile_scene.h"

#include <oneapi/tbb/global_control.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

namespace {

using namespace meninas;
using namespace meninas::test;

struct Options {
  std::uint32_t seed = 1;
  std::uint32_t count = 200;
  double seconds = 0.0; ///< of the clock; 0: count alone decides
  rlim_t limit = 60;    ///< of processor time
  std::string folder;
};

enum class End { clean, refused, found };

/// In a process of its own: returns its exit code.
int try_seed(std::uint32_t seed) {
  // One thread, so that a limit of processor time is one of time.
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  try {
    Scene scene = read_gltf(as_glb(hostile_scene(seed)), "/nonexistent/fuzz/scene.glb");
    Random random(~seed);
    run_every_command(std::move(scene), random, {});
    return static_cast<int>(End::clean);
  } catch (const UserError&) {
    return static_cast<int>(End::refused);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "seed %u: %s\n", seed, error.what());
    return static_cast<int>(End::found);
  }
}

struct Outcome {
  End end = End::clean;
  double seconds = 0.0; ///< of processor time
};

Outcome outcome_of(std::uint32_t seed, rlim_t limit) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    const rlimit processor{limit, limit + 5};
    setrlimit(RLIMIT_CPU, &processor);
    _exit(try_seed(seed));
  }
  int status = 0;
  rusage used{};
  wait4(child, &status, 0, &used);
  const auto in_seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  Outcome outcome{End::found, in_seconds(used.ru_utime) + in_seconds(used.ru_stime)};
  if (WIFEXITED(status) && WEXITSTATUS(status) <= static_cast<int>(End::refused))
    outcome.end = static_cast<End>(WEXITSTATUS(status));
  else if (WIFSIGNALED(status))
    std::fprintf(stderr, "seed %u: %s\n", seed,
                 WTERMSIG(status) == SIGXCPU ? "does not end" : strsignal(WTERMSIG(status)));
  return outcome;
}

template <typename Number>
bool read(const char* text, Number& number) {
  const char* end = text + std::strlen(text);
  const auto [last, error] = std::from_chars(text, end, number);
  return error == std::errc() && last == end;
}

std::optional<Options> options_of(int count, char** arguments) {
  Options options;
  for (int k = 1; k + 1 < count; k += 2) {
    const std::string_view name = arguments[k];
    const char* value = arguments[k + 1];
    const bool good = name == "--seed"      ? read(value, options.seed)
                      : name == "--count"   ? read(value, options.count)
                      : name == "--seconds" ? read(value, options.seconds)
                      : name == "--limit"   ? read(value, options.limit)
                      : name == "--write"   ? !(options.folder = value).empty()
                                            : false;
    if (!good)
      return std::nullopt;
  }
  return count % 2 == 1 ? std::optional(options) : std::nullopt;
}

void keep(std::uint32_t seed, const std::string& folder) {
  const Bytes glb = as_glb(hostile_scene(seed));
  std::filesystem::create_directories(folder);
  std::ofstream(std::filesystem::path(folder) / ("seed-" + std::to_string(seed) + ".glb"),
                std::ios::binary)
      .write(reinterpret_cast<const char*>(glb.data()), static_cast<std::streamsize>(glb.size()));
}

} // namespace

int main(int count, char** arguments) {
  const auto options = options_of(count, arguments);
  if (!options) {
    std::fputs("usage: geometry_fuzz [--seed N] [--count N | --seconds S] [--limit S] [--write FOLDER]\n",
               stderr);
    return 2;
  }
  const auto start = std::chrono::steady_clock::now();
  const auto goes_on = [&](std::uint32_t done) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    return options->seconds > 0.0 ? passed.count() < options->seconds : done < options->count;
  };
  std::uint32_t tried = 0, refused = 0, found = 0;
  double processor = 0.0, longest = 0.0;
  std::uint32_t slowest = options->seed;
  for (; goes_on(tried); ++tried) {
    const std::uint32_t seed = options->seed + tried;
    const Outcome outcome = outcome_of(seed, options->limit);
    processor += outcome.seconds;
    refused += outcome.end == End::refused ? 1 : 0;
    if (outcome.seconds > longest) {
      longest = outcome.seconds;
      slowest = seed;
    }
    if (outcome.end != End::found)
      continue;
    ++found;
    if (!options->folder.empty())
      keep(seed, options->folder);
  }
  std::printf("%u scenes from seed %u, %u refused, %u findings; %.0f s of processor time, at most %.1f s "
              "(seed %u)\n",
              tried, options->seed, refused, found, processor, longest, slowest);
  return found > 0 ? 1 : 0;
}
