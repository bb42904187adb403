// Requests and replies of a server of one page (web_server.h).
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace meninas {

/// A request, below the token.
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

/// The next event newer than `seen`, which it sets; nothing if there is none within `patience`.
using NextEvent =
    std::function<std::optional<std::string>(std::uint64_t& seen, std::chrono::milliseconds patience)>;

} // namespace meninas
