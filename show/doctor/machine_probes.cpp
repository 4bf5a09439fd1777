/// The probes of the machine on which the program runs.

#include "show/doctor/doctor.h"

#include "engine/base/installed_files.h"
#include "engine/base/shared_library.h"
#include "pipeline/cpu_draw/kernels/choose_kernels.h"
#include "pipeline/platform/processor_set.h"
#include "pipeline/sound/sound_device.h"
#include "pipeline/target/target.h"
#include "pipeline/target/window.h"

#include <algorithm>
#include <arpa/inet.h>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <ifaddrs.h>
#include <map>
#include <memory>
#include <net/if.h>
#include <netinet/in.h>
#include <sched.h>
#include <set>
#include <sstream>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

bool isInPath(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (!folder.empty() && access((folder + "/" + program).c_str(), X_OK) == 0) return true;
  return false;
}

std::string helperPath(const std::string& name) {
  const std::filesystem::path path = helperProgram(name);
  return path.has_parent_path() && access(path.c_str(), X_OK) == 0 ? path.string() : "";
}

std::string cpuRendererHere() {
  const std::size_t threads = std::max<std::size_t>(1, processorsOfThisThread().size());
  return fmt::format("CPU renderer ({}), {} thread{}", bestDrawKernels().name, threads,
                     threads == 1 ? "" : "s");
}

Result<std::string> rendererOf(GlProviderKind kind) {
  auto provider = openGlProvider(kind);
  if (!provider) return provider.error();
  auto target = provider.value()->create(16, 16);
  if (!target) return target.error();
  if (const auto wrong = target.value()->makeCurrent()) return *wrong;
  const std::string renderer = describeGl(target.value()->gl());
  target.value()->release();
  return renderer;
}

std::vector<std::string> cardsOfEgl() {
  auto provider = openGlProvider(GlProviderKind::Egl);
  return provider ? provider.value()->cards() : std::vector<std::string>();
}

Result<std::string> soundName() {
  auto device = openSoundDevice();
  if (!device) return device.error();
  return device.value()->name();
}

Result<std::vector<std::string>> monitorsOf(const std::string& screen) {
  auto system = WindowSystem::open(screen);
  if (!system) return system.error();
  return system.value()->monitors();
}

Result<std::string> windowPixels() {
  auto system = WindowSystem::open();
  if (!system) return system.error();
  return system.value()->pixelsWay();
}

/// A connection to the X server of DISPLAY. A server resets when its last client leaves, and then refuses
/// clients for a moment. Without a server it holds nothing.
class HeldDisplay {
public:
  HeldDisplay() : x_(SharedLibrary::open("libX11.so.6", "libx11-6")) {
    if (!x_) return;
    auto* open = x_.value().find<void*(const char*)>("XOpenDisplay");
    close_ = x_.value().find<int(void*)>("XCloseDisplay");
    if (open && close_) display_ = open(nullptr);
  }
  ~HeldDisplay() {
    if (display_) close_(display_);
  }
  HeldDisplay(const HeldDisplay&) = delete;
  HeldDisplay& operator=(const HeldDisplay&) = delete;

private:
  Result<SharedLibrary> x_;  // first: close_ is in it
  int (*close_)(void*) = nullptr;
  void* display_ = nullptr;
};

/// From the records of dpkg: "Package: NAME", and below it "Status: install ok installed".
std::optional<std::set<std::string>> installedPackages() {
  std::ifstream file("/var/lib/dpkg/status");
  if (!file) return std::nullopt;
  constexpr std::string_view kPackage = "Package: ", kStatus = "Status: ";
  std::set<std::string> installed;
  std::string name;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(kPackage)) name = line.substr(kPackage.size());
    if (line.starts_with(kStatus) && line.ends_with(" installed")) installed.insert(name);
  }
  return installed;
}

/// What the driver of the display has. Nothing without a display.
template <class Asked>
auto ofDefaultDisplay(const Asked& asked) -> decltype(asked(nullptr)) {
  const auto x = SharedLibrary::open("libX11.so.6", "libx11-6");
  if (!x) return std::nullopt;
  auto* open = x.value().find<void*(const char*)>("XOpenDisplay");
  auto* close = x.value().find<int(void*)>("XCloseDisplay");
  if (!open || !close) return std::nullopt;
  const std::unique_ptr<void, int (*)(void*)> display(open(nullptr), close);
  if (!display) return std::nullopt;
  return asked(display.get());
}

std::optional<SwapGroupOffer> swapGroupsHere() {
  return ofDefaultDisplay([](void* display) -> std::optional<SwapGroupOffer> {
    const auto functions = SwapGroupFunctions::ofDisplay(display);
    if (!functions) return {};
    return swapGroupOffer(functions.value());
  });
}

std::optional<bool> quadBufferHere() {
  return ofDefaultDisplay([](void* display) { return offersQuadBuffer(display); });
}

/// Tried on a thread that ends at once.
bool mayBeRealtime() {
  bool may = false;
  std::thread([&may] {
    sched_param lowest{};
    lowest.sched_priority = 1;
    may = sched_setscheduler(0, SCHED_RR, &lowest) == 0;
  }).join();
  return may;
}

std::vector<NetworkPort> portsHere() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> owner(first, freeifaddrs);
  std::map<std::string, NetworkPort> ports;
  for (const ifaddrs* at = first; at; at = at->ifa_next) {
    NetworkPort& port = ports[at->ifa_name];
    port.name = at->ifa_name;
    port.up = (at->ifa_flags & IFF_UP) != 0;
    port.loopback = (at->ifa_flags & IFF_LOOPBACK) != 0;
    port.multicast = (at->ifa_flags & IFF_MULTICAST) != 0;
    if (!at->ifa_addr || at->ifa_addr->sa_family != AF_INET || !port.address.empty()) continue;
    sockaddr_in address{};
    std::memcpy(&address, at->ifa_addr, sizeof address);
    char text[INET_ADDRSTRLEN] = "";
    inet_ntop(AF_INET, &address.sin_addr, text, sizeof text);
    port.address = text;
  }
  std::vector<NetworkPort> all;
  for (auto& [name, port] : ports) all.push_back(std::move(port));
  return all;
}

std::string firstLineOf(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

}  // namespace

std::optional<Diagnostic> lackOfAddressSpace() {
  // Mostly reserved for the slots (pipeline/state/scene_state.cpp).
  constexpr rlim_t kOfShow = rlim_t{36} << 30;
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= kOfShow)
    return {};
  return Diagnostic{
      Severity::Error,
      {},
      fmt::format("the address space is limited to {} MiB (ulimit -v), and a show reserves {} MiB; "
                  "remove the limit: ulimit -v unlimited",
                  limit.rlim_cur >> 20, kOfShow >> 20),
      {}};
}

DoctorProbes probesOfThisMachine() {
  DoctorProbes probes;
  probes.hasProgram = isInPath;
  probes.helper = helperPath;
  probes.cpuRenderer = cpuRendererHere;
  probes.softwareGl = [] { return rendererOf(GlProviderKind::OsMesa); };
  probes.hardwareGl = [] { return rendererOf(GlProviderKind::Egl); };
  probes.cards = cardsOfEgl;
  probes.sound = soundName;
  probes.swapGroups = swapGroupsHere;
  probes.quadBuffer = quadBufferHere;
  probes.packages = installedPackages;
  probes.monitors = [held = std::make_shared<HeldDisplay>()](const std::string& screen) {
    return monitorsOf(screen);
  };
  probes.windowPixels = windowPixels;
  probes.isRoot = [] { return geteuid() == 0; };
  probes.realtime = mayBeRealtime;
  probes.network = portsHere;
  probes.file = firstLineOf;
  probes.exists = [](const std::string& path) { return access(path.c_str(), F_OK) == 0; };
  probes.writable = [](const std::string& path) { return access(path.c_str(), W_OK) == 0; };
  return probes;
}

}  // namespace stadion
