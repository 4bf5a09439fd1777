#pragma once
/// Memory through which a frame's data reaches the graphics card: a buffer that stays mapped.
///
/// Data is written straight to where the card reads it, so no call copies it or makes new storage. The buffer
/// has three segments, which frames use in turn. A fence tells when the card has read a segment.
///
/// Room       if a frame needs more than a segment, a buffer of twice the size takes over. Older ones stay
///            until the end, since their places may still be drawn from. Together they are smaller.
/// Ownership  owns the GL buffers; the function table must outlive it.
/// Threads    the thread on which the context is current.

#include "pipeline/gl/gl_object.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace stadion {

class UploadRing {
public:
  /// Returns true if the context has buffers that stay mapped.
  static bool isSupported(const GlTable& gl);
  explicit UploadRing(const GlTable& gl, std::size_t segmentBytes = kFirstSegment);
  ~UploadRing();
  UploadRing(const UploadRing&) = delete;
  UploadRing& operator=(const UploadRing&) = delete;

  struct Place {
    GLuint buffer;
    std::size_t offset;  ///< in the buffer, as every use of a buffer needs it aligned [bytes]
    std::byte* memory;   ///< where to write; what is written before a call is there for the call
  };
  /// Goes on to the next segment. Waits until the card has read what was written there three frames ago.
  void beginFrame();
  /// Returns a place for so many bytes, which lasts for this frame and the next one. Nothing if there is no
  /// memory.
  std::optional<Place> take(std::size_t bytes);

private:
  static constexpr std::size_t kSegments = 3, kFirstSegment = std::size_t{1} << 20;

  struct Mapped {
    GlBuffer buffer;
    std::byte* memory;
  };
  bool map(std::size_t segmentBytes);
  void await(GLsync& fence) const;

  const GlTable& gl_;
  std::size_t alignment_ = 256;
  std::size_t segmentBytes_;
  std::vector<Mapped> buffers_;           ///< the last one is in use
  std::array<GLsync, kSegments> read_{};  ///< by segment: signalled when the card has read it
  std::size_t segment_ = 0, used_ = 0;    ///< the frame's segment, and how much of it is taken [bytes]
};

}  // namespace stadion
