#include "pipeline/gl_draw/gpu/upload_ring.h"

#include <algorithm>
#include <utility>

namespace stadion {
namespace {

/// Longest single wait for a fence [ns]; repeated until it is signalled.
constexpr GLuint64 kWaitSlice = 1'000'000'000;

std::size_t alignmentOf(const GlTable& gl) {
  GLint uniforms = 1, storage = 1;
  gl.GetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &uniforms);
  if (hasGlExtension(gl, "GL_ARB_shader_storage_buffer_object"))
    gl.GetIntegerv(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT, &storage);
  return static_cast<std::size_t>(std::max({uniforms, storage, 64}));  // both are powers of two
}

}  // namespace

bool UploadRing::isSupported(const GlTable& gl) {
  return gl.BufferStorage && gl.MapBufferRange && hasGlExtension(gl, "GL_ARB_buffer_storage");
}

UploadRing::UploadRing(const GlTable& gl, std::size_t segmentBytes)
    : gl_(gl), alignment_(alignmentOf(gl)), segmentBytes_(segmentBytes) {}

UploadRing::~UploadRing() {
  for (GLsync fence : read_)
    if (fence) gl_.DeleteSync(fence);
}

void UploadRing::beginFrame() {
  if (buffers_.empty()) return;
  if (read_[segment_]) gl_.DeleteSync(read_[segment_]);
  read_[segment_] = gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  segment_ = (segment_ + 1) % kSegments;
  used_ = 0;
  await(read_[segment_]);
}

/// Ends also if the context is lost.
void UploadRing::await(GLsync& fence) const {
  if (!fence) return;
  while (gl_.ClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, kWaitSlice) == GL_TIMEOUT_EXPIRED) {
  }
  gl_.DeleteSync(std::exchange(fence, nullptr));
}

std::optional<UploadRing::Place> UploadRing::take(std::size_t bytes) {
  const std::size_t rounded = (std::max<std::size_t>(bytes, 1) + alignment_ - 1) / alignment_ * alignment_;
  if (buffers_.empty() || used_ + rounded > segmentBytes_) {
    std::size_t larger = buffers_.empty() ? segmentBytes_ : 2 * segmentBytes_;
    while (larger < rounded) larger *= 2;
    if (!map(larger)) return {};
  }
  const std::size_t offset = segment_ * segmentBytes_ + std::exchange(used_, used_ + rounded);
  const Mapped& now = buffers_.back();
  return Place{now.buffer.name(), offset, now.memory + offset};
}

/// Makes the buffer that is used from now on. It is new, so no fence protects it.
bool UploadRing::map(std::size_t segmentBytes) {
  constexpr GLbitfield kAccess = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  const auto bytes = static_cast<GLsizeiptr>(kSegments * segmentBytes);
  GlBuffer buffer(gl_);
  gl_.BindBuffer(GL_COPY_WRITE_BUFFER, buffer.name());
  gl_.BufferStorage(GL_COPY_WRITE_BUFFER, bytes, nullptr, kAccess);
  void* memory = gl_.MapBufferRange(GL_COPY_WRITE_BUFFER, 0, bytes, kAccess);
  gl_.BindBuffer(GL_COPY_WRITE_BUFFER, 0);
  if (!memory) return false;
  buffers_.push_back({std::move(buffer), static_cast<std::byte*>(memory)});
  segmentBytes_ = segmentBytes;
  used_ = 0;
  return true;
}

}  // namespace stadion
