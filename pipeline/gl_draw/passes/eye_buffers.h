#pragma once
/// Where one wall's pictures arise: one multisampled buffer, drawn into by one view after the other, and a
/// resolved picture for each view. With one sample a pixel the pictures are drawn into themselves, and
/// drawing may go on with what has been drawn elsewhere.
///
/// Ownership  owns the GL objects. Threads: the thread on which the context is current.

#include "engine/base/diagnostic.h"
#include "pipeline/gl/gl_object.h"
#include "pipeline/shader/look.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace stadion {

class EyeBuffers {
public:
  /// As many samples a pixel as asked for, or as the context offers.
  EyeBuffers(const GlTable& gl, std::uint32_t width, std::uint32_t height, RenderQuality quality);

  /// Why the buffers cannot be used, or nothing. Once, after construction.
  std::optional<Diagnostic> check();
  /// Makes pictures for at least so many views; there is one from the start. Returns why that failed, or
  /// nothing.
  std::optional<Diagnostic> growTo(std::size_t views);
  /// Directs drawing of `view` to where it is drawn.
  void bind(std::uint32_t view);
  /// Directs drawing to the buffer of `view` and clears it.
  void begin(std::uint32_t view);
  /// Directs drawing to the buffer of `view` and fills it with a picture drawn elsewhere. That has one sample
  /// a pixel, in rows from the bottom (height x width). `colours`: RGBA, 8 bits each; `depths`: 1 at the near
  /// plane, 0 at the far one.
  void begin(std::uint32_t view, std::span<const std::uint32_t> colours, std::span<const float> depths);
  /// Completes the picture of `view`: averages its samples.
  void resolve(std::uint32_t view);
  /// 8-bit RGBA (height x width x 4), rows from the top, colour in sRGB. Waits for the drawing to end.
  void read(std::uint32_t view, std::span<std::uint8_t> rgba);

  /// A copy of the depths that have been drawn of `view`: a texture, multisampled as they are. Another
  /// framebuffer is bound afterwards.
  GLuint depthsSoFar(std::uint32_t view);
  std::uint32_t samples() const { return samples_; }  ///< a pixel

  /// The depths of what has been drawn of `view`, 1 at the near plane and 0 at the far one or where nothing
  /// is (height x width), rows from the bottom; with one sample a pixel. Waits for the drawing to end.
  void readDepths(std::uint32_t view, std::span<float> depths);

private:
  void addPicture();
  GLsizei width() const { return static_cast<GLsizei>(width_); }
  GLsizei height() const { return static_cast<GLsizei>(height_); }

  const GlTable& gl_;
  std::uint32_t width_, height_;
  GLenum colours_;
  bool sampled_;  ///< more than once a pixel
  std::uint32_t samples_ = 1;
  GlRenderbuffer colour_, sampledDepth_;  ///< where more than one sample a pixel is taken
  GlFramebuffer drawn_;
  GlTexture depth_;                  ///< where one is
  std::vector<GlTexture> pictures_;  ///< by view
  std::vector<GlFramebuffer> resolved_;
  std::optional<GlTexture> copiedDepth_;  ///< from the first time on that it is asked for
  std::optional<GlFramebuffer> copied_;
};

}  // namespace stadion
