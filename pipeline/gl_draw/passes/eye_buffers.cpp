#include "pipeline/gl_draw/passes/eye_buffers.h"

#include "pipeline/gl/problem.h"

#include <algorithm>

namespace stadion {
namespace {

void attach(const GlTable& gl, const GlFramebuffer& framebuffer, GLenum attachment,
            const GlTexture& texture) {
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture.name(), 0);
}
void attach(const GlTable& gl, const GlFramebuffer& framebuffer, GLenum attachment,
            const GlRenderbuffer& buffer) {
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer.name());
}

constexpr GLenum kDepth = GL_DEPTH_COMPONENT32F;

struct TexelFormat {
  GLenum stored, format, type;
};

void giveStorage(const GlTable& gl, const GlTexture& texture, GLsizei width, GLsizei height,
                 const TexelFormat& of) {
  gl.BindTexture(GL_TEXTURE_2D, texture.name());
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(of.stored), width, height, 0, of.format, of.type,
                nullptr);
}

}  // namespace

EyeBuffers::EyeBuffers(const GlTable& gl, std::uint32_t width, std::uint32_t height, RenderQuality quality)
    : gl_(gl), width_(width), height_(height),
      colours_(quality.look == Look::Full ? GL_SRGB8_ALPHA8 : GL_RGBA8), sampled_(quality.samples > 1),
      colour_(gl), sampledDepth_(gl), drawn_(gl), depth_(gl) {
  if (!sampled_)
    giveStorage(gl_, depth_, this->width(), this->height(), {kDepth, GL_DEPTH_COMPONENT, GL_FLOAT});
  addPicture();
  gl_.BindTexture(GL_TEXTURE_2D, 0);
  if (!sampled_) return;
  GLint most = 0;
  gl_.GetIntegerv(GL_MAX_SAMPLES, &most);
  samples_ = std::min(std::min(quality.samples, 64u), static_cast<std::uint32_t>(std::max(most, 1)));
  const auto storage = [&](const GlRenderbuffer& buffer, GLenum format) {
    gl_.BindRenderbuffer(GL_RENDERBUFFER, buffer.name());
    gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, static_cast<GLint>(samples_), format, this->width(),
                                       this->height());
  };
  storage(sampledDepth_, kDepth);
  storage(colour_, colours_);
  attach(gl_, drawn_, GL_COLOR_ATTACHMENT0, colour_);
  attach(gl_, drawn_, GL_DEPTH_ATTACHMENT, sampledDepth_);
}

/// Leaves no texture bound.
void EyeBuffers::addPicture() {
  const GlTexture& picture = pictures_.emplace_back(gl_);
  const GlFramebuffer& resolved = resolved_.emplace_back(gl_);
  giveStorage(gl_, picture, width(), height(), {colours_, GL_RGBA, GL_UNSIGNED_BYTE});
  attach(gl_, resolved, GL_COLOR_ATTACHMENT0, picture);
  if (!sampled_) attach(gl_, resolved, GL_DEPTH_ATTACHMENT, depth_);
  gl_.BindTexture(GL_TEXTURE_2D, 0);
}

std::optional<Diagnostic> EyeBuffers::growTo(std::size_t views) {
  if (pictures_.size() >= views) return {};
  while (pictures_.size() < views) addPicture();
  return check();
}

std::optional<Diagnostic> EyeBuffers::check() {
  const auto serves = [&](const GlFramebuffer& framebuffer) {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    return gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  };
  if ((sampled_ && !serves(drawn_)) || !std::ranges::all_of(resolved_, serves))
    return problem("this OpenGL cannot draw into a multisampled sRGB buffer");
  if (const GLenum error = gl_.GetError(); error != GL_NO_ERROR)
    return problem(std::string("no buffers for this picture size: ") + glErrorName(error));
  return {};
}

void EyeBuffers::bind(std::uint32_t view) {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, sampled_ ? drawn_.name() : resolved_[view].name());
  gl_.Viewport(0, 0, width(), height());
}

void EyeBuffers::begin(std::uint32_t view) {
  bind(view);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void EyeBuffers::begin(std::uint32_t view, std::span<const std::uint32_t> colours,
                       std::span<const float> depths) {
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  gl_.BindTexture(GL_TEXTURE_2D, pictures_[view].name());
  gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width(), height(), GL_RGBA, GL_UNSIGNED_BYTE, colours.data());
  gl_.BindTexture(GL_TEXTURE_2D, depth_.name());
  gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width(), height(), GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
  gl_.BindTexture(GL_TEXTURE_2D, 0);
  bind(view);
}

void EyeBuffers::resolve(std::uint32_t view) {
  if (!sampled_) return;
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.name());
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_[view].name());
  gl_.BlitFramebuffer(0, 0, width(), height(), 0, 0, width(), height(), GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

GLuint EyeBuffers::depthsSoFar(std::uint32_t view) {
  if (!copied_) {
    copied_.emplace(gl_);
    copiedDepth_.emplace(gl_);
    const GLenum target = sampled_ ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
    gl_.BindTexture(target, copiedDepth_->name());
    if (sampled_) {
      gl_.TexImage2DMultisample(target, static_cast<GLsizei>(samples_), kDepth, width(), height(), GL_TRUE);
    } else {
      gl_.TexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
      gl_.TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
      gl_.TexImage2D(target, 0, kDepth, width(), height(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
    }
    gl_.BindTexture(target, 0);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, copied_->name());
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, target, copiedDepth_->name(), 0);
    gl_.DrawBuffer(GL_NONE);
    gl_.ReadBuffer(GL_NONE);
  }
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, sampled_ ? drawn_.name() : resolved_[view].name());
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, copied_->name());
  gl_.BlitFramebuffer(0, 0, width(), height(), 0, 0, width(), height(), GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  return copiedDepth_->name();
}

void EyeBuffers::readDepths(std::uint32_t view, std::span<float> depths) {
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_[view].name());
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl_.ReadPixels(0, 0, width(), height(), GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
}

void EyeBuffers::read(std::uint32_t view, std::span<std::uint8_t> rgba) {
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_[view].name());
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.ReadPixels(0, 0, width(), height(), GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  const std::size_t row = std::size_t{width_} * 4;  // OpenGL counts rows from the bottom
  for (std::size_t top = 0, bottom = height_ - 1; top < bottom; ++top, --bottom)
    std::swap_ranges(rgba.data() + top * row, rgba.data() + (top + 1) * row, rgba.data() + bottom * row);
}

}  // namespace stadion
