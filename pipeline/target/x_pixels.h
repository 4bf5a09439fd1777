#pragma once
/// Shows pixels in a window of an X server, without OpenGL.
///
/// Memory   is shared with the server (MIT-SHM), which then copies each picture once. Where that is refused,
///          for example by a server on another machine, pictures travel through the connection.
/// Formats  the pixels of a TrueColor visual. One that is not 0xAARRGGBB costs a conversion.
/// Threads  the thread of the window system.
/// Errors   another visual is refused. Once the connection is lost, nothing is shown.

#include "pipeline/target/window.h"

#include <memory>
#include <string>

namespace stadion {

class XPixels final : public WindowPixels {
public:
  /// `display` is Xlib's Display, `window` a window of it; none = the format of the screen's root window.
  static Result<std::unique_ptr<XPixels>> open(void* display, unsigned long window = 0);
  ~XPixels() override;

  PixelRows begin(std::uint32_t width, std::uint32_t height) override;
  void show() override;
  /// Shows the last picture once more.
  void showAgain();
  /// "shared memory" or "pictures through the connection", with the conversion if there is one.
  std::string way();

private:
  struct X;
  explicit XPixels(std::unique_ptr<X> x);
  std::unique_ptr<X> x_;
};

}  // namespace stadion
