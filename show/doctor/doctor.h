#pragma once
/// What this machine lacks for shows, and the commands that mend it.
///
/// Each topic is examined by a probe, which tests replace.
///
/// Threads  main: windows and OpenGL contexts are opened and closed again.
/// Errors   are findings.

#include "engine/base/diagnostic.h"
#include "pipeline/target/swap_group.h"

#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

struct WallFile;

enum class Health {
  Works,
  Limited,  ///< shows play, but slower or without something
  Missing
};
std::string_view nameOf(Health health);

struct DoctorFinding {
  std::string topic;  ///< topic, one of doctorTopics()
  Health health = Health::Works;
  std::string found;  ///< the state that was found
  std::string lacks;  ///< what cannot work without it; empty: nothing is lacking
  std::string mend;   ///< a command, with a comment; empty: none is needed, or none helps
  bool asked = false;
};

/// "programs", "drawing", "gpu" and so on, in the order of findings.
std::span<const std::string_view> doctorTopics();

struct NetworkPort {
  std::string name;
  std::string address;  ///< empty: none
  bool up = false, multicast = false, loopback = false;
};

/// How the machine is examined. A Result's error says why something is missing.
struct DoctorProbes {
  std::function<bool(const std::string&)> hasProgram;     ///< along PATH
  std::function<std::string(const std::string&)> helper;  ///< path of a program of Stadion; empty: none
  std::function<std::string()> cpuRenderer;               ///< kernels and threads of the CPU renderer
  std::function<Result<std::string>()> softwareGl,
      hardwareGl;                                   ///< description that OSMesa or EGL gives of itself
  std::function<std::vector<std::string>()> cards;  ///< what EGL can draw on, by number
  std::function<Result<std::string>()> sound;       ///< the device's name
  std::function<Result<std::vector<std::string>>(const std::string& screen)>
      monitors;                                               ///< names of the monitors of an X screen
  std::function<Result<std::string>()> windowPixels;          ///< way of pictures into windows without OpenGL
  std::function<std::optional<SwapGroupOffer>()> swapGroups;  ///< nothing: not known without a display
  std::function<std::optional<bool>()> quadBuffer;  ///< a back buffer for each eye; nothing: likewise
  /// Names of the installed Debian packages; nothing: not known on this machine.
  std::function<std::optional<std::set<std::string>>()> packages;
  std::function<bool()> isRoot;    ///< whether commands need no sudo
  std::function<bool()> realtime;  ///< whether a thread may become a real-time thread
  std::function<std::vector<NetworkPort>()> network;
  std::function<std::string(const std::string&)> file;  ///< first line of a file; empty: it cannot be read
  std::function<bool(const std::string&)> exists, writable;
};
/// They hold a connection to the X server: a server without clients resets, and may refuse the next one.
DoctorProbes probesOfThisMachine();

/// Says that `ulimit -v` leaves a show too little address space. Probing drivers could then crash the
/// process.
std::optional<Diagnostic> lackOfAddressSpace();

/// The requirements of a show.
struct DoctorNeeds {
  std::vector<std::string> topics;        ///< asked for; empty: nothing in particular
  std::vector<const WallFile*> walls;     ///< wall files whose outputs must be there
  std::vector<std::string> interfaces{};  ///< names or addresses of network interfaces that must be there
};

/// Returns at least one finding for each topic.
std::vector<DoctorFinding> examine(const DoctorProbes& probes, const DoctorNeeds& needs);
/// False if something that was asked for does not work.
bool canWork(std::span<const DoctorFinding> findings);

/// A table, with a line below each finding that something mends.
std::string toText(std::span<const DoctorFinding> findings);
/// Returns a line with a JSON object.
std::string toJson(std::span<const DoctorFinding> findings);

}  // namespace stadion
