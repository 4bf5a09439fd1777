#include "show/web/web_server.h"

#include "engine/base/installed_files.h"
#include "engine/base/shared_library.h"
#include "pipeline/platform/idle_priority.h"
#include "show/web/http_listener.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

namespace stadion {

/// The listener accepts connections, and the gate reads them.
class WebServer::Listening {
public:
  Listening(MakeHttpListener& make, WebServer::Handler handler, const GateLimits& limits)
      : listener_(made(make, std::move(handler))),
        gate_([this](const WebRequest& r) { return listener_->answer(r); },
              [this](int status, const std::string& why) { return listener_->refusal(status, why); },
              limits) {}
  ~Listening() {
    listener_->stop();
    gate_.stop();
  }
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;

  int at(const WebAddress& address) { return listener_->listenAt(address.host, address.port); }
  GateCounts counts() const { return gate_.counts(); }

private:
  std::unique_ptr<HttpListener> made(MakeHttpListener& make, WebServer::Handler handler) {
    HttpDuties duties{std::move(handler), [this](int socket) { gate_.adopt(socket); },
                      [] { yieldToShow("web-accept"); }};
    return std::unique_ptr<HttpListener>(make(duties));
  }

  std::unique_ptr<HttpListener> listener_;
  RequestGate gate_;
};

WebServer::WebServer(const WebAddress& address) : address_(address) {}

WebServer::~WebServer() = default;

Result<std::unique_ptr<WebServer>> WebServer::open(const WebAddress& address, Handler handler,
                                                   GateLimits limits) {
  using Opened = Result<std::unique_ptr<WebServer>>;
  const auto library = SharedLibrary::open(helperProgram("libstadion-http.so").c_str(), "stadion");
  if (!library) return library.error();
  auto* make = library.value().find<MakeHttpListener>("stadionMakeHttpListener");
  if (!make) return Opened::failure("libstadion-http.so is of another version: install Stadion again");
  std::unique_ptr<WebServer> made(new WebServer(address));
  made->listening_ = std::make_unique<Listening>(*make, std::move(handler), limits);
  errno = 0;
  const int port = made->listening_->at(address);
  if (port <= 0)
    return Opened::failure(fmt::format(
        "cannot listen on {}: {}", address.authority(),
        errno != 0 ? std::strerror(errno) : "the port is taken, or the address is not this machine's"));
  made->address_.port = static_cast<std::uint16_t>(port);
  return made;
}

GateCounts WebServer::counts() const {
  return listening_->counts();
}

}  // namespace stadion
