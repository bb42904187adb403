#include "tests/cli/view_program.h"

#include <gtest/gtest.h>
#include <httplib.h>

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace meninas::test {

using nlohmann::json;

static std::vector<std::string> with_command(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "view");
  arguments.insert(arguments.end(), {"--no-open", "--quiet"});
  return arguments;
}

ViewProgram::ViewProgram(const std::filesystem::path& folder, std::vector<std::string> arguments)
    : program_(folder, with_command(std::move(arguments))) {
  for (int k = 0; k < 2400 && !address_.ends_with('\n'); ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    address_ = program_.out();
  }
  EXPECT_TRUE(address_.starts_with("http://127.0.0.1:") && address_.ends_with("/\n")) << address_;
  if (!address_.empty())
    address_.pop_back();
}

int ViewProgram::port() const { return std::atoi(address_.substr(address_.find(':', 5) + 1).c_str()); }

std::string ViewProgram::base() const { return address_.substr(address_.find('/', 8)); }

Answer ViewProgram::ask(const std::string& method, const std::string& path, const Headers& headers) const {
  httplib::Client client("127.0.0.1", port());
  client.set_read_timeout(300, 0);
  httplib::Headers sent;
  for (const auto& [name, value] : headers)
    sent.emplace(name, value);
  Answer answer;
  if (method == "GET") {
    // Events have no end: their status is all that is waited for.
    const auto result = client.Get(
        path, sent,
        [&](const httplib::Response& response) {
          answer.status = response.status;
          return response.get_header_value("Content-Type") != "text/event-stream";
        },
        [&](const char* data, std::size_t size) {
          answer.body.append(data, size);
          return true;
        });
    if (result)
      answer.status = result->status;
    return answer;
  }
  const auto result = method == "POST" ? client.Post(path, sent, "", "text/plain") : client.Delete(path, sent);
  return result ? Answer{result->status, result->body} : Answer{};
}

Answer ViewProgram::get(const std::string& path, const Headers& headers) const { return ask("GET", base() + path, headers); }

Answer ViewProgram::post(const std::string& path, const Headers& headers) const {
  Headers all = headers;
  if (headers.empty())
    all.emplace_back("Origin", "http://127.0.0.1:" + std::to_string(port()));
  return ask("POST", base() + path, all);
}

json ViewProgram::status_when(const std::function<bool(const json&)>& holds) const {
  httplib::Client client("127.0.0.1", port());
  client.set_read_timeout(300, 0);
  std::string received;
  json found;
  client.Get(base() + "events", [&](const char* data, std::size_t size) {
    received.append(data, size);
    for (std::size_t end; (end = received.find("\n\n")) != std::string::npos; received.erase(0, end + 2))
      if (received.starts_with("data: ")) {
        json status = json::parse(received.substr(6, end - 6), nullptr, false);
        if (status.is_object() && holds(status)) {
          found = std::move(status);
          return false;
        }
      }
    return true;
  });
  return found;
}

json ViewProgram::status_when_solved() const {
  return status_when([](const json& status) { return status.at("solved") == true; });
}

Outcome ViewProgram::end() {
  program_.send(SIGINT);
  return program_.outcome();
}

SilentReader::SilentReader(const ViewProgram& view, const std::string& path) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(static_cast<std::uint16_t>(view.port()));
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(connect(socket_, reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
  const std::string request = "GET " + view.base() + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(view.port()) + "\r\n\r\n";
  EXPECT_EQ(write(socket_, request.data(), request.size()), static_cast<ssize_t>(request.size()));
}

SilentReader::~SilentReader() { close(socket_); }

} // namespace meninas::test
