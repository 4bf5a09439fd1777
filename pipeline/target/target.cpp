#include "pipeline/target/target.h"

#include "pipeline/draw/gl_table.h"

#include <fmt/format.h>

namespace stadion {

Result<std::unique_ptr<GlProvider>> openGlProvider(GlProviderKind kind) {
  return kind == GlProviderKind::OsMesa ? openOsMesa() : openEgl();
}

std::string describeGl(const GlTable& gl) {
  const auto text = [&](GLenum what) {
    const auto* s = reinterpret_cast<const char*>(gl.GetString(what));
    return std::string(s ? s : "unknown");
  };
  return fmt::format("{}, OpenGL {}", text(GL_RENDERER), text(GL_VERSION));
}

}  // namespace stadion
