// A server of one page on this machine, for nobody but whoever knows its address.
//
//   http://127.0.0.1:PORT/TOKEN/PATH
//
// It listens on 127.0.0.1 alone. Every request needs the token, 128 bits of the system's random numbers, and a
// `Host` that is this address, so that no name of somebody else's leads here; one that a page has sent
// needs an `Origin` that is it, too. All others get 403, whatever they ask for. Files are neither read nor
// written. Server-sent events tell what is newest: who reads slowly misses what was between, and nothing
// waits in a queue. Each connection is a thread; there are so many and no more.
#pragma once

#include "runs/live/server_seam.h"

namespace meninas {

class WebServer {
public:
  /// Listens from now on. `port` 0: any that is free. `events` are sent below the token as "events".
  /// Throws OutputError where the port is taken or may not be used, and InputError where the module that serves is not
  /// there.
  WebServer(int port, AnswerRequest answer, NextEvent events);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  int port() const;
  /// With the token, to be opened in a browser.
  std::string address() const;

private:
  const web::Table* table_;
  web::Place place_;
  void* server_ = nullptr;
};

} // namespace meninas
