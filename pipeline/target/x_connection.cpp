#include "pipeline/target/x_connection.h"

#include "engine/base/shared_library.h"

#include <atomic>

namespace stadion {
namespace {

// Xlib's own types, as its ABI defines them: its headers need not be installed.
struct XDisplay;
struct XErrorEvent {
  int type;
  XDisplay* display;
  unsigned long resource, serial;
  unsigned char error, request, minor;
};
using IoError = int (*)(XDisplay*);
using IoErrorExit = void (*)(XDisplay*, void*);
using Error = int (*)(XDisplay*, XErrorEvent*);

constexpr unsigned char kBadWindow = 3, kBadDrawable = 9;

std::atomic<const char*> lost = nullptr;
bool anyIgnored = false;
Error handlerBefore = nullptr;

void note(const char* why) {
  const char* none = nullptr;
  lost.compare_exchange_strong(none, why);
}

/// The function that sets the handler of errors; null without Xlib.
Error (*handlerSetter())(Error) {
  const auto xlib = SharedLibrary::open("libX11.so.6", "libx11-6");
  return xlib ? xlib.value().find<Error(Error)>("XSetErrorHandler") : nullptr;
}

}  // namespace

void watchXConnection(void* display) {
  if (!display) return;
  const auto xlib = SharedLibrary::open("libX11.so.6", "libx11-6");  // the copy that GLFW has loaded
  if (!xlib) return;
  const auto onExit = xlib.value().find<void(XDisplay*, IoErrorExit, void*)>("XSetIOErrorExitHandler");
  const auto onIoError = xlib.value().find<IoError(IoError)>("XSetIOErrorHandler");
  const auto onError = xlib.value().find<Error(Error)>("XSetErrorHandler");
  if (!onExit || !onIoError || !onError) return;
  onIoError([](XDisplay*) { return 0; });  // replaces Xlib's own message: lost() reports the reason
  onExit(
      static_cast<XDisplay*>(display),
      [](XDisplay*, void*) { note("the X server has ended, or somebody has killed a window of the show"); },
      nullptr);
  // Another program may destroy a window without ending the connection. Other errors do no harm.
  onError([](XDisplay*, XErrorEvent* e) {
    if (e->error == kBadWindow || e->error == kBadDrawable) note("a window of the show was destroyed");
    return 0;
  });
}

std::optional<std::string> xConnectionLost() {
  const char* why = lost;
  if (!why) return {};
  return std::string("the connection to the display is lost: ") + why;
}

IgnoredXErrors::IgnoredXErrors() {
  anyIgnored = false;
  if (auto* set = handlerSetter())
    handlerBefore = set([](XDisplay*, XErrorEvent*) {
      anyIgnored = true;
      return 0;
    });
}

IgnoredXErrors::~IgnoredXErrors() {
  if (auto* set = handlerSetter()) set(handlerBefore);
}

bool IgnoredXErrors::any() const {
  return anyIgnored;
}

}  // namespace stadion
