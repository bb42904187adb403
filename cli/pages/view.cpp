#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/pixel_options.h"
#include "cli/values.h"
#include "runs/batch/interruption.h"
#include "runs/live/live_run.h"
#include "runs/report/progress_line.h"

#include <fmt/format.h>
#include <csignal>
#include <spawn.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <thread>

extern char** environ; // NOLINT: as POSIX has it

namespace meninas {
namespace {

struct ViewOptions {
  CommonOptions common;
  LiveRequest request;
  bool opens = true;
};

bool has_display() {
  for (const char* const name : {"DISPLAY", "WAYLAND_DISPLAY"})
    if (const char* const display = std::getenv(name); display != nullptr && *display != '\0')
      return true;
  return false;
}

/// The desktop's browser, if there is one; what it says of itself is not said here.
void open_browser(std::string address, const RunEvents& events) {
  std::thread([address = std::move(address), events]() mutable {
    posix_spawn_file_actions_t silent{};
    posix_spawn_file_actions_init(&silent);
    for (const int stream : {0, 1, 2})
      posix_spawn_file_actions_addopen(&silent, stream, "/dev/null", stream == 0 ? 0 : 1, 0);
    std::string program = "xdg-open";
    std::array<char*, 3> words{program.data(), address.data(), nullptr};
    pid_t process = 0;
    int status = 1;
    // Ctrl-C here is none there, and no signal is blocked or ignored that is not so elsewhere.
    posix_spawnattr_t apart{};
    posix_spawnattr_init(&apart);
    sigset_t all{}, none{};
    sigfillset(&all);
    sigemptyset(&none);
    posix_spawnattr_setsigdefault(&apart, &all);
    posix_spawnattr_setsigmask(&apart, &none);
    posix_spawnattr_setflags(&apart, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    const int failed = posix_spawnp(&process, program.c_str(), &silent, &apart, words.data(), environ);
    posix_spawnattr_destroy(&apart);
    posix_spawn_file_actions_destroy(&silent);
    if (failed == 0)
      waitpid(process, &status, 0);
    if (failed != 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
      warn(events, "no browser could be opened: open the address in one");
  }).detach();
}

void run(const Options& command, ViewOptions& options) {
  if (options.common.settings.steps == 0) { // what the first stage has then is the dark
    options.common.settings.steps.reset();
    options.request.paused = true;
  }
  check_pass_one_options(command, options.common.settings);
  options.request.scene = options.common.scene;
  options.request.settings = options.common.settings;
  Console console(options.common.verbosity);
  console.say_notes(options.common);
  // There is nothing to put away.
  const Interruption ends([](int) { std::_Exit(0); });
  live_run(options.request,
           [&](const std::string& address) {
             tell(stdout, address + "\n");
             std::fflush(stdout);
             if (options.opens && has_display())
               open_browser(address, console.events());
           },
           console.events());
}

} // namespace

Command add_view_command(Options& program) {
  Options& command = program.add_command("view", "Watch a scene being solved, in a browser");
  const auto options = std::make_shared<ViewOptions>();
  add_scene(command, options->common);
  command.add("--port", "N", "listen on that port of 127.0.0.1 [any that is free]", [=](const std::string& text) {
    options->request.port = static_cast<int>(parse_integer("--port", text, 1024, 65'535));
  });
  command.add_flag("--no-open", "print the address and open no browser", [=] { options->opens = false; });
  command.add_flag("--paused", "begin in the dark and wait: N in the browser makes the next shot, P goes on",
                   [=] { options->request.paused = true; });
  command.add("--exposure", "EV", "brighten the page by so many stops [automatic, by camera]",
              [=](const std::string& text) {
                options->request.exposure = parse_number("--exposure", text, Sign::any);
              });
  add_view_transform(command, "how the page shows what is brighter than a display", options->request.transform, "Page");
  add_solve_options(command, options->common);
  return {&command, [=, &command] { run(command, *options); }};
}

} // namespace meninas
