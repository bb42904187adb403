// A browser that is told what to do while it runs, by the DevTools protocol over two pipes: messages are JSON,
// each ended by a zero byte.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace meninas::test {

class DrivenBrowser {
public:
  /// Its profile is in `folder`; WebGL 2 is drawn by software.
  explicit DrivenBrowser(const std::filesystem::path& folder);
  ~DrivenBrowser();
  DrivenBrowser(const DrivenBrowser&) = delete;
  DrivenBrowser& operator=(const DrivenBrowser&) = delete;

  /// Opens a page of its own; returns what run() takes.
  std::string open(const std::string& address);
  /// What the body of an async function returns in that page; null, with a failure, where it throws.
  nlohmann::json run(const std::string& page, const std::string& use);
  /// What someone prefers, such as prefers-color-scheme: dark; with pairs of names and values.
  void prefer(const std::string& page, const std::vector<std::pair<std::string, std::string>>& features);
  /// Files that pages save go there from now on.
  void save_into(const std::filesystem::path& folder);
  void close(const std::string& page);
  /// The picture of the page, as a PNG file.
  void take_picture(const std::string& page, const std::filesystem::path& file);

private:
  nlohmann::json call(const std::string& method, const nlohmann::json& parameters, const std::string& session = "");
  nlohmann::json next_message();

  int process_ = -1, to_ = -1, from_ = -1, calls_ = 0;
  std::string received_;
};

} // namespace meninas::test
