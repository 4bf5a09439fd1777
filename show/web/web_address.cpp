#include "show/web/web_address.h"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

namespace stadion {
namespace {

bool isIpv4(const std::string& host) {
  in_addr address{};
  return inet_pton(AF_INET, host.c_str(), &address) == 1;
}

bool isIpv6(const std::string& host) {
  in6_addr address{};
  return inet_pton(AF_INET6, host.c_str(), &address) == 1;
}

std::optional<std::uint16_t> webPortOf(std::string_view word) {
  std::uint16_t port = 0;
  const auto [end, wrong] = std::from_chars(word.data(), word.data() + word.size(), port);
  const bool whole = !word.empty() && wrong == std::errc() && end == word.data() + word.size();
  return whole ? std::optional(port) : std::nullopt;
}

/// A host and the port behind it, if there is one.
struct HostAndPort {
  std::string host;
  std::optional<std::string_view> port;
};

HostAndPort split(std::string_view text) {
  const bool bracketed = text.starts_with('[');
  const std::size_t close = bracketed ? text.find(']') : std::string_view::npos;
  if (bracketed && close == std::string_view::npos) return {std::string(text), {}};
  const std::size_t colon = text.find(':', bracketed ? close : 0);
  HostAndPort parts{std::string(bracketed ? text.substr(1, close - 1) : text.substr(0, colon)), {}};
  if (bracketed && colon != close + 1 && text.size() != close + 1) return {std::string(text), {}};
  if (colon != std::string_view::npos) parts.port = text.substr(colon + 1);
  return parts;
}

std::string lowered(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

}  // namespace

Result<WebAddress> WebAddress::parse(const std::string& text) {
  const auto refusal = [&] {
    return Result<WebAddress>::failure("\"" + text +
                                       "\" is not [HOST:]PORT with the number of an address, such as 8080, "
                                       "0.0.0.0:8080 or [::1]:8080");
  };
  WebAddress address;
  if (const auto port = webPortOf(text)) {
    address.port = *port;
    return address;
  }
  const HostAndPort parts = split(text);
  const auto port = parts.port ? webPortOf(*parts.port) : std::nullopt;
  const bool bracketed = text.starts_with('[');
  if (!port || !(bracketed ? isIpv6(parts.host) : isIpv4(parts.host))) return refusal();
  address.host = parts.host;
  address.port = *port;
  return address;
}

bool WebAddress::isLoopback() const {
  return host.starts_with("127.") || host == "::1";
}

std::string WebAddress::authority() const {
  return isIpv6(host) ? fmt::format("[{}]:{}", host, port) : fmt::format("{}:{}", host, port);
}

bool isOwnHost(std::string_view header, const std::vector<std::string>& names) {
  const HostAndPort parts = split(header);
  if (parts.port && !webPortOf(*parts.port)) return false;
  const std::string host = lowered(parts.host);
  if (header.starts_with('[')) return isIpv6(host);
  if (isIpv4(host) || host == "localhost") return true;
  return std::ranges::any_of(names, [&](const std::string& name) { return lowered(name) == host; });
}

}  // namespace stadion
