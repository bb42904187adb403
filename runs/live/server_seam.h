// The seam between the program and the shared module that holds cpp-httplib.
//
// Linking it maps OpenSSL and Brotli, too, at every start: 4 ms in 13 of `meninas version`. So one source file uses it,
// compiled into a module of its own, and `view` opens that (image/module_file.h). Both sides are compiled
// with one standard library in one build, so that its types may cross; exceptions do not.
#pragma once

#include "runs/live/web_request.h"

namespace meninas::web {

/// Raised with every change of this file and of web_request.h: a module from another build is refused, not misread.
inline constexpr int seam_version = 1;

struct Answers {
  AnswerRequest answer;
  NextEvent events;
};

struct Place {
  int port = 0;
  std::string token;
  std::string problem; ///< why it does not listen
};

struct Table {
  int seam_version;
  /// Listens from now on; `port` 0: any that is free. Null where it may not.
  void* (*open)(int port, Answers answers, Place& place);
  void (*close)(void* server);
};

/// The one symbol the module exports: `const Table* meninas_server()`.
inline constexpr const char* entry_point = "meninas_server";
using EntryPoint = const Table* (*)();

} // namespace meninas::web
