#include "pipeline/device/udp_port.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <exception>
#include <string>
#include <thread>
#include <vector>

namespace stadion {
namespace {

constexpr int kLookForEndOfPort = 50;  ///< interval at which the thread checks whether it must end [ms]
constexpr std::size_t kLongestPacket = 65'536;

}  // namespace

struct UdpPort::Socket {
  int descriptor = -1;
  Handler handler;
  std::atomic<bool> ending = false;
  std::thread thread;

  ~Socket() {
    ending = true;
    if (thread.joinable()) thread.join();
    if (descriptor >= 0) ::close(descriptor);
  }

  void listen() {
    std::vector<std::uint8_t> packet(kLongestPacket);
    while (!ending) {
      pollfd waiting{descriptor, POLLIN, 0};
      if (::poll(&waiting, 1, kLookForEndOfPort) > 0) receive(packet);
    }
  }

  void receive(std::vector<std::uint8_t>& packet) const {
    sockaddr_in sender{};
    socklen_t length = sizeof sender;
    const ssize_t got = ::recvfrom(descriptor, packet.data(), packet.size(), MSG_DONTWAIT,
                                   reinterpret_cast<sockaddr*>(&sender), &length);
    if (got <= 0) return;
    std::array<char, INET_ADDRSTRLEN> name{};
    ::inet_ntop(AF_INET, &sender.sin_addr, name.data(), name.size());
    try {
      handler({packet.data(), static_cast<std::size_t>(got)}, name.data());
    } catch (const std::exception&) {
      return;  // the packet is dropped
    }
  }
};

UdpPort::UdpPort(std::unique_ptr<Socket> socket) : socket_(std::move(socket)) {
  socket_->thread = std::thread([s = socket_.get()] { s->listen(); });
}

UdpPort::~UdpPort() = default;

Result<std::unique_ptr<UdpPort>> UdpPort::open(std::uint16_t port, Handler handler) {
  auto socket = std::make_unique<Socket>();
  socket->handler = std::move(handler);
  socket->descriptor = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_port = htons(port);
  at.sin_addr.s_addr = htonl(INADDR_ANY);
  if (socket->descriptor < 0 ||
      ::bind(socket->descriptor, reinterpret_cast<const sockaddr*>(&at), sizeof at) != 0)
    return Result<std::unique_ptr<UdpPort>>::failure("UDP port " + std::to_string(port) +
                                                     " cannot be listened to; does another program have it?");
  return std::unique_ptr<UdpPort>(new UdpPort(std::move(socket)));
}

std::uint16_t UdpPort::port() const {
  sockaddr_in at{};
  socklen_t length = sizeof at;
  ::getsockname(socket_->descriptor, reinterpret_cast<sockaddr*>(&at), &length);
  return ntohs(at.sin_port);
}

}  // namespace stadion
