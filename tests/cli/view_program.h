// `meninas view`, running, and what it answers.
#pragma once

#include "tests/cli/program.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace meninas::test {

struct Answer {
  int status = 0; ///< 0: none came
  std::string body;
};
using Headers = std::vector<std::pair<std::string, std::string>>;

class ViewProgram {
public:
  /// Waits for its address.
  ViewProgram(const std::filesystem::path& folder, std::vector<std::string> arguments);

  const std::string& address() const { return address_; }
  int port() const;
  /// "/TOKEN/"
  std::string base() const;

  /// Below the address. Headers in place of those that a client sends of itself.
  Answer get(const std::string& path, const Headers& headers = {}) const;
  Answer post(const std::string& path, const Headers& headers = {}) const;
  /// From the server's root.
  Answer ask(const std::string& method, const std::string& path, const Headers& headers = {}) const;
  /// The newest status of which this holds; null where none comes.
  nlohmann::json status_when(const std::function<bool(const nlohmann::json&)>& holds) const;
  nlohmann::json status_when_solved() const;
  /// By Ctrl-C.
  Outcome end();

private:
  RunningProgram program_;
  std::string address_;
};

/// One that asks, and never reads what comes.
class SilentReader {
public:
  SilentReader(const ViewProgram& view, const std::string& path);
  ~SilentReader();
  SilentReader(const SilentReader&) = delete;
  SilentReader& operator=(const SilentReader&) = delete;

private:
  int socket_ = -1;
};

} // namespace meninas::test
