#include "pipeline/device/osc_server.h"

#include <lo/lo.h>
#include <lo/lo_lowlevel.h>

#include <array>
#include <cstring>
#include <exception>
#include <thread>
#include <vector>

namespace stadion {
namespace {

constexpr int kLookForEnd = 50;  ///< interval at which the thread checks whether it must end [ms]

/// Arguments lie in the packet in network byte order, on multiples of four bytes.
template <class T>
double read(const lo_arg* a) {
  T value;
  std::memcpy(&value, static_cast<const void*>(a), sizeof value);
  return static_cast<double>(value);
}

/// Returns an argument as a number; nothing if it is none.
std::optional<double> numberOf(char type, const lo_arg* a) {
  switch (type) {
  case LO_INT32: return read<std::int32_t>(a);
  case LO_INT64: return read<std::int64_t>(a);
  case LO_FLOAT: return read<float>(a);
  case LO_DOUBLE: return read<double>(a);
  case LO_TRUE: return 1;
  case LO_FALSE: return 0;
  default: return {};
  }
}

std::optional<Nanoseconds> timeOf(lo_timetag tag) {
  if (tag.sec == 0) return {};  // immediately
  return static_cast<Nanoseconds>(tag.sec) * 1'000'000'000 +
         static_cast<Nanoseconds>(std::uint64_t{tag.frac} * 1'000'000'000 >> 32);
}

}  // namespace

struct OscServer::Socket {
  lo_server server = nullptr;
  Handler handler;
  std::atomic<std::uint64_t> malformed = 0;
  std::atomic<bool> ending = false;
  std::thread thread;

  ~Socket() {
    ending = true;
    if (thread.joinable()) thread.join();
    if (server) lo_server_free(server);
  }

  static int receive(const char* path, const char* types, lo_arg** args, int count, lo_message message,
                     void* self) {
    try {
      static_cast<Socket*>(self)->take(path, types, args, count, message);
    } catch (const std::exception&) {
      ++static_cast<Socket*>(self)->malformed;
    }
    return 0;
  }

  void take(const char* path, const char* types, lo_arg** args, int count, lo_message message) const {
    std::array<double, OscMessage::kMostNumbers> numbers{};
    OscMessage m{path, {}, true, timeOf(lo_message_get_timestamp(message))};
    const lo_address sender = m.sent ? lo_message_get_source(message) : nullptr;
    if (const char* host = sender ? lo_address_get_hostname(sender) : nullptr) m.from = host;
    std::size_t n = 0;
    for (int i = 0; i < count; ++i) {
      const auto x = numberOf(types[i], args[i]);
      if (!x || n == numbers.size()) {
        m.numeric = false;
        break;
      }
      numbers[n++] = *x;
    }
    m.numbers = {numbers.data(), n};
    handler(m);
  }

  void listen() {
    while (!ending)
      if (lo_server_wait(server, kLookForEnd) > 0 && lo_server_recv_noblock(server, 0) < 0) ++malformed;
  }
};

OscServer::OscServer(std::unique_ptr<Socket> socket) : socket_(std::move(socket)) {
  socket_->thread = std::thread([s = socket_.get()] { s->listen(); });
}

OscServer::~OscServer() = default;

Result<std::unique_ptr<OscServer>> OscServer::open(std::uint16_t port, Handler handler) {
  auto socket = std::make_unique<Socket>();
  socket->handler = std::move(handler);
  const std::string name = std::to_string(port);
  socket->server = lo_server_new_with_proto(port == 0 ? nullptr : name.c_str(), LO_UDP,
                                            [](int, const char*, const char*) {});
  if (!socket->server)
    return Result<std::unique_ptr<OscServer>>::failure(
        "UDP port " + name + " cannot be listened to; does another program have it?");
  // A time tag is the time of measurement, not a time for execution.
  lo_server_enable_queue(socket->server, 0, 1);
  lo_server_add_method(socket->server, nullptr, nullptr, &Socket::receive, socket.get());
  return std::unique_ptr<OscServer>(new OscServer(std::move(socket)));
}

void OscServer::decode(std::span<const std::uint8_t> packet) {
  std::vector<std::uint8_t> bytes(packet.begin(), packet.end());  // liblo swaps bytes in place
  if (lo_server_dispatch_data(socket_->server, bytes.data(), bytes.size()) < 0) ++socket_->malformed;
}

std::uint16_t OscServer::port() const {
  return static_cast<std::uint16_t>(lo_server_get_port(socket_->server));
}

std::uint64_t OscServer::malformed() const {
  return socket_->malformed;
}

}  // namespace stadion
