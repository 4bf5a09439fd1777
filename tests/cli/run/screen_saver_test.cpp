/// Displays in memory whose screen saver or DPMS is due after a second: both wait while a show is shown, and
/// no longer.

#include "engine/base/shared_library.h"
#include "tests/programs/becomes.h"
#include "tests/programs/desk.h"

#include <chrono>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <thread>

namespace stadion {
namespace {

/// A client of an X server that asks about its screen saver and DPMS, through the libraries that the program
/// uses.
class SaverClient {
public:
  /// Null if the libraries are not there.
  static std::unique_ptr<SaverClient> connect(const std::string& display) {
    const auto xlib = SharedLibrary::open("libX11.so.6", "libx11-6"),
               saver = SharedLibrary::open("libXss.so.1", "libxss1"),
               extensions = SharedLibrary::open("libXext.so.6", "libxext6");
    if (!xlib || !saver || !extensions) return nullptr;
    std::unique_ptr<SaverClient> c(new SaverClient(xlib.value(), saver.value(), extensions.value()));
    c->display_ = c->xlib_.find<void*(const char*)>("XOpenDisplay")(display.c_str());
    return c->display_ ? std::move(c) : nullptr;
  }
  ~SaverClient() {
    if (display_) xlib_.find<int(void*)>("XCloseDisplay")(display_);
  }

  void setTimeout(int seconds) {
    xlib_.find<int(void*, int, int, int, int)>("XSetScreenSaver")(display_, seconds, 0, 1, 1);
    xlib_.find<int(void*, int)>("XSync")(display_, 0);
  }
  int timeout() {
    int timeout = 0, interval = 0, blanking = 0, exposures = 0;
    xlib_.find<int(void*, int*, int*, int*, int*)>("XGetScreenSaver")(display_, &timeout, &interval,
                                                                      &blanking, &exposures);
    return timeout;
  }
  bool dark() {
    struct {
      unsigned long window;
      int state, kind;
      unsigned long tilOrSince, idle, mask;
    } info{};
    const unsigned long root = xlib_.find<unsigned long(void*)>("XDefaultRootWindow")(display_);
    saver_.find<int(void*, unsigned long, void*)>("XScreenSaverQueryInfo")(display_, root, &info);
    return info.state == 1;
  }

  bool hasDpms() { return extensions_.find<int(void*)>("DPMSCapable")(display_) != 0; }
  /// Of standby, suspend and off.
  void setDpmsTimeouts(unsigned short seconds) {
    extensions_.find<int(void*, unsigned short, unsigned short, unsigned short)>("DPMSSetTimeouts")(
        display_, seconds, seconds, seconds);
    xlib_.find<int(void*, int)>("XSync")(display_, 0);
  }
  std::vector<unsigned short> dpmsTimeouts() {
    std::vector<unsigned short> times(3);
    extensions_.find<int(void*, unsigned short*, unsigned short*, unsigned short*)>("DPMSGetTimeouts")(
        display_, &times[0], &times[1], &times[2]);
    return times;
  }
  bool dpmsIsOn() { return dpms().on != 0; }
  bool monitorIsLit() { return dpms().level == 0; }

private:
  struct Dpms {
    unsigned short level = 0;
    unsigned char on = 0;
  };

  SaverClient(const SharedLibrary& xlib, const SharedLibrary& saver, const SharedLibrary& extensions)
      : xlib_(xlib), saver_(saver), extensions_(extensions) {}
  Dpms dpms() {
    Dpms now;
    extensions_.find<int(void*, unsigned short*, unsigned char*)>("DPMSInfo")(display_, &now.level, &now.on);
    return now;
  }
  SharedLibrary xlib_, saver_, extensions_;
  void* display_ = nullptr;
};

/// A way to show something.
struct Kind {
  const char* name;
  std::string output;
  bool view = false;
};

/// One of them, on a display of its own.
struct Showing {
  std::unique_ptr<Display> display;
  std::unique_ptr<SaverClient> client;
  std::unique_ptr<RunningProgram> program;
};

TEST(ProgramScreenSaver, WaitsForEveryKindOfOutputAndGoesOnWhenItEndsOrIsKilled) {
  if (!Display::open())
    GTEST_SKIP() << "needs Xvfb, xdotool and import: apt-get install xvfb xdotool imagemagick";
  const TestFolder folder;
  const std::string show = folder.write("ball.evs", "object( file=football.3ds, position=\"0, 3, 1.5\" )\n");
  const Kind kinds[] = {{"rectangle", "rectangle 0 0 96 64"},
                        {"fullscreen", "monitor 1 fullscreen"},
                        {"framed", "monitor 1"},
                        {"screens", "screen {0}.1 rectangle 0 0 96 64"},
                        {"view", "", true}};
  std::vector<Showing> all;
  for (const Kind& kind : kinds) {
    Showing& s = all.emplace_back();
    s.display = Display::open({"320x240x24", "320x240x24"});
    ASSERT_TRUE(s.display);
    s.client = SaverClient::connect(s.display->name());
    if (!s.client) GTEST_SKIP() << "needs libX11 and libXss: apt-get install libx11-6 libxss1";
    s.client->setTimeout(1);
    const std::string walls =
        folder.write(fmt::format("{}.walls", kind.name),
                     "wall one  lower-left -1 2 0  lower-right 1 2 0  upper-left -1 2 2\n" +
                         (kind.output.empty()
                              ? ""
                              : "output one  " + fmt::format(fmt::runtime(kind.output), s.display->name())) +
                         "\n");
    std::vector<std::string> words{kind.view ? "view" : "run",
                                   show,
                                   "--asset-root",
                                   assetFolder(),
                                   "--walls",
                                   walls,
                                   "--no-sound",
                                   "--size",
                                   "96x64",
                                   "--look",
                                   "plain",
                                   "--rate",
                                   "10"};
    if (!kind.view) words.push_back("--display");
    s.program = std::make_unique<RunningProgram>(onDisplay(*s.display, words));
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_TRUE(kinds[i].view || all[i].program->says("the walls are shown")) << kinds[i].name;
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_FALSE(all[i].client->dark()) << kinds[i].name;
    EXPECT_EQ(all[i].client->timeout(), 1) << kinds[i].name << ": a killed program could not put it back";
    EXPECT_TRUE(all[i].program->runs()) << all[i].program->err();
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    i == 1 ? all[i].display->hands({"mousemove", "40", "30", "key", "Escape"}) : all[i].program->kill();
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_TRUE(becomes([&] { return all[i].client->dark(); })) << kinds[i].name;
    EXPECT_EQ(all[i].client->timeout(), 1) << kinds[i].name;
  }
}

TEST(ProgramScreenSaver, AMonitorIsLitWhileAShowIsShownAndGoesDarkWhenItEndsOrIsKilled) {
  const auto display = Display::openWithMonitor();
  if (!display)
    GTEST_SKIP()
        << "needs an X.Org server that may start: apt-get install xserver-xorg-core xserver-xorg-dev "
           "xserver-xorg-video-dummy xdotool";
  const auto client = SaverClient::connect(display->name());
  if (!client) GTEST_SKIP() << "needs libX11, libXext and libXss: apt-get install libx11-6 libxext6 libxss1";
  ASSERT_TRUE(client->hasDpms());
  client->setTimeout(0);  // so that DPMS alone can darken it
  client->setDpmsTimeouts(1);
  const TestFolder folder;
  const std::string show = folder.write("ball.evs", "object( file=football.3ds, position=\"0, 3, 1.5\" )\n");
  const std::string plane = "wall one  lower-left -1 2 0  lower-right 1 2 0  upper-left -1 2 2\n";
  const std::string window = folder.write("window.walls", plane + "output one  rectangle 0 0 96 64\n");
  const std::string whole = folder.write("whole.walls", plane + "output one  monitor 1 fullscreen\n");
  struct {
    const char* name;
    std::vector<std::string> words;
    bool killed;
  } const shows[] = {{"killed", {"run", show, "--walls", window, "--display"}, true},
                     {"ended by a key", {"run", show, "--walls", whole, "--display"}, false},
                     {"killed view", {"view", show, "--walls", window}, true}};
  for (const auto& shown : shows) {
    SCOPED_TRACE(shown.name);
    ASSERT_TRUE(becomes([&] { return !client->monitorIsLit(); })) << "DPMS is due after a second";
    std::vector<std::string> words = shown.words;
    words.insert(words.end(), {"--asset-root", assetFolder(), "--no-sound", "--size", "96x64", "--look",
                               "plain", "--rate", "10"});
    RunningProgram program(onDisplay(*display, words));
    ASSERT_TRUE(program.waitUntil([&] { return client->monitorIsLit(); }));
    ASSERT_TRUE(shown.killed || program.says("the walls are shown"));
    std::this_thread::sleep_for(std::chrono::milliseconds(2500));
    EXPECT_TRUE(client->monitorIsLit());
    EXPECT_TRUE(program.runs()) << program.err();
    if (shown.killed)
      program.kill();
    else
      display->hands({"mousemove", "40", "30", "key", "Escape"});
    EXPECT_TRUE(becomes([&] { return !client->monitorIsLit(); }));
    EXPECT_EQ(client->dpmsTimeouts(), (std::vector<unsigned short>{1, 1, 1}));
    EXPECT_TRUE(client->dpmsIsOn());
    EXPECT_EQ(client->timeout(), 0);
  }
}

}  // namespace
}  // namespace stadion
