// The only file that knows EGL.
#include "engine/base/shared_library.h"
#include "pipeline/gl/gl_table.h"
#include "pipeline/gl/picture_size.h"
#include "pipeline/gl/problem.h"
#include "pipeline/target/rasteriser_settings.h"
#include "pipeline/target/target.h"

#define EGL_NO_X11
#define EGL_NO_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace stadion {
namespace {

struct EglFunctions {
  PFNEGLBINDAPIPROC bindApi = nullptr;
  PFNEGLCREATECONTEXTPROC createContext = nullptr;
  PFNEGLDESTROYCONTEXTPROC destroyContext = nullptr;
  PFNEGLGETPLATFORMDISPLAYEXTPROC platformDisplay = nullptr;
  PFNEGLINITIALIZEPROC initialize = nullptr;
  PFNEGLMAKECURRENTPROC makeCurrent = nullptr;
  PFNEGLQUERYSTRINGPROC queryString = nullptr;
  // Null in an EGL that cannot list cards.
  PFNEGLQUERYDEVICESEXTPROC queryDevices = nullptr;
  PFNEGLQUERYDEVICESTRINGEXTPROC queryDeviceString = nullptr;
  PFNEGLQUERYDISPLAYATTRIBEXTPROC queryDisplayAttribute = nullptr;
};

struct Egl {
  EglFunctions call;
  GlTable gl;
};

bool contains(const char* extensions, const char* name) {
  return extensions && std::strstr(extensions, name) != nullptr;
}

/// Something that EGL can draw on: a graphics card, or a rasteriser in software.
struct EglCard {
  EGLDeviceEXT device;
  bool software;
  std::string description;
};

/// The cards of this machine, and the displays through which contexts reach them.
///
/// Ownership  a display is opened at its first use. It is never terminated, since another provider may share
///            it.
/// Threads    any.
class EglCards {
public:
  explicit EglCards(const EglFunctions& call) : call_(call) { list(); }

  const std::vector<EglCard>& all() const { return cards_; }

  /// The display of that card; without a number, of the card that EGL chooses.
  Result<EGLDisplay> displayOf(std::optional<std::uint32_t> card) {
    const std::lock_guard lock(mutex_);
    if (const auto at = displays_.find(card); at != displays_.end()) return at->second;
    auto display = card ? openCard(*card) : openAny();
    if (display) displays_.emplace(card, display.value());
    return display;
  }

private:
  using Opened = Result<EGLDisplay>;

  /// EGL's order, but software comes last: the numbers of graphics cards do not depend on it.
  void list() {
    EGLint count = 0;
    const bool lists = contains(call_.queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_EXT_platform_device");
    if (!lists || !call_.queryDevices || !call_.queryDeviceString || !call_.queryDevices(0, nullptr, &count))
      return;
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(std::max(count, 0)));
    if (!call_.queryDevices(count, devices.data(), &count)) return;
    devices.resize(static_cast<std::size_t>(std::max(count, 0)));
    for (const EGLDeviceEXT device : devices) cards_.push_back(describe(device));
    std::stable_partition(cards_.begin(), cards_.end(), [](const EglCard& card) { return !card.software; });
  }

  EglCard describe(EGLDeviceEXT device) const {
    const char* extensions = call_.queryDeviceString(device, EGL_EXTENSIONS);
    const auto text = [&](const char* extension, EGLint name) -> std::string {
      const char* found = contains(extensions, extension) ? call_.queryDeviceString(device, name) : nullptr;
      return found ? found : "";
    };
    const bool software = contains(extensions, "EGL_MESA_device_software");
    std::string description = text("EGL_EXT_device_query_name", EGL_RENDERER_EXT);
    if (description.empty()) description = software ? "in software" : "graphics card";
    std::string file = text("EGL_EXT_device_drm_render_node", EGL_DRM_RENDER_NODE_FILE_EXT);
    if (file.empty()) file = text("EGL_EXT_device_drm", EGL_DRM_DEVICE_FILE_EXT);
    if (!file.empty()) description += " " + file;
    return {device, software, description};
  }

  Opened openCard(std::uint32_t number) {
    if (cards_.empty())
      return Opened::failure(
          fmt::format("this EGL cannot list graphics cards, so there is no card {}", number));
    if (number >= cards_.size()) {
      std::string known;
      for (std::size_t i = 0; i < cards_.size(); ++i)
        known += fmt::format("{}{} ({})", i > 0 ? ", " : "", i, cards_[i].description);
      return Opened::failure(fmt::format("there is no graphics card {}; EGL has these: {}", number, known));
    }
    const EglCard& card = cards_[number];
    auto display = open(EGL_PLATFORM_DEVICE_EXT, card.device);
    if (display) return display;
    return Opened::failure(
        fmt::format("graphics card {} ({}): {}", number, card.description, display.error().message));
  }

  /// Where EGL's own choice draws in software, a graphics card of another driver may be there: NVIDIA's EGL has
  /// displays without surfaces for its devices only.
  Opened openAny() {
    Opened chosen = Opened::failure(
        "this EGL cannot draw without a surface: apt-get install libgl1-mesa-dri libegl-mesa0");
    if (contains(call_.queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless"))
      chosen = open(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY);
    if (chosen && !isSoftwareDisplay(chosen.value())) return chosen;
    for (const EglCard& card : cards_) {
      if (card.software) continue;
      if (auto display = open(EGL_PLATFORM_DEVICE_EXT, card.device)) return display;
    }
    return chosen;
  }

  bool isSoftwareDisplay(EGLDisplay display) const {
    EGLAttrib device = 0;
    if (!call_.queryDisplayAttribute || !call_.queryDisplayAttribute(display, EGL_DEVICE_EXT, &device))
      return false;
    return std::ranges::any_of(cards_, [&](const EglCard& card) {
      return card.software && card.device == reinterpret_cast<EGLDeviceEXT>(device);
    });
  }

  Opened open(EGLenum platform, void* device) const {
    const EGLDisplay display = call_.platformDisplay(platform, device, nullptr);
    if (display == EGL_NO_DISPLAY || !call_.initialize(display, nullptr, nullptr))
      return Opened::failure("EGL finds no device to draw on: apt-get install libgl1-mesa-dri libegl-mesa0");
    const char* extensions = call_.queryString(display, EGL_EXTENSIONS);
    if (!contains(extensions, "EGL_KHR_surfaceless_context") ||
        !contains(extensions, "EGL_KHR_no_config_context"))
      return Opened::failure("this EGL makes no contexts without a surface");
    return display;
  }

  const EglFunctions call_;
  std::vector<EglCard> cards_;
  std::mutex mutex_;
  std::map<std::optional<std::uint32_t>, EGLDisplay> displays_;  ///< by card; of none: EGL's choice
};

class EglTarget : public Target {
public:
  EglTarget(const Egl& egl, std::mutex& turns, EGLDisplay display, EGLContext context, std::uint32_t width,
            std::uint32_t height)
      : Target(egl.gl, turns, width, height), egl_(egl), display_(display), context_(context) {}

  ~EglTarget() override { egl_.call.destroyContext(display_, context_); }

  std::optional<Diagnostic> makeCurrent() override {
    if (bind(context_)) return {};
    return problem("EGL cannot make its context current");
  }

  void release() override { bind(EGL_NO_CONTEXT); }

private:
  bool bind(EGLContext context) {
    egl_.call.bindApi(EGL_OPENGL_API);  // the choice is per thread
    return egl_.call.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
  }

  const Egl& egl_;
  EGLDisplay display_;
  EGLContext context_;
};

class EglProvider : public GlProvider {
public:
  explicit EglProvider(const Egl& egl) : egl_(egl), cards_(egl.call) {}

  std::string_view name() const override { return "egl"; }

  Result<std::unique_ptr<Target>> create(std::uint32_t width, std::uint32_t height) override {
    return createOn({}, width, height);
  }

  Result<std::unique_ptr<Target>> createOn(std::optional<std::uint32_t> card, std::uint32_t width,
                                           std::uint32_t height) override {
    if (auto why = checkPictureSize(width, height)) return *why;
    const auto display = cards_.displayOf(card);
    if (!display) return display.error();
    EGLContext context = createContext(display.value(), 4, 5);
    if (context == EGL_NO_CONTEXT) context = createContext(display.value(), 3, 3);
    if (context == EGL_NO_CONTEXT)
      return Result<std::unique_ptr<Target>>::failure("EGL offers no OpenGL 3.3 core context");
    return std::unique_ptr<Target>(
        std::make_unique<EglTarget>(egl_, turns_, display.value(), context, width, height));
  }

  std::vector<std::string> cards() override {
    std::vector<std::string> descriptions;
    for (const EglCard& card : cards_.all()) descriptions.push_back(card.description);
    return descriptions;
  }

  /// Opens EGL's own choice of a card: if that fails, so does the provider.
  std::optional<Diagnostic> check() {
    const auto display = cards_.displayOf({});
    return display ? std::nullopt : std::optional(display.error());
  }

private:
  EGLContext createContext(EGLDisplay display, EGLint major, EGLint minor) {
    const std::array<EGLint, 7> wanted{EGL_CONTEXT_MAJOR_VERSION,
                                       major,
                                       EGL_CONTEXT_MINOR_VERSION,
                                       minor,
                                       EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                       EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                       EGL_NONE};
    egl_.call.bindApi(EGL_OPENGL_API);
    return egl_.call.createContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted.data());
  }

  const Egl egl_;
  EglCards cards_;
  std::mutex turns_;
};

}  // namespace

Result<std::unique_ptr<GlProvider>> openEgl() {
  using Opened = Result<std::unique_ptr<GlProvider>>;
  if (auto why = checkRasteriser()) return *why;
  const auto library = SharedLibrary::open("libEGL.so.1", "libegl1 libgl1-mesa-dri");
  if (!library) return library.error();
  const auto procAddress = library.value().find<GlSymbol(const char*)>("eglGetProcAddress");
  if (!procAddress) return Opened::failure("libEGL.so.1 has no eglGetProcAddress");
  const auto find = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(procAddress(name));
    return function != nullptr;
  };
  Egl egl{};
  if (!find(egl.call.bindApi, "eglBindAPI") || !find(egl.call.createContext, "eglCreateContext") ||
      !find(egl.call.destroyContext, "eglDestroyContext") || !find(egl.call.initialize, "eglInitialize") ||
      !find(egl.call.makeCurrent, "eglMakeCurrent") || !find(egl.call.queryString, "eglQueryString") ||
      !find(egl.call.platformDisplay, "eglGetPlatformDisplayEXT"))
    return Opened::failure("libEGL.so.1 is too old");
  find(egl.call.queryDevices, "eglQueryDevicesEXT");
  find(egl.call.queryDeviceString, "eglQueryDeviceStringEXT");
  find(egl.call.queryDisplayAttribute, "eglQueryDisplayAttribEXT");
  const auto gl = loadGlTable(procAddress);
  if (!gl) return gl.error();
  egl.gl = gl.value();
  auto provider = std::make_unique<EglProvider>(egl);
  if (auto why = provider->check()) return *why;
  return std::unique_ptr<GlProvider>(std::move(provider));
}

}  // namespace stadion
