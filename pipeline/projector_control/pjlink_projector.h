#pragma once
/// Commands a projector over the network with PJLink, class 1: power, shutter, faults, hours of its lamps.
///
/// Ownership  owns its connection.
/// Threads    one at a time. Each call waits for the projector, at most so long as `patience` states for each
///            line. The name of a host may take longer to look up.
/// Errors     one sentence: no connection, silence, a wrong password, a refusal, or an answer that PJLink does
///            not have. After an error the connection is closed; open another one.

#include "engine/base/diagnostic.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

struct PjlinkAddress {
  std::string host;
  std::uint16_t port = 4352;
  std::string password;  ///< empty: none
  std::chrono::milliseconds patience{5000};
};

struct PjlinkStatus {
  enum class Power { Off, On, Cooling, Warming };
  Power power = Power::Off;
  bool shut = false;                ///< the picture is dark, by shutter or otherwise
  std::vector<std::string> faults;  ///< "lamp: warning", "filter: error"
  std::vector<std::uint32_t> lampHours;
  std::string maker, model;  ///< as it states them
};

/// "off", "on", "cooling down", "warming up".
std::string_view nameOf(PjlinkStatus::Power power);

class PjlinkProjector {
public:
  static Result<std::unique_ptr<PjlinkProjector>> open(const PjlinkAddress& address);
  ~PjlinkProjector();
  PjlinkProjector(const PjlinkProjector&) = delete;
  PjlinkProjector& operator=(const PjlinkProjector&) = delete;

  // Each returns why it failed, or nothing. A projector takes up to minutes to warm up or cool down; status()
  // shows that.
  std::optional<Diagnostic> setPower(bool on);
  std::optional<Diagnostic> setShutter(bool shut);
  Result<PjlinkStatus> status();

private:
  struct Connection;
  PjlinkProjector(std::unique_ptr<Connection> connection, std::string digest);
  Result<std::string> ask(std::string_view body, std::string_view parameter);
  std::optional<Diagnostic> order(std::string_view body, std::string_view parameter);

  std::unique_ptr<Connection> connection_;
  std::string digest_;  ///< for the first command
};

}  // namespace stadion
