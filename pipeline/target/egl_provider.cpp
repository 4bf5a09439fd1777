// The only file that knows EGL.
#include "pipeline/gl/gl_table.h"
#include "pipeline/gl/picture_size.h"
#include "pipeline/gl/problem.h"
#include "pipeline/platform/shared_library.h"
#include "pipeline/target/rasteriser_settings.h"
#include "pipeline/target/target.h"

#define EGL_NO_X11
#define EGL_NO_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstring>
#include <mutex>

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
};

struct Egl {
  EglFunctions call;
  GlTable gl;
  EGLDisplay display;  // one for the process; never terminated, since another provider may share it
};

class EglTarget : public Target {
public:
  EglTarget(const Egl& egl, std::mutex& turns, EGLContext context, std::uint32_t width, std::uint32_t height)
      : Target(egl.gl, turns, width, height), egl_(egl), context_(context) {}

  ~EglTarget() override { egl_.call.destroyContext(egl_.display, context_); }

  std::optional<Diagnostic> makeCurrent() override {
    if (bind(context_)) return {};
    return problem("EGL cannot make its context current");
  }

  void release() override { bind(EGL_NO_CONTEXT); }

private:
  bool bind(EGLContext context) {
    egl_.call.bindApi(EGL_OPENGL_API);  // the choice is per thread
    return egl_.call.makeCurrent(egl_.display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
  }

  const Egl& egl_;
  EGLContext context_;
};

class EglProvider : public GlProvider {
public:
  explicit EglProvider(const Egl& egl) : egl_(egl) {}

  std::string_view name() const override { return "egl"; }

  Result<std::unique_ptr<Target>> create(std::uint32_t width, std::uint32_t height) override {
    if (auto why = checkPictureSize(width, height)) return *why;
    EGLContext context = createContext(4, 5);
    if (context == EGL_NO_CONTEXT) context = createContext(3, 3);
    if (context == EGL_NO_CONTEXT)
      return Result<std::unique_ptr<Target>>::failure("EGL offers no OpenGL 3.3 core context");
    return std::unique_ptr<Target>(std::make_unique<EglTarget>(egl_, turns_, context, width, height));
  }

private:
  EGLContext createContext(EGLint major, EGLint minor) {
    const std::array<EGLint, 7> wanted{EGL_CONTEXT_MAJOR_VERSION,
                                       major,
                                       EGL_CONTEXT_MINOR_VERSION,
                                       minor,
                                       EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                       EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                       EGL_NONE};
    egl_.call.bindApi(EGL_OPENGL_API);
    return egl_.call.createContext(egl_.display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted.data());
  }

  const Egl egl_;
  std::mutex turns_;
};

bool contains(const char* extensions, const char* name) {
  return extensions && std::strstr(extensions, name) != nullptr;
}

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
  if (!contains(egl.call.queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless"))
    return Opened::failure(
        "this EGL cannot draw without a surface: apt-get install libgl1-mesa-dri libegl-mesa0");
  egl.display = egl.call.platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (egl.display == EGL_NO_DISPLAY || !egl.call.initialize(egl.display, nullptr, nullptr))
    return Opened::failure("EGL finds no device to draw on: apt-get install libgl1-mesa-dri libegl-mesa0");
  const char* extensions = egl.call.queryString(egl.display, EGL_EXTENSIONS);
  if (!contains(extensions, "EGL_KHR_surfaceless_context") ||
      !contains(extensions, "EGL_KHR_no_config_context"))
    return Opened::failure("this EGL makes no contexts without a surface");
  const auto gl = loadGlTable(procAddress);
  if (!gl) return gl.error();
  egl.gl = gl.value();
  return std::unique_ptr<GlProvider>(std::make_unique<EglProvider>(egl));
}

}  // namespace stadion
