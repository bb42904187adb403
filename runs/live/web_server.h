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

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace meninas {

/// What is asked for, below the token.
struct WebRequest {
  std::string path;                         ///< "" is the page
  std::map<std::string, std::string> query; ///< the last of each name
  bool changes_something = false;           ///< POST
};

struct WebReply {
  int status = 200;
  std::string type; ///< of its media, such as "text/html"
  std::shared_ptr<const std::string> body;
};

/// Called by any thread, for many requests at once.
using AnswerRequest = std::function<WebReply(const WebRequest&)>;

/// What is newer than `seen`, which it sets; nothing where nothing is after so long.
using NextEvent =
    std::function<std::optional<std::string>(std::uint64_t& seen, std::chrono::milliseconds patience)>;

class WebServer {
public:
  /// Listens from now on. `port` 0: any that is free. `events` are sent below the token as "events".
  /// Throws OutputError where the port is taken or may not be used.
  WebServer(int port, AnswerRequest answer, NextEvent events);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  int port() const;
  /// With the token, to be opened in a browser.
  std::string address() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace meninas
