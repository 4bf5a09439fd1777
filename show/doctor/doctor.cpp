#include "show/doctor/doctor.h"

#include "engine/display/wall_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace stadion {
namespace {

constexpr std::array<std::string_view, 16> kTopics{
    "programs",  "drawing",  "gpu",     "displays", "swap-groups",  "quad-buffer", "sound", "video",
    "measuring", "realtime", "network", "clock",    "measurements", "tests",       "peers", "fuzzing"};

// The launcher installs the same ones.
constexpr const char* kTestPackages[] = {"xvfb",
                                         "xserver-xorg-core",
                                         "xserver-xorg-video-dummy",
                                         "xserver-xorg-dev",
                                         "xdotool",
                                         "imagemagick",
                                         "chromium",
                                         "ffmpeg",
                                         "assimp-testmodels",
                                         "valgrind",
                                         "iproute2",
                                         "procps",
                                         "systemd"};
constexpr const char* kPeerPackages[] = {"libbullet-dev", "libode-dev", "libmujoco-dev",
                                         "libopenscenegraph-dev", "libegl-dev"};
constexpr const char* kFuzzPackages[] = {"clang", "libclang-rt-dev"};

constexpr const char* kClock = "/sys/devices/system/clocksource/clocksource0/";

class Examination {
public:
  Examination(const DoctorProbes& probes, const DoctorNeeds& needs) : probes_(probes), needs_(needs) {}

  std::vector<DoctorFinding> findings() {
    programs();
    drawing();
    gpu();
    displays();
    swapGroups();
    quadBuffer();
    sound();
    video();
    measuring();
    realtime();
    network();
    clock();
    measurements();
    packages("tests", kTestPackages, "./stadion test skips tests, or installs the packages first");
    packages("peers", kPeerPackages, "bench dynamics and bench walls compare with no other engine",
             " && ./stadion setup peers  # in a checkout, which builds");
    packages("fuzzing", kFuzzPackages, "./stadion fuzz cannot build, or installs the packages first");
    for (DoctorFinding& f : found_)
      f.asked = std::ranges::find(needs_.topics, f.topic) != needs_.topics.end();
    if (probes_.isRoot())
      for (DoctorFinding& f : found_) f.mend = withoutSudo(std::move(f.mend));
    return std::move(found_);
  }

private:
  void add(const char* topic, Health health, std::string found, std::string lacks = "",
           std::string mend = "") {
    found_.push_back({topic, health, std::move(found), std::move(lacks), std::move(mend)});
  }

  /// As root, sudo is not needed and may not be installed.
  static std::string withoutSudo(std::string command) {
    constexpr std::string_view kSudo = "sudo ";
    for (std::size_t at = 0; (at = command.find(kSudo, at)) != std::string::npos;)
      command.erase(at, kSudo.size());
    return command;
  }

  void programs() {
    std::vector<std::string> missing;
    for (const char* name : {"stadion-import", "stadion-wall"})
      if (probes_.helper(name).empty()) missing.emplace_back(name);
    if (missing.empty()) return add("programs", Health::Works, "stadion-import, stadion-wall");
    add("programs", Health::Missing, fmt::format("no {}", fmt::join(missing, ", ")),
        "models cannot be imported, or walls not drawn by processes",
        "sudo apt-get install --reinstall stadion  # in a checkout: ./stadion --help, which builds");
  }

  /// The error of a library ends with "apt-get install PACKAGE" if it is missing.
  static std::string installOf(const std::string& why) {
    const std::size_t at = why.find("apt-get install");
    return at == std::string::npos ? "" : "sudo " + why.substr(at, why.find_first_of(");\n", at) - at);
  }
  static std::string withoutAdvice(const std::string& why) {
    return why.substr(0, std::min(why.find(": apt-get install"), why.find("; set DISPLAY")));
  }

  void drawing() {
    const std::string cpu = probes_.cpuRenderer();
    const auto gl = probes_.softwareGl();
    if (gl) return add("drawing", Health::Works, cpu + "; OpenGL: " + gl.value());
    add("drawing", Health::Limited, cpu + "; " + withoutAdvice(gl.error().message),
        "--gl osmesa, the reference that pictures can be compared with", installOf(gl.error().message));
  }

  static bool isSoftware(const std::string& renderer) {
    return renderer.find("llvmpipe") != std::string::npos || renderer.find("softpipe") != std::string::npos;
  }

  /// What a wall file may name with `card N`; empty if there is no choice.
  std::string cards() const {
    const std::vector<std::string> all = probes_.cards();
    std::string text;
    for (std::size_t i = 0; all.size() > 1 && i < all.size(); ++i)
      text += fmt::format("; card {}: {}", i, all[i]);
    return text;
  }

  void gpu() {
    constexpr const char* kLacks = "--renderer auto draws on the processors (cpu), --gl egl too, but slower";
    const auto gl = probes_.hardwareGl();
    if (gl && !isSoftware(gl.value())) return add("gpu", Health::Works, gl.value() + cards());
    const std::string found = gl ? gl.value() : withoutAdvice(gl.error().message);
    if (!gl) return add("gpu", Health::Missing, found, kLacks, installOf(gl.error().message));
    const std::string node = "/dev/dri/renderD128";
    if (probes_.exists(node) && !probes_.writable(node))
      return add("gpu", Health::Limited, found + "; " + node + " may not be opened", kLacks,
                 "sudo usermod -aG render,video $USER  # then log in again");
    const bool nvidia = probes_.exists("/proc/driver/nvidia") || probes_.exists("/dev/nvidiactl");
    if (nvidia)
      return add("gpu", Health::Limited, found + "; an NVIDIA driver is there, but not its EGL", kLacks,
                 "sudo apt-get install nvidia-egl-icd");
    add("gpu", Health::Limited, found + "; no graphics processor", kLacks);
  }

  /// The monitors of a screen as the window system lists them: "HDMI-1 (1920 x 1080)".
  static bool isListed(const std::vector<std::string>& monitors, const std::string& wanted) {
    std::size_t number = 0;
    const auto [end, wrong] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
    if (wrong == std::errc() && end == wanted.data() + wanted.size())
      return number >= 1 && number <= monitors.size();
    return std::ranges::any_of(
        monitors, [&](const std::string& m) { return m == wanted || m.starts_with(wanted + " ("); });
  }

  void displays() {
    bool complete = true;
    for (const WallFile* walls : needs_.walls)
      for (const WallEntry& wall : walls->walls)
        if (wall.output) complete &= output(*walls, wall);
    const auto monitors = probes_.monitors("");
    if (!monitors)
      return add("displays", Health::Missing, withoutAdvice(monitors.error().message),
                 "view and run --display show nothing", displayCommand(monitors.error().message));
    if (!complete) return;
    const std::string found = monitors.value().empty() ? "a window system without monitors"
                                                       : fmt::format("{}", fmt::join(monitors.value(), ", "));
    const auto pixels = probes_.windowPixels();
    if (pixels)
      return add("displays", Health::Works, fmt::format("{}; without OpenGL: {}", found, pixels.value()));
    add("displays", Health::Limited, fmt::format("{}; {}", found, withoutAdvice(pixels.error().message)),
        "windows need OpenGL, also where the processors draw the walls", installOf(pixels.error().message));
  }

  /// False, with a finding, if the wall's output is not there.
  bool output(const WallFile& walls, const WallEntry& wall) {
    const WallOutput& out = *wall.output;
    const auto monitors = probes_.monitors(out.place.screen);
    const std::string where = fmt::format("{}:{}: wall \"{}\"", walls.file, wall.line, wall.wall.name);
    if (!monitors) {
      if (out.place.screen.empty()) return true;  // reported once, for all walls
      add("displays", Health::Missing, fmt::format("{}: no screen \"{}\"", where, out.place.screen),
          withoutAdvice(monitors.error().message), displayCommand(monitors.error().message));
      return false;
    }
    if (out.place.monitor.empty() || isListed(monitors.value(), out.place.monitor)) return true;
    add("displays", Health::Missing, fmt::format("{}: no monitor \"{}\"", where, out.place.monitor),
        monitors.value().empty() ? "the screen has none"
                                 : fmt::format("there are {}", fmt::join(monitors.value(), ", ")),
        "xrandr --query  # lists the names; connect it, or name another one in the wall file");
    return false;
  }

  std::string displayCommand(const std::string& why) const {
    if (const std::string install = installOf(why); !install.empty()) return install;
    for (const int number : {0, 1}) {
      // A socket alone says little: a server that has crashed leaves it, and another user's refuses us.
      const std::string display = fmt::format(":{}", number);
      if (probes_.exists(fmt::format("/tmp/.X11-unix/X{}", number)) && probes_.monitors(display))
        return "export DISPLAY=" + display;
    }
    return "sudo apt-get install xserver-xorg xinit && startx  # without a screen: xvfb-run stadion ...";
  }

  void swapGroups() {
    const auto groups = probes_.swapGroups();
    constexpr const char* kOwn =
        "windows and hosts swap by the program's own barrier, without a common retrace";
    if (groups && groups->groups > 0)
      return add("swap-groups", Health::Works,
                 groups->text() + " (Stadion's code for it has met no hardware)");
    add("swap-groups", Health::Limited, groups ? groups->text() : "not known without a display", kOwn);
  }

  void quadBuffer() {
    const auto offered = probes_.quadBuffer();
    constexpr const char* kLayouts =
        "--display --stereo pair has no windows; the other layouts need no such buffers";
    if (offered.value_or(false))
      return add("quad-buffer", Health::Works,
                 "a back buffer for each eye (Stadion has met no frame-sequential display)");
    add("quad-buffer", Health::Limited,
        offered ? "the display driver has no back buffer for each eye" : "not known without a display",
        kLayouts);
  }

  void sound() {
    const auto device = probes_.sound();
    if (device) return add("sound", Health::Works, device.value());
    const std::string& why = device.error().message;
    std::string mend = installOf(why);
    if (mend.empty() && probes_.exists("/dev/snd") && !probes_.writable("/dev/snd/controlC0"))
      mend = "sudo usermod -aG audio $USER  # then log in again";
    else if (mend.empty())
      mend = "sudo apt-get install pipewire-pulse  # then log in again";
    add("sound", Health::Missing, withoutAdvice(why), "shows play without their sounds", std::move(mend));
  }

  void tool(const char* topic, const char* program, const char* lacks) {
    if (probes_.hasProgram(program)) return add(topic, Health::Works, program);
    add(topic, Health::Missing, fmt::format("no {} in PATH", program), lacks,
        fmt::format("sudo apt-get install {}", program));
  }
  void video() { tool("video", "ffmpeg", "run --video writes no video"); }
  void measuring() { tool("measuring", "valgrind", "regress --instructions cannot count"); }

  void realtime() {
    if (probes_.realtime()) return add("realtime", Health::Works, "threads may have real-time priority");
    add("realtime", Health::Limited, "no right to real-time priority",
        "on a busy machine, hosts of a cluster wait longer for each other",
        "echo \"$USER - rtprio 10\" | sudo tee /etc/security/limits.d/stadion.conf  # then log in again");
  }

  void network() {
    const std::vector<NetworkPort> ports = probes_.network();
    bool complete = true;
    for (const std::string& wanted : needs_.interfaces) complete &= port(ports, wanted);
    if (std::ranges::none_of(ports, [](const NetworkPort& p) { return p.loopback && p.up; }))
      return add("network", Health::Missing, "the loopback interface is down",
                 "clusters and trackers hear nothing", "sudo ip link set lo up");
    std::vector<std::string> usable;
    for (const NetworkPort& p : ports)
      if (p.up && p.multicast && !p.loopback && !p.address.empty())
        usable.push_back(fmt::format("{} ({})", p.name, p.address));
    if (!usable.empty() && complete)
      return add("network", Health::Works, fmt::format("{}", fmt::join(usable, ", ")));
    if (usable.empty())
      add("network", needs_.interfaces.empty() ? Health::Limited : Health::Missing,
          "only the loopback interface", "a cluster has all its hosts on this machine",
          "ip -brief address  # lists what could be set up");
  }

  /// False, with a finding, if the interface cannot be used.
  bool port(const std::vector<NetworkPort>& ports, const std::string& wanted) {
    const auto at = std::ranges::find_if(
        ports, [&](const NetworkPort& p) { return p.name == wanted || p.address == wanted; });
    const auto lacks = [&](const std::string& found, const std::string& mend) {
      add("network", Health::Missing, found, "this host cannot play in that cluster", mend);
      return false;
    };
    if (at == ports.end())
      return lacks(fmt::format("no interface \"{}\"", wanted),
                   "ip -brief address  # lists the names; correct the line `interface` of the cluster file");
    if (!at->up) return lacks(at->name + " is down", fmt::format("sudo ip link set {} up", at->name));
    if (at->address.empty())
      return lacks(at->name + " has no IPv4 address",
                   fmt::format("sudo ip address add ADDRESS/24 dev {}", at->name));
    if (at->multicast || at->loopback) return true;
    return lacks(at->name + " has no multicast", fmt::format("sudo ip link set {} multicast on", at->name));
  }

  void clock() {
    const std::string folder = kClock;
    const std::string current = probes_.file(folder + "current_clocksource");
    const std::string available = probes_.file(folder + "available_clocksource");
    if (current.empty()) return add("clock", Health::Limited, "the clock source is not known", "");
    if (current != "hpet" && current != "acpi_pm" && current != "jiffies" && current != "refined-jiffies")
      return add("clock", Health::Works, current);
    const bool hasTsc = (" " + available + " ").find(" tsc ") != std::string::npos;
    add("clock", Health::Limited, current,
        "each reading takes about a microsecond; measuring slows shows down",
        hasTsc ? fmt::format("echo tsc | sudo tee {}current_clocksource", folder) : "");
  }

  void measurements() {
    std::vector<std::string> missing;
    for (const char* name : {"stadion-measure", "stadion-bench"})
      if (probes_.helper(name).empty()) missing.emplace_back(name);
    if (missing.empty()) return add("measurements", Health::Works, "stadion-measure, stadion-bench");
    add("measurements", Health::Limited, fmt::format("no {}", fmt::join(missing, ", ")),
        missing.front() == "stadion-measure" ? "fit, profile, plan, regress, soak and calibrate cannot start"
                                             : "bench cannot start",
        missing.back() == "stadion-bench" ? "./stadion bench --help  # in a checkout, which builds"
                                          : "./stadion profile --help  # in a checkout, which builds");
  }

  void packages(const char* topic, std::span<const char* const> wanted, const char* lacks,
                const char* then = "") {
    const auto installed = probes_.packages();
    if (!installed)
      return add(topic, Health::Limited, "the installed packages are not known: there is no dpkg", lacks,
                 fmt::format("install what Debian calls {}{}", fmt::join(wanted, " "), then));
    std::vector<std::string> missing;
    for (const char* package : wanted)
      if (!installed->contains(package)) missing.emplace_back(package);
    if (missing.empty()) return add(topic, Health::Works, fmt::format("{}", fmt::join(wanted, ", ")));
    add(topic, Health::Limited, fmt::format("no {}", fmt::join(missing, ", ")), lacks,
        fmt::format("sudo apt-get install {}{}", fmt::join(missing, " "), then));
  }

  const DoctorProbes& probes_;
  const DoctorNeeds& needs_;
  std::vector<DoctorFinding> found_;
};

}  // namespace

std::string_view nameOf(Health health) {
  return health == Health::Works ? "works" : health == Health::Limited ? "limited" : "missing";
}

std::span<const std::string_view> doctorTopics() {
  return kTopics;
}

std::vector<DoctorFinding> examine(const DoctorProbes& probes, const DoctorNeeds& needs) {
  return Examination(probes, needs).findings();
}

bool canWork(std::span<const DoctorFinding> findings) {
  return std::ranges::none_of(findings,
                              [](const DoctorFinding& f) { return f.asked && f.health != Health::Works; });
}

}  // namespace stadion
