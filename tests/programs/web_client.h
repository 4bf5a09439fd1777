#pragma once
/// A plain client of HTTP over a socket, which may also be slow, wrong or rude.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <string>

namespace stadion {

class WebClient {
public:
  explicit WebClient(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  }
  ~WebClient() { ::close(socket_); }
  WebClient(const WebClient&) = delete;
  WebClient& operator=(const WebClient&) = delete;

  bool connected() const { return connected_; }
  bool send(const std::string& text) const {
    std::size_t sent = 0;
    while (sent < text.size()) {
      const ssize_t count = ::send(socket_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
      if (count <= 0) return false;
      sent += static_cast<std::size_t>(count);
    }
    return true;
  }
  /// Reads until the server closes, at most that long.
  std::string answer(std::chrono::seconds limit = std::chrono::seconds(60)) const {
    std::string text;
    std::array<char, 4096> bytes;
    pollfd waiting{socket_, POLLIN, 0};
    while (poll(&waiting, 1, static_cast<int>(1000 * limit.count())) > 0) {
      const ssize_t count = recv(socket_, bytes.data(), bytes.size(), 0);
      if (count <= 0) break;
      text.append(bytes.data(), static_cast<std::size_t>(count));
    }
    return text;
  }

private:
  int socket_;
  bool connected_ = false;
};

/// A request with these lines of headers, each with its end.
inline std::string webRequestText(const std::string& method, const std::string& path,
                                  const std::string& headers, const std::string& body = "") {
  const std::string length =
      method == "POST" ? "Content-Length: " + std::to_string(body.size()) + "\r\n" : "";
  return method + " " + path + " HTTP/1.1\r\nHost: 127.0.0.1\r\n" + headers + length + "\r\n" + body;
}

inline std::string webAnswer(std::uint16_t port, const std::string& request) {
  const WebClient client(port);
  client.send(request);
  return client.answer();
}

/// "HTTP/1.1 404 ..." has 404.
inline int webStatus(const std::string& answer) {
  return answer.size() > 12 && answer.starts_with("HTTP/1.1 ") ? std::stoi(answer.substr(9, 3)) : 0;
}

}  // namespace stadion
