#pragma once
/// A compiled and linked pair of shaders, its uniform blocks bound where uniform_blocks.h says.
///
/// Ownership  owns the GL program. Threads: the thread on which its context is current.

#include "pipeline/draw/gl_table.h"

#include <string>
#include <utility>

namespace stadion {

class GlProgram {
public:
  /// Fails with the compiler's own words.
  static Result<GlProgram> build(const GlTable& gl, const std::string& vertex, const std::string& fragment);

  ~GlProgram() {
    if (name_) gl_->DeleteProgram(name_);
  }
  GlProgram(GlProgram&& other) noexcept
      : gl_(other.gl_), name_(std::exchange(other.name_, 0)), layers_(other.layers_), area_(other.area_) {}
  GlProgram& operator=(GlProgram&&) = delete;

  GLuint name() const { return name_; }
  /// Where the uniforms "layers" and "area" are; -1 if it has none.
  GLint layers() const { return layers_; }
  GLint area() const { return area_; }

private:
  GlProgram(const GlTable& gl, GLuint name) : gl_(&gl), name_(name) {}

  const GlTable* gl_;
  GLuint name_;
  GLint layers_ = -1, area_ = -1;
};

}  // namespace stadion
