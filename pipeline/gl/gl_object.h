#pragma once
/// GL names that free themselves.
///
/// Ownership  each object owns one name; it keeps a reference to the table, which must outlive it.
/// Threads    made and destroyed on the thread on which its context is current.

#include "pipeline/gl/gl_table.h"

#include <span>
#include <utility>

namespace stadion {

template <auto Generate, auto Delete>
class GlObject {
public:
  explicit GlObject(const GlTable& gl) : gl_(&gl) { (gl.*Generate)(1, &name_); }
  ~GlObject() {
    if (name_) (gl_->*Delete)(1, &name_);
  }
  GlObject(GlObject&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(name_, other.name_);
    return *this;
  }

  GLuint name() const { return name_; }

private:
  const GlTable* gl_;
  GLuint name_ = 0;
};

using GlBuffer = GlObject<&GlTable::GenBuffers, &GlTable::DeleteBuffers>;
using GlTexture = GlObject<&GlTable::GenTextures, &GlTable::DeleteTextures>;
using GlVertexArray = GlObject<&GlTable::GenVertexArrays, &GlTable::DeleteVertexArrays>;
using GlFramebuffer = GlObject<&GlTable::GenFramebuffers, &GlTable::DeleteFramebuffers>;
using GlRenderbuffer = GlObject<&GlTable::GenRenderbuffers, &GlTable::DeleteRenderbuffers>;

/// Fills a buffer for one frame, and leaves it bound. It gets new storage each time, so no frame waits for
/// one that still reads the old storage.
template <class T>
void stream(const GlTable& gl, GLenum target, const GlBuffer& buffer, std::span<const T> data) {
  gl.BindBuffer(target, buffer.name());
  gl.BufferData(target, static_cast<GLsizeiptr>(data.size_bytes()), data.data(), GL_STREAM_DRAW);
}

/// Returns a place in the bound buffer, as OpenGL's calls take it.
inline const void* inBuffer(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes);
}

}  // namespace stadion
