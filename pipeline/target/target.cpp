#include "pipeline/target/target.h"

#include "pipeline/gl/gl_table.h"
#include "pipeline/gl/picture_size.h"
#include "pipeline/gl/problem.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace stadion {

Result<std::unique_ptr<GlProvider>> openGlProvider(GlProviderKind kind) {
  return kind == GlProviderKind::OsMesa ? openOsMesa() : openEgl();
}

Result<std::unique_ptr<Target>> GlProvider::createOn(std::optional<std::uint32_t>, std::uint32_t width,
                                                     std::uint32_t height) {
  return create(width, height);
}

std::optional<Diagnostic> checkPictureSize(GlProvider& provider, std::uint32_t width, std::uint32_t height) {
  if (auto why = checkPictureSize(width, height)) return why;
  const auto target = provider.create(1, 1);
  if (!target) return target.error();
  if (auto why = target.value()->makeCurrent()) return why;
  const GlTable& gl = target.value()->gl();
  GLint texture = 0, buffer = 0;
  std::array<GLint, 2> viewport{};
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
  gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &buffer);
  gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  target.value()->release();
  const auto most = [&](GLint side) {
    return static_cast<std::uint32_t>(std::max(0, std::min({texture, buffer, side})));
  };
  if (width <= most(viewport[0]) && height <= most(viewport[1])) return {};
  return problem(fmt::format("a picture of {} x {} pixels is too large for {}, which draws at most {} x {}",
                             width, height, provider.name(), most(viewport[0]), most(viewport[1])));
}

std::string describeGl(const GlTable& gl) {
  const auto text = [&](GLenum what) {
    const auto* s = reinterpret_cast<const char*>(gl.GetString(what));
    return std::string(s ? s : "unknown");
  };
  return fmt::format("{}, OpenGL {}", text(GL_RENDERER), text(GL_VERSION));
}

}  // namespace stadion
