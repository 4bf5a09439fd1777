#include "pipeline/gl_draw/gpu/frame_data.h"

#include <algorithm>

namespace stadion {

bool FrameData::takePlace(std::size_t bytes) {
  place_ = ring_ ? ring_->take(bytes) : std::nullopt;
  bytes_ = bytes;
  return place_.has_value();
}

void FrameData::fillBytes(std::span<const std::byte> data) {
  if (takePlace(data.size()))
    std::ranges::copy(data, place_->memory);
  else
    stream(*gl_, target_, own_, data);
}

void FrameData::reserve(std::size_t bytes) {
  if (takePlace(bytes)) return;
  gl_->BindBuffer(target_, own_.name());
  gl_->BufferData(target_, static_cast<GLsizeiptr>(bytes), nullptr, GL_STREAM_DRAW);
}

void FrameData::write(std::size_t at, std::span<const std::byte> data) {
  if (place_) return void(std::ranges::copy(data, place_->memory + at));
  gl_->BindBuffer(target_, own_.name());
  gl_->BufferSubData(target_, static_cast<GLintptr>(at), static_cast<GLsizeiptr>(data.size()), data.data());
}

void FrameData::bindBlock(GLuint binding) const {
  if (place_)
    gl_->BindBufferRange(GL_UNIFORM_BUFFER, binding, place_->buffer, static_cast<GLintptr>(place_->offset),
                         static_cast<GLsizeiptr>(bytes_));
  else
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, binding, own_.name());
}

}  // namespace stadion
