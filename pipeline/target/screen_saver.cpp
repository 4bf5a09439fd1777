#include "pipeline/target/screen_saver.h"

#include "engine/base/shared_library.h"
#include "pipeline/target/x_connection.h"

namespace stadion {
namespace {

// Xlib's own types, as its ABI defines them: its headers need not be installed.
struct XlibDisplay;
constexpr unsigned short kDpmsModeOn = 0;

constexpr std::chrono::seconds kResetSuspended{15};  ///< programs wait for a minute at least
constexpr std::chrono::seconds kResetAlone{1};       ///< the shortest time-out that a server has

}  // namespace

struct ScreenSaverPause::X {
  explicit X(XlibDisplay* d) : display(d) {}

  XlibDisplay* display;
  int (*flush)(XlibDisplay*) = nullptr;
  int (*resetSaver)(XlibDisplay*) = nullptr;
  int (*setTimeouts)(XlibDisplay*, int, int, int, int) = nullptr;
  void (*suspend)(XlibDisplay*, int) = nullptr;                ///< null: the server or the library has no
                                                               ///< such function
  int timeout = 0, interval = 0, blanking = 0, exposures = 0;  ///< the user's

  bool findXlib() {
    const auto xlib = SharedLibrary::open("libX11.so.6", "libx11-6");  // the copy that GLFW has loaded
    if (!xlib) return false;
    flush = xlib.value().find<int(XlibDisplay*)>("XFlush");
    resetSaver = xlib.value().find<int(XlibDisplay*)>("XResetScreenSaver");
    setTimeouts = xlib.value().find<int(XlibDisplay*, int, int, int, int)>("XSetScreenSaver");
    const auto timeouts = xlib.value().find<int(XlibDisplay*, int*, int*, int*, int*)>("XGetScreenSaver");
    if (!flush || !resetSaver || !setTimeouts || !timeouts) return false;
    timeouts(display, &timeout, &interval, &blanking, &exposures);
    return true;
  }

  /// Fails if the library is missing. A server without the extension is no failure.
  std::optional<std::string> findSuspension() {
    const auto saver = SharedLibrary::open("libXss.so.1", "libxss1");
    if (!saver) return saver.error().message;
    const auto extension = saver.value().find<int(XlibDisplay*, int*, int*)>("XScreenSaverQueryExtension");
    const auto version = saver.value().find<int(XlibDisplay*, int*, int*)>("XScreenSaverQueryVersion");
    const auto found = saver.value().find<void(XlibDisplay*, int)>("XScreenSaverSuspend");
    int a = 0, b = 0, major = 0, minor = 0;
    const bool there = extension && version && found && extension(display, &a, &b) &&
                       version(display, &major, &minor) && (major > 1 || minor >= 1);
    if (there) suspend = found;
    return {};
  }

  /// Lights a monitor that DPMS has darkened already.
  void light() const {
    const auto library = SharedLibrary::open("libXext.so.6", "libxext6");  // GLFW's libraries need it, too
    if (!library) return;
    const auto extension = library.value().find<int(XlibDisplay*, int*, int*)>("DPMSQueryExtension");
    const auto capable = library.value().find<int(XlibDisplay*)>("DPMSCapable");
    const auto info = library.value().find<int(XlibDisplay*, unsigned short*, unsigned char*)>("DPMSInfo");
    const auto force = library.value().find<int(XlibDisplay*, unsigned short)>("DPMSForceLevel");
    int a = 0, b = 0;
    unsigned short level = kDpmsModeOn;
    unsigned char on = 0;
    if (!extension || !capable || !info || !force || !extension(display, &a, &b) || !capable(display)) return;
    if (info(display, &level, &on) && on && level != kDpmsModeOn) force(display, kDpmsModeOn);
  }
};

ScreenSaverPause::ScreenSaverPause(void* display) {
  if (!display) return;
  x_ = std::make_unique<X>(static_cast<XlibDisplay*>(display));
  if (!x_->findXlib()) {
    x_.reset();
    return;
  }
  if (const auto why = x_->findSuspension())
    shortcoming_ =
        *why + "; until then the screen saver is reset once a second, which fails if the show stalls";
  if (x_->suspend) x_->suspend(x_->display, 1);
  x_->light();
  poll(std::chrono::steady_clock::now());
}

ScreenSaverPause::~ScreenSaverPause() {
  if (!x_ || xConnectionLost()) return;
  if (x_->suspend) x_->suspend(x_->display, 0);
  x_->flush(x_->display);
}

void ScreenSaverPause::poll(std::chrono::steady_clock::time_point now) {
  if (!x_ || now < due_ || xConnectionLost()) return;
  due_ = now + (x_->suspend ? kResetSuspended : kResetAlone);
  x_->resetSaver(x_->display);
  x_->flush(x_->display);
}

void ScreenSaverPause::restoreTimeouts() {
  if (!x_ || xConnectionLost()) return;
  x_->setTimeouts(x_->display, x_->timeout, x_->interval, x_->blanking, x_->exposures);
  x_->flush(x_->display);
}

}  // namespace stadion
