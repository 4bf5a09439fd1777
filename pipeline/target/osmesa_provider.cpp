// The only file that knows OSMesa.
#include "engine/base/shared_library.h"
#include "pipeline/gl/gl_table.h"
#include "pipeline/gl/picture_size.h"
#include "pipeline/gl/problem.h"
#include "pipeline/target/rasteriser_settings.h"
#include "pipeline/target/target.h"

#include <GL/osmesa.h>

#include <array>
#include <mutex>

namespace stadion {
namespace {

struct OsMesaFunctions {
  decltype(&OSMesaCreateContextAttribs) createContext = nullptr;
  decltype(&OSMesaDestroyContext) destroyContext = nullptr;
  decltype(&OSMesaMakeCurrent) makeCurrent = nullptr;
  decltype(&OSMesaGetProcAddress) procAddress = nullptr;
};

struct OsMesa {
  OsMesaFunctions call;
  GlTable gl;
  std::mutex turns;  // also guards the contexts: OSMesa keeps their objects in unguarded lists
};

class OsMesaTarget : public Target {
public:
  OsMesaTarget(OsMesa& mesa, OSMesaContext context, std::uint32_t width, std::uint32_t height)
      : Target(mesa.gl, mesa.turns, width, height), mesa_(mesa), context_(context) {}

  ~OsMesaTarget() override {
    const std::lock_guard turn(mesa_.turns);
    mesa_.call.destroyContext(context_);
  }

  std::optional<Diagnostic> makeCurrent() override {
    const std::lock_guard turn(mesa_.turns);
    if (mesa_.call.makeCurrent(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1)) return {};
    return problem("OSMesa cannot make its context current");
  }

  void release() override {
    const std::lock_guard turn(mesa_.turns);
    mesa_.call.makeCurrent(nullptr, nullptr, 0, 0, 0);
  }

private:
  OsMesa& mesa_;
  OSMesaContext context_;
  // OSMesa needs memory for a default framebuffer, and copies into it at each flush. We draw nothing there.
  std::array<std::uint8_t, 4> pixel_{};
};

class OsMesaProvider : public GlProvider {
public:
  OsMesaProvider(const OsMesaFunctions& call, const GlTable& gl) : mesa_{call, gl, {}} {}

  std::string_view name() const override { return "osmesa"; }

  Result<std::unique_ptr<Target>> create(std::uint32_t width, std::uint32_t height) override {
    if (auto why = checkPictureSize(width, height)) return *why;
    OSMesaContext context = createContext(4, 5);
    if (!context) context = createContext(3, 3);
    if (!context) return Result<std::unique_ptr<Target>>::failure("OSMesa offers no OpenGL 3.3 core context");
    return std::unique_ptr<Target>(std::make_unique<OsMesaTarget>(mesa_, context, width, height));
  }

private:
  OSMesaContext createContext(int major, int minor) {
    const std::array<int, 13> wanted{OSMESA_FORMAT,
                                     OSMESA_RGBA,
                                     OSMESA_DEPTH_BITS,
                                     0,
                                     OSMESA_PROFILE,
                                     OSMESA_CORE_PROFILE,
                                     OSMESA_CONTEXT_MAJOR_VERSION,
                                     major,
                                     OSMESA_CONTEXT_MINOR_VERSION,
                                     minor,
                                     0};
    const std::lock_guard turn(mesa_.turns);
    return mesa_.call.createContext(wanted.data(), nullptr);
  }

  OsMesa mesa_;
};

}  // namespace

Result<std::unique_ptr<GlProvider>> openOsMesa() {
  using Opened = Result<std::unique_ptr<GlProvider>>;
  if (auto why = checkRasteriser()) return *why;
  const auto library = SharedLibrary::open("libOSMesa.so.8", "libosmesa6");
  if (!library) return library.error();
  OsMesaFunctions call;
  call.createContext =
      library.value().find<std::remove_pointer_t<decltype(call.createContext)>>("OSMesaCreateContextAttribs");
  call.destroyContext =
      library.value().find<std::remove_pointer_t<decltype(call.destroyContext)>>("OSMesaDestroyContext");
  call.makeCurrent =
      library.value().find<std::remove_pointer_t<decltype(call.makeCurrent)>>("OSMesaMakeCurrent");
  call.procAddress =
      library.value().find<std::remove_pointer_t<decltype(call.procAddress)>>("OSMesaGetProcAddress");
  if (!call.createContext || !call.destroyContext || !call.makeCurrent || !call.procAddress)
    return Opened::failure("libOSMesa.so.8 is too old: it cannot make OpenGL core contexts");
  const auto gl = loadGlTable(call.procAddress);
  if (!gl) return gl.error();
  return std::unique_ptr<GlProvider>(std::make_unique<OsMesaProvider>(call, gl.value()));
}

}  // namespace stadion
