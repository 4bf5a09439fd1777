#pragma once
/// A compiled and linked pair of shaders, with its uniform blocks and textures bound.
///
/// Ownership  owns the GL program.
/// Threads    the thread on which its context is current.

#include "pipeline/gl/gl_table.h"

#include <span>
#include <string>
#include <utility>

namespace stadion {

/// A name in the shaders, and its binding point or texture unit.
struct GlBinding {
  const char* name;
  GLuint point;
};

struct GlBindings {
  std::span<const GlBinding> blocks, textures;
};

class GlProgram {
public:
  /// Binds those of the names that the shaders use. Fails with the compiler's message.
  static Result<GlProgram> build(const GlTable& gl, const std::string& vertex, const std::string& fragment,
                                 const GlBindings& bindings);

  ~GlProgram() {
    if (name_) gl_->DeleteProgram(name_);
  }
  GlProgram(GlProgram&& other) noexcept
      : gl_(other.gl_), name_(std::exchange(other.name_, 0)), layers_(other.layers_), area_(other.area_),
        firstDraw_(other.firstDraw_) {}
  GlProgram& operator=(GlProgram&&) = delete;

  GLuint name() const { return name_; }
  /// The locations of the uniforms "layers", "area" and "firstDraw"; -1 if it has none.
  GLint layers() const { return layers_; }
  GLint area() const { return area_; }
  GLint firstDraw() const { return firstDraw_; }

private:
  GlProgram(const GlTable& gl, GLuint name) : gl_(&gl), name_(name) {}

  const GlTable* gl_;
  GLuint name_;
  GLint layers_ = -1, area_ = -1, firstDraw_ = -1;
};

}  // namespace stadion
