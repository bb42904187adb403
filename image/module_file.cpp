#include "image/module_file.h"

#include "scenes/errors.h"

#include <dlfcn.h>
#include <fmt/format.h>

namespace meninas {

namespace fs = std::filesystem;

/// The shared library that this code is in, where it is in one, else the program.
static fs::path own_file() {
  std::error_code error;
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&own_file), &info) != 0 && info.dli_fname != nullptr)
    if (const fs::path file = fs::canonical(info.dli_fname, error);
        !error && file.filename().string().find(".so") != std::string::npos)
      return file;
  return fs::read_symlink("/proc/self/exe", error);
}

static fs::path module_place(const char* name) {
  std::error_code error;
  auto folder = own_file().parent_path();
  // Beside a library that was copied somewhere, with its modules.
  if (fs::path beside = folder / "meninas" / name; fs::exists(beside, error))
    return beside;
  for (int level = 0; level < 4 && folder.has_relative_path(); ++level, folder = folder.parent_path()) {
    fs::path candidate = folder / MENINAS_MODULE_FOLDER / name;
    if (fs::exists(candidate, error))
      return candidate;
  }
  fs::path installed = fs::path(MENINAS_INSTALLED_MODULE_FOLDER) / name;
  return fs::exists(installed, error) ? installed : fs::path(name);
}

OpenModule open_module(const ModuleName& name) {
  OpenModule module{module_place(name.file)};
  void* const handle = dlopen(module.file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (handle == nullptr) {
    const char* reason = dlerror();
    throw InputError("", "", fmt::format("cannot open the module that {}: {}", name.task, reason));
  }
  module.entry = dlsym(handle, name.entry);
  return module;
}

void refuse_module(const ModuleName& name, const OpenModule& module) {
  throw InputError(module.file.string(), "", fmt::format("the module that {} belongs to another build", name.task));
}

} // namespace meninas
