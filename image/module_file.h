// Modules of the program: shared objects that are opened where something of theirs is first used, so that
// libraries that only some runs want cost the others no time at their start.
//
// The build tree and an installed tree agree on where modules are, seen from a folder above the program, or the shared
// library: in LIBDIR/meninas. So nothing but its own place is needed to find them, and both trees can be moved; a
// library that was copied has them in meninas/ beside it. Else they are where they were configured to be installed, or
// on the loader's own path.
#pragma once

#include <filesystem>

namespace meninas {

struct ModuleName {
  const char* file;  ///< "meninas_decoder.so"
  const char* entry; ///< its one symbol, a function that returns a table
  const char* task;  ///< "reads pictures"
};

/// A module that stays open to the end of the process, as its libraries may own threads.
struct OpenModule {
  std::filesystem::path file;
  void* entry = nullptr; ///< null: it has no such symbol
};

/// The first candidate decides: a broken module next to the program must not be covered up by an older one elsewhere.
/// Throws InputError where it is missing or does not load.
OpenModule open_module(const ModuleName& name);

/// For whoever finds that a table is not of this build.
[[noreturn]] void refuse_module(const ModuleName& name, const OpenModule& module);

} // namespace meninas
