#pragma once
/// A projector on loopback that answers PJLink as a test wants.

#include "pipeline/projector_control/pjlink_projector.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <functional>
#include <string>
#include <thread>

namespace stadion::test {

/// A projector: it greets, then answers each line by a function. An empty answer closes the connection.
class FakeProjector {
public:
  using Answer = std::function<std::string(const std::string& line)>;

  FakeProjector(std::string greeting, Answer answer)
      : greeting_(std::move(greeting)), answer_(std::move(answer)),
        socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&at), sizeof at), 0);
    EXPECT_EQ(::listen(socket_, 4), 0);
    socklen_t length = sizeof at;
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&at), &length);
    port_ = ntohs(at.sin_port);
    thread_ = std::thread([this] { serve(); });
  }

  ~FakeProjector() {
    ending_ = true;
    thread_.join();
    ::close(socket_);
  }

  PjlinkAddress address(const std::string& password = {}) const {
    return {"127.0.0.1", port_, password, std::chrono::milliseconds(2000)};
  }

private:
  bool readable(int socket) const {
    while (!ending_) {
      pollfd waiting{socket, POLLIN, 0};
      if (::poll(&waiting, 1, 20) > 0) return true;
    }
    return false;
  }

  void serve() {
    while (readable(socket_)) {
      const int client = ::accept(socket_, nullptr, nullptr);
      if (client < 0) continue;
      talk(client);
      ::close(client);
    }
  }

  void talk(int client) const {
    send(client, greeting_);
    std::string line;
    while (readable(client)) {
      char c = 0;
      if (::recv(client, &c, 1, 0) <= 0) return;
      if (c != '\r') {
        line += c;
        continue;
      }
      const std::string answer = answer_(line);
      line.clear();
      if (answer.empty()) return;
      send(client, answer);
    }
  }

  static void send(int client, const std::string& text) {
    EXPECT_EQ(::send(client, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }

  std::string greeting_;
  Answer answer_;
  int socket_;
  std::uint16_t port_ = 0;
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

}  // namespace stadion::test
