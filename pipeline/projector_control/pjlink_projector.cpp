#include "pipeline/projector_control/pjlink_projector.h"

#include "pipeline/projector_control/pjlink_line.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <utility>

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;

template <class T>
Result<T> failed(std::string what) {
  return Result<T>::failure(std::move(what));
}

/// Waits until the socket can be used, at most until then. False: it cannot.
bool waitFor(int socket, short events, Clock::time_point until) {
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
    if (left <= 0) return false;
    pollfd waiting{socket, events, 0};
    const int ready = ::poll(&waiting, 1, static_cast<int>(std::min<long long>(left, 1000)));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
}

int errorOf(int socket) {
  int error = 0;
  socklen_t length = sizeof error;
  ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &length);
  return error;
}

std::string secondsOf(std::chrono::milliseconds patience) {
  return fmt::format("{} s", static_cast<double>(patience.count()) / 1000);
}

}  // namespace

struct PjlinkProjector::Connection {
  int socket = -1;
  std::chrono::milliseconds patience{};
  std::string received;  ///< of the next line

  Connection() = default;
  ~Connection() { close(); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void close() {
    if (socket >= 0) ::close(std::exchange(socket, -1));
  }

  /// Connects to one of a host's addresses. Returns why it failed, or nothing.
  std::optional<std::string> connectTo(const addrinfo& at) {
    close();
    socket = ::socket(at.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (socket < 0) return std::string(std::strerror(errno));
    if (::connect(socket, at.ai_addr, at.ai_addrlen) == 0) return std::nullopt;
    if (errno != EINPROGRESS) return std::string(std::strerror(errno));
    if (!waitFor(socket, POLLOUT, Clock::now() + patience))
      return fmt::format("no answer within {}", secondsOf(patience));
    if (const int error = errorOf(socket)) return std::string(std::strerror(error));
    return std::nullopt;
  }

  std::optional<std::string> send(std::string_view text) {
    const auto until = Clock::now() + patience;
    while (!text.empty()) {
      if (socket < 0 || !waitFor(socket, POLLOUT, until)) return "it takes no command";
      const ssize_t sent = ::send(socket, text.data(), text.size(), MSG_NOSIGNAL);
      if (sent < 0 && errno != EAGAIN && errno != EINTR) return "it closed the connection";
      if (sent > 0) text.remove_prefix(static_cast<std::size_t>(sent));
    }
    return std::nullopt;
  }

  /// Returns the next line without its carriage return.
  Result<std::string> line() {
    const auto until = Clock::now() + patience;
    for (;;) {
      if (const auto end = received.find('\r'); end != std::string::npos) {
        std::string found = received.substr(0, end);
        received.erase(0, end + 1);
        return found;
      }
      if (received.size() >= pjlink::kLongestLine)
        return failed<std::string>("it sends lines without an end");
      if (socket < 0 || !waitFor(socket, POLLIN, until))
        return failed<std::string>(fmt::format("no answer within {}", secondsOf(patience)));
      std::array<char, 256> bytes;
      const ssize_t got = ::recv(socket, bytes.data(), bytes.size(), 0);
      if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR))
        return failed<std::string>("it closed the connection");
      if (got > 0) received.append(bytes.data(), static_cast<std::size_t>(got));
    }
  }
};

std::string_view nameOf(PjlinkStatus::Power power) {
  switch (power) {
  case PjlinkStatus::Power::Off: return "off";
  case PjlinkStatus::Power::On: return "on";
  case PjlinkStatus::Power::Cooling: return "cooling down";
  case PjlinkStatus::Power::Warming: return "warming up";
  }
  return "";
}

PjlinkProjector::PjlinkProjector(std::unique_ptr<Connection> connection, std::string digest)
    : connection_(std::move(connection)), digest_(std::move(digest)) {}

PjlinkProjector::~PjlinkProjector() = default;

Result<std::unique_ptr<PjlinkProjector>> PjlinkProjector::open(const PjlinkAddress& address) {
  using Opened = Result<std::unique_ptr<PjlinkProjector>>;
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int code = ::getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &wanted, &found);
  if (code != 0)
    return Opened::failure(
        fmt::format("the host {} is not known: {}", pjlink::printable(address.host), ::gai_strerror(code)));
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> addresses(found, ::freeaddrinfo);
  auto connection = std::make_unique<Connection>();
  connection->patience = address.patience;
  std::optional<std::string> why = "it has no address";
  for (const addrinfo* at = found; at && why; at = at->ai_next) why = connection->connectTo(*at);
  if (why) return Opened::failure(fmt::format("cannot connect: {}", *why));
  const auto greeting = connection->line();
  if (!greeting) return Opened::failure(greeting.error().message);
  const auto challenge = pjlink::challengeOf(greeting.value());
  if (!challenge) return Opened::failure(challenge.error().message);
  if (!challenge.value().empty() && address.password.empty())
    return Opened::failure("it wants a password; state the file that has it");
  std::string digest = challenge.value().empty() ? "" : pjlink::digestOf(challenge.value(), address.password);
  return std::unique_ptr<PjlinkProjector>(new PjlinkProjector(std::move(connection), std::move(digest)));
}

Result<std::string> PjlinkProjector::ask(std::string_view body, std::string_view parameter) {
  auto fail = [&](std::string why) {
    connection_->close();
    return failed<std::string>(std::move(why));
  };
  if (const auto why = connection_->send(std::exchange(digest_, {}) + pjlink::commandLine(body, parameter)))
    return fail(*why);
  const auto line = connection_->line();
  if (!line) return fail(line.error().message);
  auto answer = pjlink::answerTo(body, line.value());
  if (!answer && !line.value().starts_with('%')) connection_->close();
  return answer;
}

std::optional<Diagnostic> PjlinkProjector::order(std::string_view body, std::string_view parameter) {
  const auto answer = ask(body, parameter);
  if (!answer) return answer.error();
  if (answer.value() == "OK") return std::nullopt;
  return failed<int>(fmt::format("it answers \"{}\" instead of OK", pjlink::printable(answer.value())))
      .error();
}

std::optional<Diagnostic> PjlinkProjector::setPower(bool on) {
  return order("POWR", on ? "1" : "0");
}

std::optional<Diagnostic> PjlinkProjector::setShutter(bool shut) {
  return order("AVMT", shut ? "31" : "30");
}

namespace {

/// Words for the six digits of ERST.
std::vector<std::string> faultsOf(std::string_view digits) {
  constexpr std::array<const char*, 6> kParts{"fan", "lamp", "temperature", "cover", "filter", "other"};
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < std::min(digits.size(), kParts.size()); ++i)
    if (digits[i] == '1' || digits[i] == '2')
      faults.push_back(fmt::format("{}: {}", kParts[i], digits[i] == '1' ? "warning" : "error"));
  return faults;
}

/// "HOURS ON" for each lamp; what is not a number ends the list.
std::vector<std::uint32_t> lampHoursOf(std::string_view text) {
  std::vector<std::uint32_t> hours;
  for (bool isHours = true; !text.empty(); isHours = !isHours) {
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc()) break;
    if (isHours) hours.push_back(number);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  }
  return hours;
}

}  // namespace

Result<PjlinkStatus> PjlinkProjector::status() {
  PjlinkStatus status;
  const auto power = ask("POWR", "?");
  if (!power) return power.error();
  if (power.value().size() != 1 || power.value()[0] < '0' || power.value()[0] > '3')
    return failed<PjlinkStatus>(
        fmt::format("it answers \"{}\" to POWR ?, instead of 0 to 3", pjlink::printable(power.value())));
  status.power = static_cast<PjlinkStatus::Power>(power.value()[0] - '0');
  // What follows may be refused while it is off.
  if (const auto mute = ask("AVMT", "?")) status.shut = mute.value() == "31" || mute.value() == "11";
  if (const auto faults = ask("ERST", "?")) status.faults = faultsOf(faults.value());
  if (const auto lamps = ask("LAMP", "?")) status.lampHours = lampHoursOf(lamps.value());
  if (const auto maker = ask("INF1", "?")) status.maker = pjlink::printable(maker.value());
  const auto model = ask("INF2", "?");
  if (model) status.model = pjlink::printable(model.value());
  if (connection_->socket < 0) return model.error();  // lost on the way
  return status;
}

}  // namespace stadion
