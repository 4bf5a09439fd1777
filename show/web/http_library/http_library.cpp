/// libstadion-http.so: cpp-httplib, for the operator's page.

#include "show/web/http_listener.h"
#include "show/web/request_reader.h"

#include <fmt/format.h>
#include <httplib.h>

#include <atomic>
#include <thread>

namespace stadion {
namespace {

constexpr int kBacklog = 128;  ///< connections that the system holds until they are accepted

/// Headers of every answer. The page loads nothing from elsewhere, stands in no frame, and leaves no trace.
const httplib::Headers& commonHeaders() {
  static const httplib::Headers headers{
      {"Content-Security-Policy", "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' "
                                  "blob: data:; connect-src 'self'; "
                                  "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"X-Frame-Options", "DENY"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Cache-Control", "no-store"},
  };
  return headers;
}

/// A request in memory, and the answer to it.
class RequestInMemory final : public httplib::Stream {
public:
  explicit RequestInMemory(std::string request) : request_(std::move(request)) {}

  bool is_readable() const override { return true; }
  bool is_writable() const override { return true; }
  ssize_t read(char* to, size_t size) override {
    const std::size_t count = request_.copy(to, size, read_);
    read_ += count;
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* from, size_t size) override {
    answer_.append(from, size);
    return static_cast<ssize_t>(size);
  }
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return INVALID_SOCKET; }

  std::string takeAnswer() { return std::move(answer_); }

private:
  std::string request_, answer_;
  std::size_t read_ = 0;
};

/// What the library gets: the request again, without headers that nothing here asks for.
std::string plainRequest(const WebRequest& r) {
  return fmt::format(
      "{} {} HTTP/1.1\r\nHost: {}\r\nAuthorization: Bearer {}\r\nOrigin: {}\r\nSec-Fetch-Site: {}\r\n"
      "Content-Type: {}\r\nConnection: close\r\nContent-Length: {}\r\n\r\n{}",
      r.method, r.path, r.host, r.token, r.origin, r.fetchSite, r.contentType, r.body.size(), r.body);
}

WebRequest webRequestOf(const httplib::Request& r) {
  constexpr std::size_t kBearer = 7;  // "Bearer "
  const std::string authorization = r.get_header_value("Authorization");
  return {r.method,
          r.path,
          r.get_header_value("Host"),
          authorization.size() > kBearer ? authorization.substr(kBearer) : "",
          r.get_header_value("Origin"),
          r.get_header_value("Sec-Fetch-Site"),
          r.get_header_value("Content-Type"),
          r.body};
}

class Listener final : public HttpListener, private httplib::Server {
public:
  explicit Listener(HttpDuties duties) : duties_(std::move(duties)) {
    const auto answered = [this](const httplib::Request& request, httplib::Response& response) {
      const WebAnswer made = duties_.answer(webRequestOf(request));
      response.status = made.status;
      response.set_content(made.body, made.type);
    };
    Get("/.*", answered);
    Post("/.*", answered);
    set_default_headers(commonHeaders());
    set_payload_max_length(RequestReader::kMostBody);
    set_keep_alive_max_count(1);
    // The library would share the port with another program of the same user.
    set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    new_task_queue = [] { return new AtOnce; };
  }
  ~Listener() override { end(); }

  int listenAt(const std::string& host, std::uint16_t port) override {
    const int got = port == 0 ? bind_to_any_port(host) : bind_to_port(host, port) ? port : -1;
    if (got <= 0) return 0;
    // The library's own limit is five, which 50 clients exceed when they reconnect together.
    ::listen(svr_sock_, kBacklog);
    accepting_ = std::thread([this] {
      duties_.begin();
      listen_after_bind();
      ended_ = true;
    });
    while (!is_running() && !ended_) std::this_thread::yield();
    return ended_ ? 0 : got;
  }

  void stop() override { end(); }

  std::string answer(const WebRequest& request) override {
    RequestInMemory stream(plainRequest(request));
    bool closed = false;
    process_request(stream, true, closed, [](httplib::Request&) {});
    return stream.takeAnswer();
  }

  std::string refusal(int status, const std::string& why) override {
    std::string text = fmt::format("HTTP/1.1 {} Refused\r\n", status);
    for (const auto& [name, value] : commonHeaders()) text += name + ": " + value + "\r\n";
    return text + fmt::format("Content-Type: text/plain; charset=utf-8\r\nContent-Length: {}\r\n"
                              "Connection: close\r\n\r\n{}\n",
                              why.size() + 1, why);
  }

private:
  /// The library calls it for each connection, as a task.
  class AtOnce final : public httplib::TaskQueue {
  public:
    void enqueue(std::function<void()> task) override { task(); }
    void shutdown() override {}
  };

  bool process_and_close_socket(socket_t socket) override {
    duties_.adopt(socket);
    return true;
  }

  void end() {
    httplib::Server::stop();
    if (accepting_.joinable()) accepting_.join();
  }

  HttpDuties duties_;
  std::atomic<bool> ended_ = false;
  std::thread accepting_;
};

}  // namespace

extern "C" HttpListener* stadionMakeHttpListener(HttpDuties& duties) {
  return new Listener(std::move(duties));
}

}  // namespace stadion
