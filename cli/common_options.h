// Options that several commands share;
// their help takes defaults from the presets and settings themselves.
#pragma once

#include "cli/options.h"
#include "runs/run_events.h"
#include "runs/run_settings.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace meninas {

/// Stands for the preset's number where an option may leave its value out.
inline constexpr const char* preset_value = "preset";

enum class Verbosity { normal, quiet };

/// The options of every command.
struct CommonOptions {
  std::filesystem::path scene;
  RunSettings settings;
  Verbosity verbosity = Verbosity::normal;
  std::vector<std::string> notes; ///< on how options were read, a sentence each
};

void add_scene(Options& command, CommonOptions& options);
/// The option that add_scene adds, for commands that get their scenes otherwise.
void add_allow_external(Options& command, GltfSettings& settings);
/// The variant of the materials, and the moment of the animations.
void add_state_options(Options& command, CommonOptions& options);
void add_quality(Options& command, CommonOptions& options);

/// The fineness of the mesh and the depth of mirrors, on which a plan depends too.
void add_mesh_options(Options& command, CommonOptions& options);

/// The rest of pass one.
void add_pass_one_options(Options& command, CommonOptions& options);

/// "direct", "gather", ... as `--diffuse` takes them.
DiffuseTerm parse_diffuse(const std::string& text);

/// The light of a scene beyond its own lights.
void add_light_options(Options& command, CommonOptions& options);

/// Throws UsageError when an option was given that the chosen methods do not obey.
void check_pass_one_options(const Options& command, const RunSettings& settings);

/// Threads, seed, quiet.
void add_run_options(Options& command, CommonOptions& options);

/// All of the above but the scene, in the order of the help: what `solve` asks for.
void add_solve_options(Options& command, CommonOptions& options);

Option add_file(Options& command, const std::string& option,
                std::optional<std::filesystem::path>& file, const std::string& description);

/// Throws UsageError when an option was given that only a run of pass one obeys.
void refuse_pass_one_options(const Options& command, const std::string& reason);

/// Warnings, notes and progress on standard error.
class Console {
public:
  explicit Console(Verbosity verbosity);
  ~Console();
  RunEvents events();
  /// Shows how far something is, on the line that is written over.
  void show_status(const std::string& line);
  /// The line an error is, for a process that ends without unwinding.
  void say_error(const std::string& line);
  /// Says how the options were read, and what their settings round.
  void say_notes(const CommonOptions& options);

private:
  struct State;
  std::shared_ptr<State> state_;
};

/// The text without control characters, which would break the one line it has.
std::string one_line(std::string text);

} // namespace meninas
