#include "pipeline/cluster/loopback_sockets.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <sys/socket.h>

namespace stadion::cluster {
namespace {

int optionOf(int socket, int option) {
  int value = 0;
  socklen_t size = sizeof value;
  return getsockopt(socket, SOL_SOCKET, option, &value, &size) == 0 ? value : -1;
}

bool isUdp(int descriptor) {
  const int domain = optionOf(descriptor, SO_DOMAIN);
  return optionOf(descriptor, SO_TYPE) == SOCK_DGRAM && (domain == AF_INET || domain == AF_INET6);
}

}  // namespace

std::set<int> udpSockets() {
  std::set<int> sockets;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", none)) {
    const std::string name = entry.path().filename().string();
    int descriptor = -1;
    std::from_chars(name.data(), name.data() + name.size(), descriptor);
    if (isUdp(descriptor)) sockets.insert(descriptor);
  }
  return sockets;
}

LoopbackSockets::LoopbackSockets() : before_(udpSockets()) {}

std::string LoopbackSockets::bind() const {
  constexpr std::string_view kLoopback = "lo";
  for (const int socket : udpSockets())
    if (!before_.contains(socket) &&
        setsockopt(socket, SOL_SOCKET, SO_BINDTODEVICE, kLoopback.data(), kLoopback.size()) != 0)
      return std::string("its sockets cannot be kept to the loopback interface: ") + std::strerror(errno);
  return {};
}

}  // namespace stadion::cluster
