/// A display in memory whose screen saver is due after a second: it waits while a show is shown, and no
/// longer.

#include "pipeline/platform/shared_library.h"
#include "tests/programs/becomes.h"
#include "tests/programs/desk.h"

#include <chrono>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <thread>

namespace stadion {
namespace {

/// A client of an X server that asks about its screen saver, through the libraries that the program uses.
class SaverClient {
public:
  /// Null if the libraries are not there.
  static std::unique_ptr<SaverClient> connect(const std::string& display) {
    const auto xlib = SharedLibrary::open("libX11.so.6", "libx11-6"),
               saver = SharedLibrary::open("libXss.so.1", "libxss1");
    if (!xlib || !saver) return nullptr;
    std::unique_ptr<SaverClient> c(new SaverClient(xlib.value(), saver.value()));
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

private:
  SaverClient(const SharedLibrary& xlib, const SharedLibrary& saver) : xlib_(xlib), saver_(saver) {}
  SharedLibrary xlib_, saver_;
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
  const TemporaryFolder folder;
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

}  // namespace
}  // namespace stadion
