#include "monitor/web/server.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <random>
#include <sstream>
#include <thread>
#include <utility>

#include "common/core/failure.hpp"
#include "monitor/json.hpp"
#include "monitor/web/gallery.hpp"
#include "monitor/web/guards.hpp"
#include "monitor/web/pages.hpp"

namespace fsi::monitor {

namespace {

/// Browsers that follow the run at the same time.
constexpr int most_streams = 12;
/// Connections at the same time; further ones wait until one of these ends.
constexpr std::size_t most_connections = 512;
/// A connection that says nothing for this time in the midst of a request, or between two, is closed.
constexpr std::chrono::seconds patience{2};
/// A stream without news says this often that it lives [s].
constexpr std::chrono::milliseconds heartbeat{1000};
constexpr const char* token_header = "X-AMP-FSI-Token";

/// 128 bits that nobody can guess, in hexadecimal.
std::string random_token() {
  std::random_device source;
  std::string token;
  for (int k = 0; k < 4; ++k) token += fmt::format("{:08x}", source());
  return token;
}

/// The words of a list "one,two".
std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream stream(list);
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  return words;
}

}  // namespace

struct WebServer::Implementation {
  struct Snapshot {
    RunState state;
    double now = 0;
  };

  explicit Implementation(WebOptions wishes) : options(std::move(wishes)), token(random_token()) {
    server.new_task_queue = [] { return new ConnectionThreads(most_connections); };  // httplib deletes it
    server.set_read_timeout(patience);
    server.set_keep_alive_timeout(patience.count());
    server.set_write_timeout(std::chrono::seconds(5));
    server.set_keep_alive_max_count(100);
    server.set_default_headers(
        {{"Content-Security-Policy", "default-src 'self'; img-src data:; frame-ancestors 'none'"},
         {"X-Content-Type-Options", "nosniff"},
         {"Referrer-Policy", "no-referrer"},
         {"Cache-Control", "no-store"}});
    routes();
    bind();
    thread = std::thread([this] { server.listen_after_bind(); });
  }

  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;
  Implementation(Implementation&&) = delete;
  Implementation& operator=(Implementation&&) = delete;
  ~Implementation() {
    stopping = true;
    changed.notify_all();
    gallery.close();
    server.stop();
    thread.join();
  }

  void bind() {
    if (options.port == 0) {
      options.port = server.bind_to_any_port(options.host);
    } else if (!server.bind_to_port(options.host, options.port)) {
      options.port = -1;
    }
    if (options.port < 0) {
      throw UserMistake(fmt::format("--web: the port cannot be used on '{}'; is it taken? 0 finds a free one",
                                    options.host));
    }
  }

  bool controllable() const { return options.request && is_loopback(options.host); }

  void routes() {
    // Another page in the same browser could reach this server under a name of its own (DNS rebinding).
    server.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      const bool foreign =
          is_loopback(options.host) && !is_loopback(host_of(request.get_header_value("Host")));
      if (!foreign && !has_large_body(request)) return httplib::Server::HandlerResponse::Unhandled;
      response.status = foreign ? 403 : 413;
      response.set_content(foreign ? "this page is for this machine only\n" : "requests here have no body\n",
                           "text/plain");
      return httplib::Server::HandlerResponse::Handled;
    });
    for (const PageFile& one : page_files) file(one);
    answer("/api/state.json", "application/json", to_json);
    answer("/api/history.json", "application/json", history_json);
    answer("/metrics", "text/plain; version=0.0.4; charset=utf-8", to_prometheus);
    server.Get("/api/pictures", [this](const auto& request, auto& response) { pictures(request, response); });
    server.Get("/api/events", [this](const auto&, auto& response) { stream(response); });
    server.Post("/api/control", [this](const auto& request, auto& response) { control(request, response); });
  }

  void file(const PageFile& one) {
    server.Get(one.path, [one](const auto&, auto& response) { response.set_content(one.content, one.type); });
  }

  void answer(const std::string& path, const char* type, std::string (*text)(const RunState&, double)) {
    server.Get(path, [this, type, text](const auto&, auto& response) {
      const auto known = snapshot();
      if (known) {
        response.set_content(text(known->state, known->now), type);
      } else {
        response.status = 503;
      }
    });
  }

  /// What is newer than the last picture the browser has, as soon
  /// as there is something; else, after a while, nothing.
  void pictures(const httplib::Request& request, httplib::Response& response) {
    const std::uint64_t after = std::strtoull(request.get_param_value("after").c_str(), nullptr, 10);
    const Hanging hanging = gallery.wait(after, words_of(request.get_param_value("wish")), heartbeat);
    response.set_header("X-AMP-FSI-Version", fmt::format("{}", hanging.version));
    response.set_content(hanging.bytes, "application/octet-stream");
  }

  /// One state after the other as server-sent events, until the browser leaves.
  void stream(httplib::Response& response) {
    if (++streams > most_streams) {
      --streams;
      response.status = 503;
      response.set_content("too many browsers\n", "text/plain");
      return;
    }
    auto shown = std::make_shared<std::uint64_t>(0);
    response.set_chunked_content_provider(
        "text/event-stream",
        [this, shown](std::size_t, httplib::DataSink& sink) { return send_next(*shown, sink); },
        [this](bool) { --streams; });
  }

  bool send_next(std::uint64_t& shown, httplib::DataSink& sink) {
    std::shared_ptr<const Snapshot> next;
    {
      std::unique_lock lock(mutex);
      changed.wait_for(lock, heartbeat, [&] { return stopping || version != shown; });
      if (version != shown) next = latest;
      shown = version;
    }
    if (stopping) return false;
    const std::string text =
        next ? fmt::format("data: {}\n\n", to_json(next->state, next->now)) : ": alive\n\n";
    return sink.write(text.data(), text.size());
  }

  void control(const httplib::Request& request, httplib::Response& response) {
    const auto command = named<Request>(request.get_param_value("command"));
    if (!controllable() || request.get_header_value(token_header) != token) {
      response.status = 403;
      response.set_content("requests need the address that the monitor printed\n", "text/plain");
    } else if (!command) {
      response.status = 400;
      response.set_content("no such request\n", "text/plain");
    } else {
      response.set_content(options.request(*command) + "\n", "text/plain");
    }
  }

  std::shared_ptr<const Snapshot> snapshot() {
    const std::scoped_lock lock(mutex);
    return latest;
  }

  void publish(const RunState& state, double now) {
    auto next = std::make_shared<const Snapshot>(Snapshot{.state = state, .now = now});
    {
      const std::scoped_lock lock(mutex);
      latest = std::move(next);
      ++version;
    }
    changed.notify_all();
  }

  WebOptions options;
  std::string token;
  httplib::Server server;
  Gallery gallery;
  std::mutex mutex;
  std::condition_variable changed;
  std::shared_ptr<const Snapshot> latest;
  std::uint64_t version = 0;
  std::atomic<int> streams = 0;
  std::atomic<bool> stopping = false;
  std::thread thread;
};

WebServer::WebServer(WebOptions options)
    : implementation_(std::make_unique<Implementation>(std::move(options))) {}
WebServer::~WebServer() = default;

std::string WebServer::url() const {
  const WebOptions& options = implementation_->options;
  const bool bracketed = options.host.find(':') != std::string::npos;
  return fmt::format("http://{}{}{}:{}/{}", bracketed ? "[" : "", options.host, bracketed ? "]" : "",
                     options.port, implementation_->controllable() ? "#token=" + implementation_->token : "");
}

std::vector<std::string> WebServer::wishes() {
  return implementation_->gallery.wishes();
}

void WebServer::show(const wire::Picture& picture) {
  implementation_->gallery.hang(picture);
}

void WebServer::show_past(const wire::Picture& picture) {
  implementation_->gallery.keep(picture);
}

void WebServer::publish(const RunState& state, double now) {
  implementation_->publish(state, now);
}

}  // namespace fsi::monitor
