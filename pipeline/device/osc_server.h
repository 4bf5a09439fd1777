#pragma once
/// Listens to Open Sound Control messages on a UDP port (liblo).
///
/// Ownership  owns its socket and its thread; both end with it.
/// Threads    one of its own, which calls the handler; bundles with a time in the future are not delayed.
/// Errors     packets that are no OSC messages are counted and otherwise ignored; the handler must not throw.

#include "engine/base/diagnostic.h"
#include "engine/base/time_signature.h"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace stadion {

struct OscMessage {
  static constexpr std::size_t kMostNumbers = 16;

  std::string_view path;            ///< address, such as /tracker/head/pose
  std::span<const double> numbers;  ///< arguments of the message, true as 1 and false as 0
  bool numeric = true;              ///< false: there were other arguments, or too many
  std::optional<Nanoseconds> sent;  ///< the time tag, by the sender's clock [ns]
  std::string_view from{};          ///< the sender's host, if there is a time tag
};

class OscServer {
public:
  using Handler = std::function<void(const OscMessage&)>;

  /// Port 0 takes any free port. Fails if the port is taken.
  static Result<std::unique_ptr<OscServer>> open(std::uint16_t port, Handler handler);
  ~OscServer();
  OscServer(const OscServer&) = delete;
  OscServer& operator=(const OscServer&) = delete;

  /// Handles a packet as if it came over the network, but on the caller's thread.
  void decode(std::span<const std::uint8_t> packet);

  std::uint16_t port() const;
  /// Returns the number of packets that were no OSC messages.
  std::uint64_t malformed() const;

private:
  struct Socket;
  explicit OscServer(std::unique_ptr<Socket> socket);
  std::unique_ptr<Socket> socket_;
};

}  // namespace stadion
