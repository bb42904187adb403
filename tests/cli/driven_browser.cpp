#include "tests/cli/driven_browser.h"

#include "tests/cli/browser.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>
#include <vector>

namespace meninas::test {

using nlohmann::json;

DrivenBrowser::DrivenBrowser(const std::filesystem::path& folder) {
  std::array<int, 2> commands{}, answers{};
  if (pipe2(commands.data(), O_CLOEXEC) != 0 || pipe2(answers.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe");
  const std::string profile = "--user-data-dir=" + (folder / "profile").string();
  process_ = fork();
  if (process_ == 0) {
    // Beyond those that they are copied to.
    const int in = fcntl(commands[0], F_DUPFD, 10), out = fcntl(answers[1], F_DUPFD, 10), nowhere = ::open("/dev/null", O_RDWR);
    for (const auto& [from, to] : {std::pair{in, 3}, {out, 4}, {nowhere, 0}, {nowhere, 1}, {nowhere, 2}})
      dup2(from, to);
    ::close(in);
    ::close(out);
    setpgid(0, 0);
    execl(MENINAS_BROWSER, MENINAS_BROWSER, "--headless", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader",
          "--enable-unsafe-swiftshader", "--window-size=640,480", "--no-first-run", "--remote-debugging-pipe", profile.c_str(), "about:blank",
          static_cast<char*>(nullptr));
    _exit(127);
  }
  ::close(commands[0]);
  ::close(answers[1]);
  to_ = commands[1];
  from_ = answers[0];
}

DrivenBrowser::~DrivenBrowser() {
  ::close(to_);
  ::close(from_);
  kill(-process_, SIGKILL);
  waitpid(process_, nullptr, 0);
}

json DrivenBrowser::next_message() {
  constexpr int patience = 120'000;
  for (;;) {
    if (const auto end = received_.find('\0'); end != std::string::npos) {
      json message = json::parse(received_.substr(0, end), nullptr, false);
      received_.erase(0, end + 1);
      return message;
    }
    pollfd waiting{from_, POLLIN, 0};
    std::array<char, 65536> part{};
    if (poll(&waiting, 1, patience) <= 0)
      return nullptr;
    const auto size = read(from_, part.data(), part.size());
    if (size <= 0)
      return nullptr;
    received_.append(part.data(), static_cast<std::size_t>(size));
  }
}

json DrivenBrowser::call(const std::string& method, const json& parameters, const std::string& session) {
  json message{{"id", ++calls_}, {"method", method}, {"params", parameters}};
  if (!session.empty())
    message["sessionId"] = session;
  const std::string text = message.dump();
  // With its zero byte.
  if (write(to_, text.c_str(), text.size() + 1) != static_cast<ssize_t>(text.size() + 1))
    return nullptr;
  for (;;) {
    json answer = next_message();
    if (!answer.is_object())
      return nullptr;
    if (answer.value("id", 0) == calls_)
      return answer.value("result", json(nullptr));
  }
}

std::string DrivenBrowser::open(const std::string& address) {
  const json target = call("Target.createTarget", {{"url", address}});
  if (!target.is_object())
    return "";
  const json attached = call("Target.attachToTarget", {{"targetId", target.at("targetId")}, {"flatten", true}});
  const std::string page = attached.is_object() ? attached.value("sessionId", "") : "";
  // What is run before the page is there would be lost with the empty one.
  for (int k = 0; k < 1200; ++k) {
    const json state = call("Runtime.evaluate", {{"expression", "location.href !== 'about:blank' && document.readyState === 'complete'"}, {"returnByValue", true}}, page);
    if (state.is_object() && state.contains("result") && state["result"].value("value", false))
      break;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return page;
}

json DrivenBrowser::run(const std::string& page, const std::string& use) {
  const json answer = call("Runtime.evaluate",
                           {{"expression", "(async () => {" + use + "})()"}, {"awaitPromise", true}, {"returnByValue", true}}, page);
  if (!answer.is_object() || answer.contains("exceptionDetails")) {
    ADD_FAILURE() << answer.dump();
    return nullptr;
  }
  return answer.at("result").value("value", json(nullptr));
}

void DrivenBrowser::prefer(const std::string& page, const std::vector<std::pair<std::string, std::string>>& features) {
  json all = json::array();
  for (const auto& [name, value] : features)
    all.push_back({{"name", name}, {"value", value}});
  call("Emulation.setEmulatedMedia", {{"features", all}}, page);
}

void DrivenBrowser::save_into(const std::filesystem::path& folder) {
  call("Browser.setDownloadBehavior", {{"behavior", "allow"}, {"downloadPath", folder.string()}});
}

void DrivenBrowser::close(const std::string& page) { call("Page.close", json::object(), page); }

void DrivenBrowser::take_picture(const std::string& page, const std::filesystem::path& file) {
  const json answer = call("Page.captureScreenshot", {{"format", "png"}}, page);
  const auto bytes = from_base64(answer.value("data", ""));
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

} // namespace meninas::test
