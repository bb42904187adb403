#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/values.h"
#include "runs/parts/merge_run.h"
#include "runs/report/progress_line.h"

namespace meninas {
namespace {

struct MergeOptions {
  MergeRequest request;
  Verbosity verbosity = Verbosity::normal;
};

void run(const MergeOptions& options) {
  Console console(options.verbosity);
  merge_run(options.request, console.events());
}

} // namespace

Command add_merge_command(Options& program) {
  Options& command =
      program.add_command("merge", "Join the parts of a picture that render --tile wrote");
  const auto options = std::make_shared<MergeOptions>();
  MergeRequest& request = options->request;
  command
      .add_repeatable("TILE", "", "all parts of the picture, in any order",
                      [&](const std::string& text) { request.tiles.emplace_back(text); })
      .required();
  command
      .add_repeatable("-o,--output", "FILE",
                      "picture, .exr or .hdr (linear) or .png; may be given several times",
                      [&](const std::string& text) { request.pictures.emplace_back(text); })
      .required();
  command.add("--depth", "8|16", "bits of a PNG's channel [8]", [&](const std::string& text) {
    request.png_bits = parse_choice("--depth", text, Choices<int>{{"8", 8}, {"16", 16}});
  });
  command.add_flag("--float", "write an EXR of 32 bits a channel [16]",
                   [&] { request.exr_type = PixelType::float32; });
  command.add_flag("--quiet", "print warnings and errors only",
                   [=] { options->verbosity = Verbosity::quiet; });
  return {&command, [=] { run(*options); }};
}

} // namespace meninas
