#include "image/codecs/decoder_loader.h"

#include "scenes/errors.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <filesystem>
#include <future>
#include <string>
#include <vector>

namespace meninas::decoder {

namespace fs = std::filesystem;

static constexpr const char* module_name = "meninas_decoder.so";

/// The build tree and an installed tree agree on where the module is,
/// seen from a folder above the program:
/// in LIBDIR/meninas.
/// So nothing but the program's own place is needed to find it, and both trees can be moved.
/// A program of someone else that links the libraries finds the module
/// where it was configured to be installed, or on the loader's own path.
static std::vector<fs::path> module_candidates() {
  std::vector<fs::path> candidates;
  std::error_code error;
  auto folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (int level = 0; level < 4 && folder.has_relative_path();
       ++level, folder = folder.parent_path()) {
    const auto candidate = folder / MENINAS_MODULE_FOLDER / module_name;
    if (fs::exists(candidate, error))
      candidates.push_back(candidate);
  }
  const auto installed = fs::path(MENINAS_INSTALLED_MODULE_FOLDER) / module_name;
  if (fs::exists(installed, error))
    candidates.push_back(installed);
  candidates.emplace_back(module_name);
  return candidates;
}

/// The first candidate decides:
/// a broken module next to the program must not be covered up by an older one elsewhere.
/// It stays open to the end of the process, as its library owns threads.
static const Table* open_module() {
  const auto file = module_candidates().front();
  void* module = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (module == nullptr) {
    const char* reason = dlerror();
    throw InputError("", "", fmt::format("cannot open the module that reads pictures: {}", reason));
  }
  const auto entry = reinterpret_cast<EntryPoint>(dlsym(module, entry_point));
  const Table* table = entry == nullptr ? nullptr : entry();
  if (table == nullptr || table->seam_version != seam_version)
    throw InputError(file.string(), "", "the module that reads pictures belongs to another build");
  return table;
}

/// Opening always happens on the future's thread, so that `preload` is nothing but the first call.
/// The future's destructor waits for a module that
/// is still being opened when the program ends early.
static const std::shared_future<const Table*>& opening() {
  static const auto future = std::async(std::launch::async, open_module).share();
  return future;
}

void preload() { opening(); }

const Table& module_table() {
  const Table& table = *opening().get();
  const auto limit =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  table.use_threads(static_cast<int>(limit));
  return table;
}

} // namespace meninas::decoder
