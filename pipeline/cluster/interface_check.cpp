#include "pipeline/cluster/interface_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <arpa/inet.h>
#include <cstring>
#include <ifaddrs.h>
#include <memory>
#include <net/if.h>
#include <netinet/in.h>

namespace stadion {
namespace {

struct Interface {
  std::string name, address;
  bool multicast = false, loopback = false;
};

/// Returns the usable interfaces: up, with an IPv4 address. Returns nothing if the system gives no list.
std::optional<std::vector<Interface>> interfacesHere() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return std::nullopt;
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> owner(first, freeifaddrs);
  std::vector<Interface> all;
  for (const ifaddrs* at = first; at; at = at->ifa_next) {
    if (!at->ifa_addr || at->ifa_addr->sa_family != AF_INET || !(at->ifa_flags & IFF_UP)) continue;
    sockaddr_in address{};
    std::memcpy(&address, at->ifa_addr, sizeof address);
    char text[INET_ADDRSTRLEN] = "";
    inet_ntop(AF_INET, &address.sin_addr, text, sizeof text);
    const bool multicast = (at->ifa_flags & (IFF_MULTICAST | IFF_LOOPBACK)) != 0;
    all.push_back({at->ifa_name, text, multicast, (at->ifa_flags & IFF_LOOPBACK) != 0});
  }
  return all;
}

}  // namespace

void checkInterface(const ClusterFile& cluster, Diagnostics& out) {
  const auto here = interfacesHere();
  if (!here) return;  // then opening the network reports the error
  if (std::ranges::none_of(*here, &Interface::loopback))  // Cyclone DDS speaks to its own threads over it
    out.error({}, "this machine's loopback interface is not up: `ip link set lo up`");
  const std::string& wanted = cluster.interface;
  if (wanted.empty()) return;
  const auto is = [&](const Interface& i) { return i.name == wanted || i.address == wanted; };
  const auto at = std::ranges::find_if(*here, is);
  if (at != here->end() && at->multicast) return;
  if (at != here->end())
    return out.error(cluster.interfaceAt.where,
                     fmt::format("the network interface \"{}\" has no multicast, by which machines find each "
                                 "other; `ip link set {} multicast on`, or name another one",
                                 wanted, at->name),
                     cluster.interfaceAt.excerpt);
  std::vector<std::string> known;
  for (const Interface& i : *here) known.push_back(fmt::format("{} ({})", i.name, i.address));
  out.error(cluster.interfaceAt.where,
            fmt::format(
                "this machine has no network interface \"{}\" that is up and has an IPv4 address; {}", wanted,
                known.empty() ? "it has none at all" : fmt::format("it has {}", fmt::join(known, ", "))),
            cluster.interfaceAt.excerpt);
}

}  // namespace stadion
