#pragma once
/// Listens to a UDP port on a thread of its own.
///
/// Ownership  owns its socket and its thread; both end with it.
/// Threads    the handler is called on the port's thread; it must not throw anything but std::exception.
/// Errors     a packet whose handler throws is dropped. Packets beyond 64 KiB do not exist in UDP.

#include "engine/base/diagnostic.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

namespace stadion {

class UdpPort {
public:
  /// `from`: the sender's address, as numbers.
  using Handler = std::function<void(std::span<const std::uint8_t> packet, std::string_view from)>;

  /// Port 0 takes any free port. Fails if the port is taken.
  static Result<std::unique_ptr<UdpPort>> open(std::uint16_t port, Handler handler);
  ~UdpPort();
  UdpPort(const UdpPort&) = delete;
  UdpPort& operator=(const UdpPort&) = delete;

  std::uint16_t port() const;

private:
  struct Socket;
  explicit UdpPort(std::unique_ptr<Socket> socket);
  std::unique_ptr<Socket> socket_;
};

}  // namespace stadion
