#pragma once
/// Light from all around, where OpenGL reads it: one texture of all maps, and a uniform block.
///
/// Layout     the picture is in the corner, the maps stand in a row beyond it.
/// Cost       uploaded when another light is shown; the block in each frame with one.
/// Ownership  owns its GL objects; keeps the light that it has uploaded.
/// Threads    the thread on which the context is current.

#include "pipeline/gl_draw/gpu/frame_data.h"
#include "pipeline/shader/uniform_blocks.h"

#include <memory>
#include <optional>

namespace stadion {

class EnvironmentTexture {
public:
  EnvironmentTexture(const GlTable& gl, UploadRing* ring) : gl_(gl), block_(gl, ring, GL_UNIFORM_BUFFER) {}

  /// Makes the light ready and binds its texture.
  void show(const EnvironmentRecord& record, const std::shared_ptr<const EnvironmentLight>& light);
  /// Binds the block. Expects that a light was shown.
  void bindBlock() const { block_.bindBlock(kEnvironmentBinding); }

private:
  void upload();
  void uploadMap(std::size_t first, std::uint32_t x, std::uint32_t y, std::uint32_t side) const;

  const GlTable& gl_;
  FrameData block_;
  std::optional<GlTexture> texture_;
  std::shared_ptr<const EnvironmentLight> light_;
  EnvironmentBlock places_{};  ///< where the maps are
};

}  // namespace stadion
