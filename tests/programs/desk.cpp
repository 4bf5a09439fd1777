#include "tests/programs/desk.h"

#include <arpa/inet.h>
#include <csignal>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kGoodTime{300};  // a machine may be busy

/// For Xorg: a screen in memory without devices for hands, which xdotool does not need.
constexpr const char* kMemoryServer = R"(
Section "ServerFlags"
  Option "AutoAddDevices" "false"
  Option "AllowMouseOpenFail" "true"
  Option "DontVTSwitch" "true"
EndSection
Section "Module"
  Load "monitor"
EndSection
Section "Device"
  Identifier "memory"
  Driver "dummy"
  VideoRam 8192
EndSection
Section "Monitor"
  Identifier "monitor"
  HorizSync 5-1000
  VertRefresh 5-200
EndSection
Section "Screen"
  Identifier "screen"
  Device "memory"
  Monitor "monitor"
  DefaultDepth 24
  SubSection "Display"
    Depth 24
    Modes "640x480"
  EndSubSection
EndSection
)";

/// Until it is true; false if that takes too long.
template <class Condition>
bool until(const Condition& condition) {
  const auto end = Clock::now() + kGoodTime;
  while (!condition()) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}

bool hasProgram(const std::string& name) {
  return runProgram({{"sh", "-c", "command -v " + name}}).status == 0;
}

int occurrences(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace

RunningProgram::RunningProgram(const ProgramRun& run)
    : child_(startProgram(run, folder_.path() / "out", folder_.path() / "err")) {}

RunningProgram::~RunningProgram() {
  kill();
}

void RunningProgram::kill() {
  if (!runs()) return;
  ::kill(-child_, SIGKILL), ::waitpid(child_, nullptr, 0);
  ended_ = true;
  status_ = 128 + SIGKILL;
}

std::string RunningProgram::out() const {
  return fileContent(folder_.path() / "out");
}

std::string RunningProgram::err() const {
  return fileContent(folder_.path() / "err");
}

bool RunningProgram::runs() const {
  int status = 0;
  if (!ended_ && ::waitpid(child_, &status, WNOHANG) == child_) {
    ended_ = true;
    status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  return !ended_;
}

bool RunningProgram::says(const std::string& text, int times) const {
  const auto isThere = [&] { return occurrences(err(), text) >= times; };
  const bool said = until([&] { return isThere() || !runs(); }) && isThere();
  EXPECT_TRUE(said) << "\"" << text << "\" is missing in:\n" << err();
  return said;
}

bool RunningProgram::waitUntil(const std::function<bool()>& condition) const {
  const bool came = until([&] { return condition() || !runs(); }) && condition();
  EXPECT_TRUE(came) << err();
  return came;
}

int RunningProgram::status() {
  const bool over = until([&] { return !runs(); });
  EXPECT_TRUE(over) << err();
  return status_;
}

std::unique_ptr<Display> Display::open(std::vector<std::string> screens, std::vector<std::string> more) {
  if (!hasProgram("Xvfb") || !hasProgram("xdotool") || !hasProgram("import")) return nullptr;
  ProgramRun run{{"Xvfb", "-displayfd", "1", "-nolisten", "tcp", "-noreset"}};
  for (std::size_t i = 0; i < screens.size(); ++i) {
    run.words.insert(run.words.end(), {"-screen", std::to_string(i), screens[i]});
  }
  run.words.insert(run.words.end(), more.begin(), more.end());
  return start(run);
}

std::unique_ptr<Display> Display::openWithMonitor() {
  const std::string server = "/usr/lib/xorg/Xorg", modules = "/usr/lib/xorg/modules";
  const std::string ours = STADION_BINARY_DIR "/tests/xorg";
  for (const std::string& file : {server, modules + "/drivers/dummy_drv.so", ours + "/libmonitor.so"})
    if (!std::filesystem::exists(file)) return nullptr;
  if (!hasProgram("xdotool")) return nullptr;
  auto folder = std::make_unique<TestFolder>();
  const std::string configuration = folder->write("xorg.conf", kMemoryServer);
  auto display = start(
      {{server, "-displayfd", "1", "-nolisten", "tcp", "-noreset", "-novtswitch", "-sharevts", "-config",
        configuration, "-logfile", folder->path() / "log", "-modulepath", ours + "," + modules}});
  if (display) display->folder_ = std::move(folder);
  return display;
}

/// It looks for a free number by itself and says which.
std::unique_ptr<Display> Display::start(const ProgramRun& server) {
  std::unique_ptr<Display> display(new Display);
  display->server_ = std::make_unique<RunningProgram>(server);
  const auto numbered = [&] { return display->server_->out().find('\n') != std::string::npos; };
  if (!until([&] { return numbered() || !display->server_->runs(); }) || !numbered()) return nullptr;
  const std::string number = display->server_->out();
  display->name_ = ":" + number.substr(0, number.find('\n'));
  return display;
}

void Display::hands(std::vector<std::string> words) const {
  words.insert(words.begin(), "xdotool");
  ProgramRun run{words};
  run.environment = {"DISPLAY=" + name_};
  const ProgramResult result = runProgram(run);
  EXPECT_EQ(result.status, 0) << result.err;
}

bool Display::photograph(const std::string& file, int screen) const {
  ProgramRun run{{"import", "-window", "root", "-depth", "8", file}};
  run.environment = {"DISPLAY=" + name_ + "." + std::to_string(screen)};
  return runProgram(run).status == 0;
}

std::uint16_t freePort() {
  // Below the ports that the kernel gives to programs that ask for any.
  constexpr int kFirst = 20'000, kCount = 10'000;
  static int next = ::getpid() * 7;
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("stadion-test-ports-" + std::to_string(::getuid()));
  std::filesystem::create_directories(folder);
  for (int tries = 0; tries < kCount; ++tries) {
    const int port = kFirst + (next = (next + 1) % kCount);
    const std::string name = folder / std::to_string(port);
    const int lock = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock < 0 || ::flock(lock, LOCK_EX | LOCK_NB) != 0) {  // another test's
      ::close(lock);
      continue;
    }
    const int s = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_in a{};
    a.sin_family = AF_INET, a.sin_port = htons(static_cast<std::uint16_t>(port));
    const bool free = ::bind(s, reinterpret_cast<const sockaddr*>(&a), sizeof a) == 0;
    ::close(s);
    if (free) return static_cast<std::uint16_t>(port);  // the lock goes with this process
    ::close(lock);
  }
  return 0;
}

ProgramRun onDisplay(const Display& display, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), stadionPath());
  ProgramRun run{arguments};
  run.environment = {"DISPLAY=" + display.name()};
  return run;
}

}  // namespace stadion
