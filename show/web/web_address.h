#pragma once
/// The address that the operator's page listens on: `[HOST:]PORT`.
///
///     8080              loopback alone, 127.0.0.1
///     0.0.0.0:8080      all addresses of the machine
///     [::1]:8080        an IPv6 address stands in brackets
///
/// The host is a number: a name may stand for several addresses, or for another one tomorrow.
///
/// Threads  plain values and pure functions.
/// Errors   a text that is no address is refused with what is expected.

#include "engine/base/diagnostic.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

struct WebAddress {
  std::string host = "127.0.0.1";  ///< a number, without brackets
  std::uint16_t port = 0;          ///< 0: any free port

  static Result<WebAddress> parse(const std::string& text);

  bool isLoopback() const;
  /// Returns HOST:PORT as it stands in an address of a browser.
  std::string authority() const;
};

/// Returns true if a request with this Host header may be answered. The header must be the number of an address,
/// `localhost`, or one of `names`. Other names are refused: a foreign page could point a name of its own at this
/// machine and so read the show (DNS rebinding).
bool isOwnHost(std::string_view header, const std::vector<std::string>& names);

}  // namespace stadion
