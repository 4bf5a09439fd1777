/// lossy-network PREFIX NODES LOSS-PERCENT JITTER-MS
///
/// Network namespaces PREFIX-0, PREFIX-1, ..., each with an interface eth0 (10.77.0.1, 10.77.0.2, ... /24),
/// and between them a relay in this program that loses and delays what it forwards. Says "ready" when all is
/// there, and removes it once its input ends. Needs to be root.

#include <arpa/inet.h>
#include <linux/ethtool.h>
#include <linux/if_packet.h>
#include <linux/sockios.h>
#include <net/ethernet.h>
#include <net/if.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <queue>
#include <random>
#include <string>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;
using Bytes = std::vector<std::uint8_t>;
using Address = std::array<std::uint8_t, ETH_ALEN>;

constexpr std::size_t kMostBytes = 65536;
constexpr std::size_t kNowhere = ~std::size_t{0};

bool shell(const std::string& command) {
  return std::system((command + " 2>/dev/null").c_str()) == 0;
}

/// Whole packets with whole checksums, as they would be on a wire.
void switchOffOffloading(const std::string& interface) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  for (const std::uint32_t what : {ETHTOOL_STXCSUM, ETHTOOL_SSG, ETHTOOL_STSO, ETHTOOL_SGSO, ETHTOOL_SUFO}) {
    ethtool_value off{what, 0};
    ifreq request{};
    std::strncpy(request.ifr_name, interface.c_str(), IFNAMSIZ - 1);
    request.ifr_data = reinterpret_cast<char*>(&off);
    ::ioctl(socket, SIOCETHTOOL, &request);  // what an interface does not know it does not do
  }
  ::close(socket);
}

/// One end of a cable; the other one is in a namespace.
struct Port {
  std::string space, interface;
  int socket = -1;

  bool open(const std::string& prefix, std::size_t n) {
    const std::string number = std::to_string(n), inside = "v" + prefix + number;
    space = prefix + "-" + number, interface = "u" + prefix + number;
    if (!shell("ip netns add " + space)) return false;
    if (!shell("ip link add " + interface + " type veth peer name " + inside)) return false;
    switchOffOffloading(inside);
    const std::string in = "ip netns exec " + space + " ip ";
    const bool well = shell("ip link set " + interface + " up") &&
                      shell("ip link set " + inside + " netns " + space) &&
                      shell(in + "link set " + inside + " name eth0") &&
                      shell(in + "addr add 10.77.0." + std::to_string(n + 1) + "/24 dev eth0") &&
                      shell(in + "link set lo up") && shell(in + "link set eth0 up") &&
                      shell(in + "route add 224.0.0.0/4 dev eth0");
    if (!well) return false;
    socket = ::socket(AF_PACKET, SOCK_RAW, htons(ETH_P_ALL));
    sockaddr_ll at{};
    at.sll_family = AF_PACKET, at.sll_protocol = htons(ETH_P_ALL);
    at.sll_ifindex = static_cast<int>(if_nametoindex(interface.c_str()));
    return ::bind(socket, reinterpret_cast<const sockaddr*>(&at), sizeof(at)) == 0;
  }
  void close() const {
    if (socket >= 0) ::close(socket);
    shell("ip link del " + interface);
    shell("ip netns del " + space);
  }
};

/// What is under way to a port.
struct Parcel {
  Clock::time_point due;
  std::size_t to;
  Bytes bytes;
  bool operator<(const Parcel& other) const { return due > other.due; }
};

class Relay {
public:
  Relay(std::vector<Port>& ports, double loss, double jitter)
      : ports_(ports), lost_(loss), delay_(0, jitter) {}

  /// Until the input ends.
  void run() {
    std::vector<pollfd> all{{STDIN_FILENO, POLLIN, 0}};
    for (const Port& p : ports_) all.push_back({p.socket, POLLIN, 0});
    for (;;) {
      const int wait = under_.empty() ? 1000 : 0;
      ::poll(all.data(), all.size(), wait);
      if (all[0].revents != 0) return;
      for (std::size_t i = 0; i < ports_.size(); ++i)
        if (all[i + 1].revents != 0) take(i);
      for (; !under_.empty() && under_.top().due <= Clock::now(); under_.pop()) give(under_.top());
      if (!under_.empty()) ::usleep(50);
    }
  }
  std::uint64_t forwarded = 0, dropped = 0;

private:
  void take(std::size_t from) {
    for (;;) {
      Bytes bytes(kMostBytes);
      sockaddr_ll whose{};
      socklen_t size = sizeof(whose);
      const ssize_t n = ::recvfrom(ports_[from].socket, bytes.data(), bytes.size(), MSG_DONTWAIT,
                                   reinterpret_cast<sockaddr*>(&whose), &size);
      if (n < static_cast<ssize_t>(sizeof(ether_header))) return;
      if (whose.sll_pkttype == PACKET_OUTGOING) continue;  // our own
      bytes.resize(static_cast<std::size_t>(n));
      Address to{}, by{};
      std::copy_n(bytes.begin(), ETH_ALEN, to.begin());
      std::copy_n(bytes.begin() + ETH_ALEN, ETH_ALEN, by.begin());
      known_[by] = from;
      const auto at = known_.find(to);
      const std::size_t only = (to[0] & 1) == 0 && at != known_.end() ? at->second : kNowhere;
      for (std::size_t p = 0; p < ports_.size(); ++p)
        if (p != from && (only == kNowhere || p == only)) send(p, bytes);
    }
  }
  void send(std::size_t to, const Bytes& bytes) {
    constexpr std::size_t kProtocol = 23, kUdp = 17;
    const bool datagram =
        bytes.size() > kProtocol && bytes[12] == 8 && bytes[13] == 0 && bytes[kProtocol] == kUdp;
    if (datagram && lost_(random_)) return void(++dropped);
    ++forwarded;
    const std::chrono::duration<double, std::milli> delay(datagram ? delay_(random_) : 0);
    under_.push({Clock::now() + std::chrono::duration_cast<Clock::duration>(delay), to, bytes});
  }
  void give(const Parcel& parcel) {
    ::send(ports_[parcel.to].socket, parcel.bytes.data(), parcel.bytes.size(), 0);
  }

  std::vector<Port>& ports_;
  std::bernoulli_distribution lost_;
  std::uniform_real_distribution<double> delay_;
  std::mt19937 random_{20260711};
  std::map<Address, std::size_t> known_;
  std::priority_queue<Parcel> under_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) return std::fprintf(stderr, "usage: lossy-network PREFIX NODES LOSS-PERCENT JITTER-MS\n"), 2;
  std::vector<Port> ports(std::stoul(argv[2]));
  bool well = true;
  for (std::size_t i = 0; well && i < ports.size(); ++i) well = ports[i].open(argv[1], i);
  std::printf(well ? "ready\n" : "cannot make network namespaces\n");
  std::fflush(stdout);
  const sched_param cable{1};  // which waits for no processor
  sched_setscheduler(0, SCHED_RR, &cable);
  Relay relay(ports, std::stod(argv[3]) / 100, std::stod(argv[4]));
  if (well) relay.run();
  for (const Port& p : ports) p.close();
  std::printf("%llu datagrams and frames forwarded, %llu lost\n",
              static_cast<unsigned long long>(relay.forwarded),
              static_cast<unsigned long long>(relay.dropped));
  return well ? 0 : 1;
}
