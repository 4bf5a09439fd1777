/// What a machine in a hall has: services, an X server for shows, an archive that installs without internet.

#include "engine/base/shared_library.h"
#include "tests/programs/desk.h"
#include "tests/programs/notify_socket.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace stadion {
namespace {

namespace fs = std::filesystem;

const std::string kHallFolder = STADION_SOURCE_DIR "/packaging/hall/";

bool hasInPath(const std::string& program) {
  return runProgram({{"sh", "-c", "command -v " + program}}).status == 0;
}

/// One monitor in memory.
constexpr const char* kMemoryMonitor = R"(
Section "ServerFlags"
  Option "AutoAddDevices" "false"
  Option "AllowMouseOpenFail" "true"
  Option "DontVTSwitch" "true"
EndSection
Section "Device"
  Identifier "card"
  Driver "dummy"
  VideoRam 16000
EndSection
Section "Screen"
  Identifier "screen"
  Device "card"
  DefaultDepth 24
  SubSection "Display"
    Depth 24
    Virtual 640 480
  EndSubSection
EndSection
)";

/// A client that asks the X server about its screen saver and DPMS.
struct XQuestions {
  XQuestions()
      : xlib(SharedLibrary::open("libX11.so.6", "libx11-6")),
        extensions(SharedLibrary::open("libXext.so.6", "libxext6")) {}
  ~XQuestions() {
    if (display) xlib.value().find<int(void*)>("XCloseDisplay")(display);
  }
  bool connect(const std::string& name) {
    display = xlib.value().find<void*(const char*)>("XOpenDisplay")(name.c_str());
    return display != nullptr;
  }
  int timeout() {
    int seconds = -1, interval = 0, blanking = 0, exposures = 0;
    xlib.value().find<int(void*, int*, int*, int*, int*)>("XGetScreenSaver")(display, &seconds, &interval,
                                                                             &blanking, &exposures);
    return seconds;
  }
  bool dpmsIsOn() {
    if (extensions.value().find<int(void*)>("DPMSCapable")(display) == 0) return false;
    unsigned short level = 0;
    unsigned char on = 1;
    extensions.value().find<int(void*, unsigned short*, unsigned char*)>("DPMSInfo")(display, &level, &on);
    return on != 0;
  }
  Result<SharedLibrary> xlib, extensions;
  void* display = nullptr;
};

TEST(ProgramHallMachine, TheXServerForShowsIsReadyStaysLitAndTakesClientsWithItsKeyAlone) {
  const std::string server = "/usr/lib/xorg/Xorg";
  for (const char* program : {"xauth", "mcookie"})
    if (!hasInPath(program)) GTEST_SKIP() << "needs xauth and util-linux";
  if (!fs::exists(server) || !fs::exists("/usr/lib/xorg/modules/drivers/dummy_drv.so"))
    GTEST_SKIP() << "needs an X.Org server: apt-get install xserver-xorg-core xserver-xorg-video-dummy";
  XQuestions questions;  // the libraries
  if (!questions.xlib || !questions.extensions) GTEST_SKIP() << "needs libX11 and libXext";
  const TestFolder folder;
  const std::string configuration = folder.write("xorg.conf", kMemoryMonitor);
  const NotifySocket manager(fmt::format("@stadion-display-test-{}", getpid()));
  const std::string number = fmt::format(":{}", 1000 + getpid() % 20'000);
  ProgramRun run{{kHallFolder + "stadion-display", "-config", configuration, "-logfile",
                  folder.path() / "log", "-novtswitch", "-sharevts"}};
  run.environment = {"RUNTIME_DIRECTORY=" + folder.path().string(), "STADION_SERVER=" + server,
                     "STADION_DISPLAY=" + number, "STADION_TERMINAL=", "NOTIFY_SOCKET=" + manager.address()};
  const RunningProgram display(run);
  std::string told;
  if (!display.waitUntil([&] {
        for (const std::string& text : manager.all()) told += text;
        return has(told, "READY=1");
      }))
    GTEST_SKIP() << "this X server may not start here: " << display.err();
  const std::string key = folder.path() / "Xauthority";
  struct stat about {};
  ASSERT_EQ(stat(key.c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 0777, 0640U);
  setenv("XAUTHORITY", (folder.path() / "no-key").c_str(), 1);
  EXPECT_FALSE(questions.connect(number)) << "without the key";
  setenv("XAUTHORITY", key.c_str(), 1);
  XQuestions client;  // ends before the server does
  ASSERT_TRUE(client.connect(number));
  EXPECT_EQ(client.timeout(), 0);
  EXPECT_FALSE(client.dpmsIsOn());
}

TEST(ProgramHallMachine, TheXServersProgramThatIsMissingIsNamed) {
  const TestFolder folder;
  ProgramRun run{{kHallFolder + "stadion-display"}};
  run.environment = {"RUNTIME_DIRECTORY=" + folder.path().string(), "STADION_SERVER=no-such-server"};
  const ProgramResult r = runProgram(run);
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "no no-such-server: apt-get install xserver-xorg-core")) << r.err;
}

TEST(ProgramHallMachine, ADamagedArchiveInstallsNothing) {
  const TestFolder folder;
  fs::create_directory(folder.path() / "packages");
  fs::copy_file(kHallFolder + "install-offline", folder.path() / "install");
  folder.write("packages/a.deb", "a package");
  folder.write("wanted", "stadion");
  const std::string sums = "cd \"$0\" && sha256sum packages/a.deb wanted install >SHA256SUMS";
  ASSERT_EQ(runProgram({{"sh", "-c", sums, folder.path()}}).status, 0);
  const ProgramRun check{{folder.path() / "install", "--check"}};
  const ProgramResult well = runProgram(check);
  EXPECT_EQ(well.status, 0) << well.err;
  folder.write("packages/a.deb", "a damaged package");
  for (const ProgramRun& run : {check, ProgramRun{{folder.path() / "install"}}}) {
    const ProgramResult r = runProgram(run);
    EXPECT_EQ(r.status, 2);
    EXPECT_TRUE(has(r.err, "packages/a.deb") && has(r.err, "Nothing was installed")) << r.err;
  }
}

TEST(ProgramHallMachine, UnknownOptionsOfThePackageScriptAreErrors) {
  const std::string script = STADION_SOURCE_DIR "/packaging/package.sh";
  const ProgramResult r = runProgram({{script, STADION_BINARY_DIR, "--ofline"}});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "unknown option --ofline")) << r.err;
  EXPECT_TRUE(has(runProgram({{script, STADION_BINARY_DIR, "--help"}}).out, "Usage: ./stadion package"));
}

}  // namespace
}  // namespace stadion
