#include "pipeline/target/x_pixels.h"

#include "engine/base/shared_library.h"
#include "pipeline/target/pixel_format.h"
#include "pipeline/target/x_connection.h"

#include <fmt/format.h>
#include <sys/ipc.h>
#include <sys/shm.h>
#include <type_traits>
#include <utility>
#include <vector>

namespace stadion {
namespace {

// Xlib's own types, as its ABI defines them: its headers need not be installed.
struct XServer;
using XDrawable = unsigned long;
struct XContext;
struct XVisual {
  void* extensions;
  unsigned long id;
  int kind;
  unsigned long red, green, blue;
  int bitsPerColour, entries;
};
struct XAttributes {
  int x, y, width, height, border, depth;
  XVisual* visual;
  char others[104];
};
struct XPixmapFormat {
  int depth, bits, pad;
};
struct XPicture {
  int width, height, offset, format;
  char* data;
  int byteOrder, bitmapUnit, bitmapOrder, pad, depth, bytesPerLine, bits;
  unsigned long red, green, blue;
  char* segment;
  void* functions[6];
};
struct XSegment {
  unsigned long id;
  int memory;
  char* address;
  int readOnly;
};

constexpr int kTrueColour = 4, kWholePixels = 2;  // TrueColor, ZPixmap
constexpr std::size_t kSharedPage = 4096;

#define STADION_X_FUNCTIONS(F)                                                                               \
  F(XCreateGC, XContext*(XServer*, XDrawable, unsigned long, void*))                                         \
  F(XDefaultRootWindow, XDrawable(XServer*))                                                                 \
  F(XFlush, int(XServer*))                                                                                   \
  F(XFree, int(void*))                                                                                       \
  F(XFreeGC, int(XServer*, XContext*))                                                                       \
  F(XGetWindowAttributes, int(XServer*, XDrawable, XAttributes*))                                            \
  F(XImageByteOrder, int(XServer*))                                                                          \
  F(XInitImage, int(XPicture*))                                                                              \
  F(XListPixmapFormats, XPixmapFormat*(XServer*, int*))                                                      \
  F(XPutImage, int(XServer*, XDrawable, XContext*, XPicture*, int, int, int, int, unsigned, unsigned))       \
  F(XSync, int(XServer*, int))

#define STADION_X_SHARING_FUNCTIONS(F)                                                                       \
  F(XShmAttach, int(XServer*, XSegment*))                                                                    \
  F(XShmDetach, int(XServer*, XSegment*))                                                                    \
  F(XShmPutImage,                                                                                            \
    int(XServer*, XDrawable, XContext*, XPicture*, int, int, int, int, unsigned, unsigned, int))             \
  F(XShmQueryExtension, int(XServer*))

struct XFunctions {
#define STADION_X_MEMBER(name, type) std::add_pointer_t<type> name = nullptr;
  STADION_X_FUNCTIONS(STADION_X_MEMBER)
  STADION_X_SHARING_FUNCTIONS(STADION_X_MEMBER)
#undef STADION_X_MEMBER
};

/// Returns the function that is missing; nothing if all are there.
#define STADION_X_LOAD(name, type)                                                                           \
  x.name = library.find<type>(#name);                                                                        \
  if (!x.name) missing = #name;

const char* loadX(const SharedLibrary& library, XFunctions& x) {
  const char* missing = nullptr;
  STADION_X_FUNCTIONS(STADION_X_LOAD)
  return missing;
}

const char* loadXSharing(const SharedLibrary& library, XFunctions& x) {
  const char* missing = nullptr;
  STADION_X_SHARING_FUNCTIONS(STADION_X_LOAD)
  return missing;
}
#undef STADION_X_LOAD
#undef STADION_X_FUNCTIONS
#undef STADION_X_SHARING_FUNCTIONS

std::size_t wholeSharedPages(std::size_t bytes) {
  return (bytes + kSharedPage - 1) / kSharedPage * kSharedPage;
}

/// Memory that the server reads, too.
class SharedPixels {
public:
  SharedPixels(const XFunctions& x, XServer* server) : x_(x), server_(server) {}
  ~SharedPixels() { release(); }
  SharedPixels(const SharedPixels&) = delete;
  SharedPixels& operator=(const SharedPixels&) = delete;

  /// False if the server does not share it.
  bool reserve(std::size_t bytes) {
    if (segment_.address && bytes <= bytes_) return true;
    release();
    const int memory = shmget(IPC_PRIVATE, wholeSharedPages(bytes), IPC_CREAT | 0600);
    if (memory < 0) return false;
    segment_.memory = memory;
    segment_.readOnly = 1;
    void* const address = shmat(memory, nullptr, 0);
    const bool shared = address != reinterpret_cast<void*>(-1) && attach(static_cast<char*>(address));
    shmctl(memory, IPC_RMID, nullptr);  // it goes with the last one that has it
    if (!shared && address != reinterpret_cast<void*>(-1)) shmdt(address);
    if (shared) bytes_ = wholeSharedPages(bytes);
    return shared;
  }
  char* data() const { return segment_.address; }
  XSegment* segment() { return &segment_; }

private:
  // The server may live elsewhere, where another memory has this number. So the attachments are counted.
  bool attach(char* address) {
    segment_.address = address;
    const IgnoredXErrors errors;
    const bool asked = x_.XShmAttach(server_, &segment_) != 0;
    x_.XSync(server_, 0);
    shmid_ds about{};
    const bool shared = asked && !errors.any() && !xConnectionLost() &&
                        shmctl(segment_.memory, IPC_STAT, &about) == 0 && about.shm_nattch == 2;
    if (!shared) segment_.address = nullptr;
    return shared;
  }
  void release() {
    if (!segment_.address) return;
    if (!xConnectionLost()) {
      x_.XShmDetach(server_, &segment_);
      x_.XSync(server_, 0);
    }
    shmdt(segment_.address);
    segment_ = {};
    bytes_ = 0;
  }

  const XFunctions& x_;
  XServer* server_;
  XSegment segment_{};
  std::size_t bytes_ = 0;
};

/// The layout of the pixels of a visual of that depth.
Result<PixelFormat> formatOf(const XFunctions& x, XServer* server, const XAttributes& about) {
  const auto refuse = [&](const std::string& why) {
    return Result<PixelFormat>::failure(
        "pictures cannot be shown on this display without OpenGL: " + why +
        ". Start the X server with 24 bits a pixel, or draw with OpenGL: --renderer gl");
  };
  if (!about.visual || about.visual->kind != kTrueColour)
    return refuse(fmt::format("its {} bits a pixel are numbers in a table of colours", about.depth));
  PixelFormat format;
  format.red = static_cast<std::uint32_t>(about.visual->red);
  format.green = static_cast<std::uint32_t>(about.visual->green);
  format.blue = static_cast<std::uint32_t>(about.visual->blue);
  format.lowFirst = x.XImageByteOrder(server) == 0;
  format.bits = 0;
  int count = 0;
  XPixmapFormat* const all = x.XListPixmapFormats(server, &count);
  for (int i = 0; i < count; ++i)
    if (all[i].depth == about.depth) format.bits = static_cast<std::uint32_t>(all[i].bits);
  if (all) x.XFree(all);
  if (const auto why = whyNotWritten(format)) return refuse(*why);
  return format;
}

}  // namespace

struct XPixels::X {
  X(const XFunctions& functions, XServer* s, XDrawable w, int d, const PixelFormat& format)
      : lib(functions), server(s), window(w), depth(d), plain(format.isPlain()), writer(format),
        shared(lib, server) {
    picture.format = kWholePixels;
    picture.byteOrder = picture.bitmapOrder = format.lowFirst ? 0 : 1;
    picture.bitmapUnit = picture.pad = 32;
    picture.depth = depth;
    picture.bits = static_cast<int>(format.bits);
    picture.red = format.red;
    picture.green = format.green;
    picture.blue = format.blue;
  }
  ~X() {
    if (context && !xConnectionLost()) lib.XFreeGC(server, context);
  }

  /// Memory for the pixels as the server wants them.
  void layOut(std::uint32_t width, std::uint32_t height) {
    const std::size_t perLine = (std::size_t{width} * static_cast<std::uint32_t>(picture.bits) + 31) / 32 * 4;
    picture.width = static_cast<int>(width);
    picture.height = static_cast<int>(height);
    picture.bytesPerLine = static_cast<int>(perLine);
    const std::size_t bytes = perLine * height;
    sharing = sharing && shared.reserve(bytes);
    if (!sharing) own.resize(bytes);
    picture.data = sharing ? shared.data() : own.data();
    picture.segment = sharing ? reinterpret_cast<char*>(shared.segment()) : nullptr;
    lib.XInitImage(&picture);
  }

  void convert() {
    if (plain) return;
    const auto width = static_cast<std::size_t>(picture.width);
    for (int y = 0; y < picture.height; ++y)
      writer.write({words.data() + static_cast<std::size_t>(y) * width, width},
                   reinterpret_cast<std::uint8_t*>(picture.data) + std::ptrdiff_t{y} * picture.bytesPerLine);
  }

  void put() {
    if (!context) context = lib.XCreateGC(server, window, 0, nullptr);
    const auto width = static_cast<unsigned>(picture.width), height = static_cast<unsigned>(picture.height);
    if (sharing)
      lib.XShmPutImage(server, window, context, &picture, 0, 0, 0, 0, width, height, 0);
    else
      lib.XPutImage(server, window, context, &picture, 0, 0, 0, 0, width, height);
    lib.XFlush(server);
    read = !sharing;
  }

  const XFunctions lib;
  XServer* const server;
  const XDrawable window;
  const int depth;
  const bool plain;
  const PixelWriter writer;
  SharedPixels shared;
  std::vector<char> own;             ///< instead of shared memory
  std::vector<std::uint32_t> words;  ///< of the picture, where it must be converted
  XPicture picture{};
  XContext* context = nullptr;
  bool sharing = false;  ///< the server reads our memory
  bool read = true;      ///< it has read the last picture
};

XPixels::XPixels(std::unique_ptr<X> x) : x_(std::move(x)) {}
XPixels::~XPixels() = default;

Result<std::unique_ptr<XPixels>> XPixels::open(void* display, unsigned long window) {
  using Opened = Result<std::unique_ptr<XPixels>>;
  const auto xlib = SharedLibrary::open("libX11.so.6", "libx11-6");  // the copy that GLFW has loaded
  if (!xlib) return xlib.error();
  XFunctions x;
  if (const char* missing = loadX(xlib.value(), x))
    return Opened::failure(fmt::format("libX11.so.6 is too old: it has no {}", missing));
  auto* const server = static_cast<XServer*>(display);
  if (window == 0) window = x.XDefaultRootWindow(server);
  XAttributes about{};
  if (x.XGetWindowAttributes(server, window, &about) == 0)
    return Opened::failure("the X server does not describe its window");
  const auto format = formatOf(x, server, about);
  if (!format) return format.error();
  const auto extensions = SharedLibrary::open("libXext.so.6", "libxext6");
  const bool sharing =
      extensions && !loadXSharing(extensions.value(), x) && x.XShmQueryExtension(server) != 0;
  std::unique_ptr<XPixels> made(
      new XPixels(std::make_unique<X>(x, server, window, about.depth, format.value())));
  made->x_->sharing = sharing;
  return made;
}

// The server reads the memory after the request: it must have done so before the next picture is written.
PixelRows XPixels::begin(std::uint32_t width, std::uint32_t height) {
  X& x = *x_;
  if (!std::exchange(x.read, true) && !xConnectionLost()) x.lib.XSync(x.server, 0);
  if (x.picture.width != static_cast<int>(width) || x.picture.height != static_cast<int>(height))
    x.layOut(width, height);
  if (x.plain) return {reinterpret_cast<std::uint32_t*>(x.picture.data), width, height};
  x.words.resize(std::size_t{width} * height);
  return {x.words.data(), width, height};
}

void XPixels::show() {
  x_->convert();
  showAgain();
}

void XPixels::showAgain() {
  if (x_->picture.data && !xConnectionLost()) x_->put();
}

std::string XPixels::way() {
  if (x_->sharing) x_->layOut(1, 1);
  return fmt::format("{}{}", x_->sharing ? "shared memory" : "pictures through the connection",
                     x_->plain ? "" : fmt::format(", converted to {} bits a pixel", x_->depth));
}

}  // namespace stadion
