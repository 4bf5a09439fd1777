#include "pipeline/supervision/service_notifier.h"

#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <string_view>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <utility>

namespace stadion {
namespace {

/// A whole number of the environment; nothing: there is none.
std::optional<std::uint64_t> numberOfEnvironment(const char* name) {
  const char* text = std::getenv(name);
  if (!text) return {};
  std::uint64_t value = 0;
  const char* end = text + std::strlen(text);
  const auto [at, wrong] = std::from_chars(text, end, value);
  return wrong == std::errc() && at == end ? std::optional(value) : std::nullopt;
}

/// A line break would begin another variable.
std::string statusLine(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r' || c == '\0') c = ' ';
  return text;
}

}  // namespace

ServiceAddress ServiceAddress::ofEnvironment() {
  constexpr std::uint64_t kMostMicroseconds = 1'000'000ULL * 86'400 * 365;
  ServiceAddress address;
  if (const char* socket = std::getenv("NOTIFY_SOCKET")) address.socket = socket;
  const auto limit = numberOfEnvironment("WATCHDOG_USEC"), process = numberOfEnvironment("WATCHDOG_PID");
  const bool ours = !std::getenv("WATCHDOG_PID") || process == static_cast<std::uint64_t>(getpid());
  if (limit && ours && *limit <= kMostMicroseconds)
    address.watchdog = static_cast<Nanoseconds>(*limit) * 1000;
  for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) unsetenv(name);
  return address;
}

std::unique_ptr<ServiceNotifier> ServiceNotifier::open(const ServiceAddress& address, Clock clock) {
  std::string name = address.socket;
  constexpr std::size_t kMostBytes = sizeof(sockaddr_un::sun_path);
  const bool isAbstract = name.starts_with('@');
  // A path needs its final zero byte, an abstract name does not.
  if (name.size() < 2 || name.size() + (isAbstract ? 0 : 1) > kMostBytes) return nullptr;
  if (!isAbstract && !name.starts_with('/')) return nullptr;
  if (isAbstract) name.front() = '\0';
  FileDescriptor socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!socket) return nullptr;
  return std::unique_ptr<ServiceNotifier>(
      new ServiceNotifier(std::move(socket), std::move(name), address.watchdog, clock));
}

bool ServiceNotifier::send(const std::string& lines) const {
  sockaddr_un to{};
  to.sun_family = AF_UNIX;
  std::memcpy(to.sun_path, address_.data(), address_.size());
  const bool isAbstract = address_.front() == '\0';
  const auto length =
      static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address_.size() + (isAbstract ? 0 : 1));
  return ::sendto(socket_.get(), lines.data(), lines.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                  reinterpret_cast<const sockaddr*>(&to), length) >= 0;
}

std::string ServiceNotifier::limitLine(int times) const {
  return fmt::format("WATCHDOG_USEC={}\n", times * watchdog_ / 1000);
}

void ServiceNotifier::pictureShown(const std::string& status) {
  if (!ready_) {
    if (send("READY=1\nSTATUS=" + statusLine(status) + "\n")) ready_ = true;
    pinged_ = clock_();  // the limit counts from READY=1
    if (pauses_) mayPause(true);
    return;
  }
  // Frames that were in flight may still come after the pause began.
  if (!pauses_ && longer_.exchange(false)) {
    send(limitLine(1) + "WATCHDOG=1\n");
    pinged_ = clock_();
    return;
  }
  alive();
}

void ServiceNotifier::alive() {
  if (watchdog_ <= 0 || !ready_) return;
  const Nanoseconds now = clock_();
  Nanoseconds before = pinged_;
  if (now - before < watchdog_ / kPings || !pinged_.compare_exchange_strong(before, now)) return;
  send("WATCHDOG=1\n");
}

void ServiceNotifier::status(const std::string& text) {
  std::string line = statusLine(text);
  if (line == status_) return;
  status_ = std::move(line);
  send("STATUS=" + status_ + "\n");
}

void ServiceNotifier::mayPause(bool may) {
  pauses_ = may;
  if (!may || watchdog_ <= 0 || !ready_ || longer_.exchange(true)) return;
  send(limitLine(kLonger) + "WATCHDOG=1\n");
  pinged_ = clock_();
}

void ServiceNotifier::stopping() {
  if (std::exchange(stopping_, true)) return;
  send("STOPPING=1\nSTATUS=ends\n");
}

}  // namespace stadion
