#pragma once
/// An HTTP server for the operator's page: it listens, and hands each request to a function.
///
/// cpp-httplib accepts connections and speaks HTTP; it is loaded by open() (http_listener.h). RequestGate stands in front of it: it reads each request within
/// limits and passes on only what is well-formed. So nothing hostile reaches the library, and no client delays another
/// one.
///
/// Ownership  owns its sockets and threads.
/// Threads    `handler` is called on the server's threads, several at a time.
/// Errors     open() says why it cannot listen, or that libstadion-http.so is missing.

#include "show/web/request_gate.h"
#include "show/web/web_address.h"

#include <functional>
#include <memory>

namespace stadion {

class WebServer {
public:
  using Handler = std::function<WebAnswer(const WebRequest&)>;

  static Result<std::unique_ptr<WebServer>> open(const WebAddress& address, Handler handler,
                                                 GateLimits limits = {});
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// The address with the port that was taken.
  const WebAddress& address() const { return address_; }
  GateCounts counts() const;

private:
  class Listening;
  explicit WebServer(const WebAddress& address);

  WebAddress address_;
  std::unique_ptr<Listening> listening_;
};

}  // namespace stadion
