#include "image/codecs/decoder_loader.h"

#include "image/module_file.h"

#include <oneapi/tbb/global_control.h>

#include <future>

namespace meninas::decoder {

static const Table* open_decoder() {
  const ModuleName name{"meninas_decoder.so", entry_point, "reads pictures"};
  const OpenModule module = open_module(name);
  const auto entry = reinterpret_cast<EntryPoint>(module.entry);
  const Table* table = entry == nullptr ? nullptr : entry();
  if (table == nullptr || table->seam_version != seam_version)
    refuse_module(name, module);
  return table;
}

/// Opening always happens on the future's thread, so that `preload` is nothing but the first call.
/// The future's destructor waits for a module that
/// is still being opened when the program ends early.
static const std::shared_future<const Table*>& opening() {
  static const auto future = std::async(std::launch::async, open_decoder).share();
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
