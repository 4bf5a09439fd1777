#pragma once
/// Data that OpenGL reads, filled in each frame, or several times in one.
///
/// Ways       with a ring, the data takes a place there. Without one, or if the ring has no memory, it has a
///            buffer of its own, which gets new storage with each filling.
/// Lifetime   filled data lasts until it is filled again, at most until the end of the next frame.
/// Ownership  owns its GL buffer; the function table and the ring must outlive it.
/// Threads    the thread on which the context is current.

#include "pipeline/gl/gl_object.h"
#include "pipeline/gl_draw/gpu/upload_ring.h"

#include <cstddef>
#include <span>

namespace stadion {

class FrameData {
public:
  /// `target`: what the data is bound to, such as GL_ARRAY_BUFFER. `ring`: null = none.
  FrameData(const GlTable& gl, UploadRing* ring, GLenum target)
      : gl_(&gl), ring_(ring), target_(target), own_(gl) {}

  template <class T>
  void fill(std::span<const T> data) {
    fillBytes(std::as_bytes(data));
  }
  /// Makes room for so many bytes, which write() fills.
  void reserve(std::size_t bytes);
  /// Writes into the room, `at` bytes from its start.
  void write(std::size_t at, std::span<const std::byte> data);

  GLuint buffer() const { return place_ ? place_->buffer : own_.name(); }
  std::size_t offset() const { return place_ ? place_->offset : 0; }  ///< of the data in buffer() [bytes]
  /// Binds the data as a block of uniforms.
  void bindBlock(GLuint binding) const;

private:
  void fillBytes(std::span<const std::byte> data);
  bool takePlace(std::size_t bytes);

  const GlTable* gl_;
  UploadRing* ring_;
  GLenum target_;
  GlBuffer own_;
  std::optional<UploadRing::Place> place_;  ///< in the ring; nothing: the data is in `own_`
  std::size_t bytes_ = 0;
};

}  // namespace stadion
