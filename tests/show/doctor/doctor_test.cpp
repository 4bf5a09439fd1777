/// The doctor on machines that lack something.

#include "show/doctor/doctor.h"

#include "engine/display/wall_file.h"
#include "show/doctor/doctor_needs.h"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

namespace stadion {
namespace {

/// The packages that the launcher installs: its lines testing="...", and so on.
std::optional<std::set<std::string>> packagesOf(const std::vector<std::string>& lists) {
  std::ifstream launcher(STADION_SOURCE_DIR "/stadion");
  std::set<std::string> packages;
  for (std::string line; std::getline(launcher, line);)
    for (const std::string& list : lists)
      if (line.starts_with(list + "=\"")) {
        std::istringstream names(line.substr(list.size() + 2, line.size() - list.size() - 3));
        for (std::string name; names >> name;) packages.insert(name);
      }
  return packages;
}

/// A machine on which everything works.
DoctorProbes wellMachine() {
  DoctorProbes p;
  p.hasProgram = [](const std::string&) { return true; };
  p.helper = [](const std::string& name) { return "/usr/lib/stadion/" + name; };
  p.cpuRenderer = [] { return std::string("CPU renderer (AVX2), 2 threads"); };
  p.softwareGl = [] { return Result<std::string>(std::string("llvmpipe")); };
  p.hardwareGl = [] { return Result<std::string>(std::string("NVIDIA H100, OpenGL 4.6")); };
  p.cards = [] { return std::vector<std::string>{"NVIDIA H100 /dev/dri/card0", "in software"}; };
  p.sound = [] { return Result<std::string>(std::string("HDA Intel")); };
  p.monitors = [](const std::string&) {
    return Result<std::vector<std::string>>(
        std::vector<std::string>{"HDMI-1 (1920 x 1080)", "DP-1 (800 x 600)"});
  };
  p.windowPixels = [] { return Result<std::string>(std::string("shared memory")); };
  p.swapGroups = [] { return std::optional(SwapGroupOffer{true, 1, 1}); };
  p.quadBuffer = [] { return std::optional(true); };
  p.packages = [] { return packagesOf({"testing", "fuzzing", "peers"}); };
  p.isRoot = [] { return false; };
  p.realtime = [] { return true; };
  p.network = [] {
    return std::vector<NetworkPort>{{"lo", "127.0.0.1", true, false, true},
                                    {"eth0", "10.0.0.2", true, true, false}};
  };
  p.file = [](const std::string&) { return std::string("tsc"); };
  p.exists = p.writable = [](const std::string&) { return false; };
  return p;
}

const DoctorFinding& of(const std::vector<DoctorFinding>& all, const std::string& topic) {
  const auto at = std::ranges::find(all, topic, &DoctorFinding::topic);
  EXPECT_NE(at, all.end()) << topic;
  return *at;
}

std::string messageOf(const std::vector<std::string>& words) {
  Diagnostics findings;
  EXPECT_FALSE(MachineNeeds::read(words, findings));
  return findings.all().empty() ? "" : findings.all()[0].message;
}

TEST(Doctor, HasAFindingForEachTopicOfAMachineThatIsWell) {
  const auto all = examine(wellMachine(), {});
  ASSERT_EQ(all.size(), doctorTopics().size());
  for (const DoctorFinding& f : all) {
    EXPECT_EQ(f.health, Health::Works) << f.topic;
    EXPECT_TRUE(f.mend.empty() && f.lacks.empty()) << f.topic;
  }
  EXPECT_TRUE(canWork(all));
}

TEST(Doctor, NamesTheCommandThatMends) {
  DoctorProbes sick = wellMachine();
  sick.hasProgram = [](const std::string&) { return false; };
  sick.helper = [](const std::string&) { return std::string(); };
  sick.softwareGl = [] {
    return Result<std::string>::failure("libOSMesa.so.8 is missing: apt-get install libosmesa6");
  };
  sick.hardwareGl = [] { return Result<std::string>(std::string("llvmpipe (LLVM 15)")); };
  sick.sound = [] {
    return Result<std::string>::failure("libopenal.so.1 is missing: apt-get install libopenal1");
  };
  sick.monitors = [](const std::string& screen) {
    using Monitors = Result<std::vector<std::string>>;
    return screen == ":0"
               ? Monitors(std::vector<std::string>{"DP-1 (800 x 600)"})
               : Monitors::failure("there is no display (X11: none); set DISPLAY, such as DISPLAY=:0");
  };
  sick.swapGroups = [] { return std::optional<SwapGroupOffer>(); };
  sick.quadBuffer = [] { return std::optional<bool>(); };
  sick.realtime = [] { return false; };
  sick.network = [] { return std::vector<NetworkPort>{{"lo", "127.0.0.1", true, false, true}}; };
  sick.file = [](const std::string& path) {
    return std::string(path.ends_with("available_clocksource") ? "tsc hpet acpi_pm" : "hpet");
  };
  sick.exists = [](const std::string& path) {
    return path == "/dev/dri/renderD128" || path == "/tmp/.X11-unix/X0";
  };
  const auto all = examine(sick, {});
  const std::pair<const char*, const char*> mends[] = {
      {"programs", "sudo apt-get install --reinstall stadion"},
      {"drawing", "sudo apt-get install libosmesa6"},
      {"gpu", "sudo usermod -aG render,video $USER"},
      {"displays", "export DISPLAY=:0"},
      {"sound", "sudo apt-get install libopenal1"},
      {"video", "sudo apt-get install ffmpeg"},
      {"measuring", "sudo apt-get install valgrind"},
      {"realtime", "sudo tee /etc/security/limits.d/stadion.conf"},
      {"network", "ip -brief address"},
      {"clock", "echo tsc | sudo tee /sys/devices/system/clocksource/clocksource0/current_clocksource"}};
  for (const auto& [topic, mend] : mends) {
    const DoctorFinding& f = of(all, topic);
    EXPECT_NE(f.health, Health::Works) << topic;
    EXPECT_FALSE(f.lacks.empty()) << topic;
    EXPECT_NE(f.mend.find(mend), std::string::npos) << topic << ": " << f.mend;
  }
  EXPECT_TRUE(canWork(all)) << "nothing was asked for";
  const auto asked = examine(sick, {{"sound"}, {}});
  EXPECT_FALSE(canWork(asked));
  EXPECT_NE(toText(asked).find("asked for, and cannot work: sound (libopenal.so.1 is missing)"),
            std::string::npos)
      << toText(asked);
  EXPECT_TRUE(canWork(examine(wellMachine(), {{"sound"}, {}})));
}

TEST(Doctor, NamesNoSudoToRoot) {
  DoctorProbes sick = wellMachine();
  sick.hasProgram = [](const std::string&) { return false; };
  sick.realtime = [] { return false; };
  EXPECT_EQ(of(examine(sick, {}), "video").mend, "sudo apt-get install ffmpeg");
  sick.isRoot = [] { return true; };
  const auto all = examine(sick, {});
  EXPECT_EQ(of(all, "video").mend, "apt-get install ffmpeg");
  EXPECT_EQ(of(all, "realtime").mend,
            "echo \"$USER - rtprio 10\" | tee /etc/security/limits.d/stadion.conf  # then log in again");
}

TEST(Doctor, SaysHowWindowsWithoutOpenGlGetTheirPictures) {
  DoctorProbes p = wellMachine();
  EXPECT_NE(of(examine(p, {}), "displays").found.find("; without OpenGL: shared memory"), std::string::npos);
  p.windowPixels = [] { return Result<std::string>::failure("8 bits a pixel"); };
  const auto all = examine(p, {});
  const DoctorFinding& f = of(all, "displays");
  EXPECT_EQ(f.health, Health::Limited);
  EXPECT_NE(f.found.find("8 bits a pixel"), std::string::npos);
  EXPECT_FALSE(f.lacks.empty());
}

TEST(Doctor, NamesADisplayOnlyIfItsServerAnswers) {
  DoctorProbes sick = wellMachine();
  sick.monitors = [](const std::string&) {
    return Result<std::vector<std::string>>::failure(
        "there is no display (X11: none); set DISPLAY, such as :0");
  };
  sick.exists = [](const std::string& path) { return path == "/tmp/.X11-unix/X0"; };
  const auto all = examine(sick, {});
  const DoctorFinding& f = of(all, "displays");
  EXPECT_EQ(f.found, "there is no display (X11: none)");
  EXPECT_EQ(f.mend.find("DISPLAY"), std::string::npos) << f.mend;
  EXPECT_NE(f.mend.find("apt-get install xserver-xorg"), std::string::npos) << f.mend;
}

TEST(Doctor, LooksForTheMonitorsOfAWallFile) {
  Diagnostics wrong;
  const auto walls = parseWalls("wall a lower-left -1 1 0 lower-right 1 1 0 upper-left -1 1 2\n"
                                "wall b lower-left -1 -1 0 lower-right -1 1 0 upper-left -1 -1 2\n"
                                "output a monitor HDMI-1 fullscreen\noutput b monitor DP-3 fullscreen\n",
                                "hall.walls", wrong);
  ASSERT_TRUE(walls);
  DoctorNeeds needs;
  needs.topics = {"displays"}, needs.walls = {&*walls};
  const auto all = examine(wellMachine(), needs);
  const DoctorFinding& f = of(all, "displays");
  EXPECT_EQ(f.found, "hall.walls:2: wall \"b\": no monitor \"DP-3\"");
  EXPECT_EQ(f.lacks, "there are HDMI-1 (1920 x 1080), DP-1 (800 x 600)");
  EXPECT_FALSE(canWork(all));
}

TEST(Doctor, LooksForTheInterfaceOfACluster) {
  const auto networkOf = [](const char* name, NetworkPort port) {
    DoctorProbes p = wellMachine();
    p.network = [port] { return std::vector<NetworkPort>{{"lo", "127.0.0.1", true, false, true}, port}; };
    DoctorNeeds needs;
    needs.topics = {"network"}, needs.interfaces = {name};
    const auto all = examine(p, needs);
    return canWork(all) ? std::string("works") : of(all, "network").mend;
  };
  EXPECT_EQ(networkOf("eth0", {"eth0", "10.0.0.2", true, true, false}), "works");
  EXPECT_EQ(networkOf("10.0.0.2", {"eth0", "10.0.0.2", true, true, false}), "works");
  EXPECT_EQ(networkOf("eth0", {"eth0", "10.0.0.2", false, true, false}), "sudo ip link set eth0 up");
  EXPECT_EQ(networkOf("eth0", {"eth0", "", true, true, false}), "sudo ip address add ADDRESS/24 dev eth0");
  EXPECT_EQ(networkOf("eth0", {"eth0", "10.0.0.2", true, false, false}),
            "sudo ip link set eth0 multicast on");
  EXPECT_NE(networkOf("eth7", {"eth0", "10.0.0.2", true, true, false}).find("ip -brief address"),
            std::string::npos);
}

TEST(Doctor, KnowsWhatAShowNeeds) {
  Diagnostics findings;
  const std::string scripts = STADION_SOURCE_DIR "/scripts/";
  const auto kick = MachineNeeds::read({scripts + "kick.evs"}, findings);
  const auto olympia = MachineNeeds::read({scripts + "olympia.evs"}, findings);
  ASSERT_TRUE(kick && olympia);
  const auto hasSound = [](const MachineNeeds& wanted) {
    const auto topics = wanted.needs().topics;
    return std::ranges::find(topics, "sound") != topics.end();
  };
  EXPECT_FALSE(hasSound(*kick));
  EXPECT_TRUE(hasSound(*olympia));
  EXPECT_NE(messageOf({"sond"}).find("did you mean \"sound\"?"), std::string::npos) << messageOf({"sond"});
  EXPECT_NE(messageOf({"not-there.walls"}), "");
}

TEST(Doctor, NamesThePackagesThatTheLauncherInstalls) {
  DoctorProbes p = wellMachine();
  p.packages = [] { return std::optional(std::set<std::string>()); };
  const auto all = examine(p, {});
  for (const auto& [topic, list] :
       {std::pair{"tests", "testing"}, {"peers", "peers"}, {"fuzzing", "fuzzing"}}) {
    const DoctorFinding& f = of(all, topic);
    EXPECT_EQ(f.health, Health::Limited);
    EXPECT_TRUE(f.mend.starts_with("sudo apt-get install ")) << f.mend;
    const auto packages = packagesOf({list});
    ASSERT_TRUE(packages);
    for (const std::string& package : *packages)
      EXPECT_NE((f.mend + " ").find(" " + package), std::string::npos) << topic << ": " << package;
  }
  p.packages = [] { return std::optional<std::set<std::string>>(); };
  const auto unknown = examine(p, {});
  EXPECT_NE(of(unknown, "tests").found.find("no dpkg"), std::string::npos);
}

TEST(Doctor, SaysHowTheProgramsThatMeasureAreBuilt) {
  DoctorProbes p = wellMachine();
  p.helper = [](const std::string& name) { return name == "stadion-bench" ? std::string() : "/lib/" + name; };
  const auto all = examine(p, {{"measurements"}, {}});
  EXPECT_EQ(of(all, "measurements").found, "no stadion-bench");
  EXPECT_EQ(of(all, "measurements").mend, "./stadion bench --help  # in a checkout, which builds");
  EXPECT_FALSE(canWork(all));
}

TEST(Doctor, TakesTheNameOfARoom) {
  Diagnostics findings;
  const auto room = MachineNeeds::read({"cave4"}, findings);
  ASSERT_TRUE(room);
  EXPECT_EQ(room->needs().walls.size(), 1U);
}

TEST(Doctor, ReportsJson) {
  const auto j = nlohmann::json::parse(toJson(examine(wellMachine(), {{"gpu"}, {}})));
  EXPECT_EQ(j["can_work"], true);
  EXPECT_EQ(j["findings"].size(), doctorTopics().size());
  EXPECT_EQ(j["findings"][2]["topic"], "gpu");
  EXPECT_EQ(j["findings"][2]["found"],
            "NVIDIA H100, OpenGL 4.6; card 0: NVIDIA H100 /dev/dri/card0; card 1: in software");
  EXPECT_EQ(j["findings"][2]["asked"], true);
}

}  // namespace
}  // namespace stadion
