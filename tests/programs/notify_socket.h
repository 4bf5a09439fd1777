#pragma once
/// The socket of a service manager, as a test listens to it.

#include "engine/base/file_descriptor.h"

#include <cstddef>
#include <cstring>
#include <optional>
#include <poll.h>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <vector>

namespace stadion {

class NotifySocket {
public:
  /// `address`: a path, or "@name" of an abstract socket.
  explicit NotifySocket(std::string address) : address_(std::move(address)) {
    sockaddr_un own{};
    own.sun_family = AF_UNIX;
    std::memcpy(own.sun_path, address_.data(), address_.size());
    const bool isAbstract = own.sun_path[0] == '@';
    if (isAbstract) own.sun_path[0] = '\0';
    const auto length =
        static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address_.size() + !isAbstract);
    socket_ = FileDescriptor(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    bound_ = ::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&own), length) == 0;
  }

  bool isOpen() const { return bound_; }
  const std::string& address() const { return address_; }
  /// The next message; nothing if none comes in that time [ms].
  std::optional<std::string> next(int wait = 0) const {
    pollfd waiting{socket_.get(), POLLIN, 0};
    if (::poll(&waiting, 1, wait) <= 0) return {};
    std::string text(4096, '\0');
    const ssize_t got = ::recv(socket_.get(), text.data(), text.size(), MSG_DONTWAIT);
    if (got < 0) return {};
    text.resize(static_cast<std::size_t>(got));
    return text;
  }
  /// All messages that have come.
  std::vector<std::string> all() const {
    std::vector<std::string> texts;
    while (auto text = next()) texts.push_back(*text);
    return texts;
  }

private:
  std::string address_;
  FileDescriptor socket_;
  bool bound_ = false;
};

}  // namespace stadion
