#pragma once
/// The page in the browser: serves what is compiled in, the state of the run, and a stream of its changes.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/wire/request.hpp"
#include "monitor/state.hpp"

namespace fsi::monitor {

struct WebOptions {
  std::string host = "127.0.0.1";
  int port = 0;  ///< 0: any that is free
  /// Sends a request to the run and returns what became of it. Empty: nobody may. Obeyed only with the token
  /// in `url()`, and only on the loopback interface.
  std::function<std::string(Request)> request = {};
};

class WebServer {
 public:
  /// Serves from now on. @throws UserMistake when the port cannot be had
  explicit WebServer(WebOptions options);
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;
  WebServer(WebServer&&) = delete;
  WebServer& operator=(WebServer&&) = delete;
  ~WebServer();

  /// Address of the page; with the token that allows requests, where they are allowed.
  std::string url() const;
  /// The state from now on; copied, so that a slow browser holds up nobody.
  void publish(const RunState& state, double now);
  /// The quantities that browsers look at now, ROLE.QUANTITY.
  std::vector<std::string> wishes();
  /// The newest picture for the browsers that wish for it.
  void show(const wire::Picture& picture);
  /// One of a moment that is past.
  void show_past(const wire::Picture& picture);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace fsi::monitor
