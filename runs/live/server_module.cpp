// The module behind server_seam.h, and the only user of cpp-httplib.
#include "runs/live/server_seam.h"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <sys/random.h>
#include <thread>
#include <utility>

namespace meninas::web {
namespace {

using Clock = std::chrono::steady_clock;
using httplib::Server;

constexpr std::size_t max_connections = 48, max_listeners = 24, longest_request = 1024, max_waiting = 64;

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("the system gives no random numbers");
  std::string token;
  for (const unsigned char byte : bytes)
    token += fmt::format("{:02x}", byte);
  return token;
}

/// Nothing, or since cpp-httplib 0.18 whether the job was accepted.
using Accepted = decltype(std::declval<httplib::TaskQueue&>().enqueue({}));

/// Threads, and so many connections that wait for one. More are not accepted before there is room: they wait in the
/// system's own short queue, and past that they are refused.
class BoundedThreads : public httplib::TaskQueue {
public:
  explicit BoundedThreads(const std::atomic<bool>& over) : over_(over), threads_(max_connections) {}

  Accepted enqueue(std::function<void()> job) override {
    constexpr std::chrono::milliseconds patience(100);
    std::unique_lock lock(mutex_);
    while (!room_.wait_for(lock, patience, [this] { return waiting_ < max_waiting || over_; })) {
    }
    ++waiting_;
    lock.unlock();
    return threads_.enqueue([this, job = std::move(job)] {
      {
        const std::scoped_lock begins(mutex_);
        --waiting_;
      }
      room_.notify_one();
      job();
    });
  }
  void shutdown() override { threads_.shutdown(); }

private:
  const std::atomic<bool>& over_;
  std::mutex mutex_;
  std::condition_variable room_;
  std::size_t waiting_ = 0;
  httplib::ThreadPool threads_;
};

/// In a time that tells nothing about where they differ.
bool same_text(const std::string& a, const std::string& b) {
  if (a.size() != b.size())
    return false;
  unsigned difference = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    difference |= static_cast<unsigned char>(a[k]) ^ static_cast<unsigned char>(b[k]);
  return difference == 0;
}

/// "/TOKEN/PATH"
std::string token_of(const std::string& path) {
  const auto end = path.find('/', 1);
  return path.size() < 2 || end == std::string::npos ? "" : path.substr(1, end - 1);
}

/// Nothing but the page itself may use what it gets.
void add_headers(httplib::Response& response) {
  response.set_header("Cache-Control", "no-store");
  response.set_header("Referrer-Policy", "no-referrer");
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("X-Frame-Options", "DENY");
  response.set_header("Cross-Origin-Resource-Policy", "same-origin");
  response.set_header("Content-Security-Policy",
                      "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
                      "connect-src 'self'; img-src 'self' blob: data:; frame-ancestors 'none'");
}

struct Listening {
  Server server;
  std::string token = random_token();
  int port = 0;
  Answers answers;
  std::atomic<bool> over{false};
  std::atomic<std::size_t> listeners{0};
  std::thread listening;

  bool may_ask(const httplib::Request& request) const {
    const std::string here = fmt::format("127.0.0.1:{}", port), named = fmt::format("localhost:{}", port);
    const auto is_here = [&](const std::string& host) { return host == here || host == named; };
    if (request.get_header_value_count("Host") != 1 || !is_here(request.get_header_value("Host")))
      return false;
    const std::string origin = request.get_header_value("Origin");
    if (request.get_header_value_count("Origin") > 1)
      return false;
    if (request.has_header("Origin") && (!origin.starts_with("http://") || !is_here(origin.substr(7))))
      return false;
    // What changes something says where it comes from.
    if (request.method != "GET" && (request.method != "POST" || !request.has_header("Origin")))
      return false;
    return same_text(token_of(request.path), token);
  }

  void reply(const httplib::Request& request, httplib::Response& response) {
    add_headers(response);
    WebRequest asked{request.path.substr(token.size() + 2), {}, request.method == "POST"};
    if (asked.path == "events" && !asked.changes_something)
      return send_events(response);
    for (const auto& [name, value] : request.params)
      asked.query[name] = value;
    const WebReply given = answers.answer(asked);
    response.status = given.status;
    if (!given.body)
      return;
    response.set_content_provider(
        given.body->size(), given.type.c_str(),
        [body = given.body](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
          constexpr std::size_t at_once = 1 << 16;
          return sink.write(body->data() + offset, std::min(length, at_once));
        });
  }

  /// The newest, and then the newest again; a line of nothing at times, which tells who has left.
  void send_events(httplib::Response& response) {
    if (++listeners > max_listeners) {
      --listeners;
      response.status = 503;
      return;
    }
    const auto leaves = std::shared_ptr<void>(nullptr, [this](void*) { --listeners; });
    response.set_chunked_content_provider(
        "text/event-stream", [this, leaves, seen = std::uint64_t{0}, told = Clock::now()](
                                 std::size_t, httplib::DataSink& sink) mutable {
          constexpr std::chrono::milliseconds patience(250), pause(40), silence(2000);
          if (over)
            return false;
          if (const auto event = answers.events(seen, patience)) {
            const std::string line = fmt::format("data: {}\n\n", *event);
            told = Clock::now();
            const bool is_read = sink.write(line.data(), line.size());
            std::this_thread::sleep_for(pause);
            return is_read;
          }
          if (Clock::now() - told < silence)
            return true;
          told = Clock::now();
          return sink.write(": \n\n", 4);
        });
  }
};

/// Throws the reason where it may not listen.
void listen(Listening& state, int port) {
  Server& server = state.server;
  server.new_task_queue = [&state] { return new BoundedThreads(state.over); };
  constexpr time_t patience = 2;
  server.set_read_timeout(patience);
  server.set_keep_alive_max_count(1);
  server.set_payload_max_length(longest_request);
  server.set_tcp_nodelay(true);
  // Not what the library would set: two programs would then share a port.
  server.set_socket_options([](int socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_pre_routing_handler([&state](const httplib::Request& request, httplib::Response& response) {
    if (!state.may_ask(request)) {
      response.status = 403;
      response.set_content("403\n", "text/plain");
      return Server::HandlerResponse::Handled;
    }
    state.reply(request, response);
    return Server::HandlerResponse::Handled;
  });
  server.set_exception_handler([](const httplib::Request&, httplib::Response& response, std::exception_ptr) {
    response.status = 500;
  });
  if (port == 0)
    state.port = server.bind_to_any_port("127.0.0.1");
  else if (server.bind_to_port("127.0.0.1", port))
    state.port = port;
  if (state.port <= 0)
    throw std::runtime_error(fmt::format("cannot listen: {}", std::strerror(errno)));
  state.listening = std::thread([&server] { server.listen_after_bind(); });
  while (!server.is_running())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void* open(int port, Answers answers, Place& place) {
  try {
    auto state = std::make_unique<Listening>();
    state->answers = std::move(answers);
    listen(*state, port);
    place = {state->port, state->token, ""};
    return state.release();
  } catch (const std::exception& error) {
    place.problem = error.what();
    return nullptr;
  }
}

void close(void* server) {
  const std::unique_ptr<Listening> state(static_cast<Listening*>(server));
  state->over = true;
  state->server.stop();
  state->listening.join();
}

constexpr Table table{seam_version, open, close};

} // namespace
} // namespace meninas::web

extern "C" __attribute__((visibility("default"))) const meninas::web::Table* meninas_server() {
  return &meninas::web::table;
}
