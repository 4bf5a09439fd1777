#pragma once
/// How much a picture may cost.

#include <cstdint>

namespace stadion {

enum class Look : std::uint8_t {
  /// Light in linear RGB for every pixel, highlights, shadows, a sky with a sun; several samples a pixel.
  Full,
  /// As OpenGL drew without shaders: light at the corners of triangles, reckoned with colours as they are
  /// stored, the same from all sides; one sample a pixel, no highlights, no shadows, the sky without its
  /// glow. The back of an open surface is lit as its front. For shows that must be fast on a processor.
  Plain,
};

struct RenderQuality {
  Look look = Look::Full;
  std::uint32_t samples = 4;  ///< per pixel; 1 = hard edges at about a third of the cost in software

  /// Instances a draw call: in software one call of a hundred thousand takes many seconds, in which nobody
  /// can stop. 1 = each thing by a call of its own.
  std::uint32_t mostAtOnce = 1024;
  /// Where one sample a pixel is taken, things that cover no pixel's middle are not drawn; in software,
  /// neither are triangles that cover none or are turned away (triangle_sieve.h). Nothing would be seen of
  /// them. False: all that is in view goes to OpenGL, for comparisons.
  bool leavesOutUnseen = true;
  /// There, in the plain look, small things are drawn without OpenGL (small_things.h).
  bool drawsSmallThings = true;

  /// Of transparent surfaces, so many fragments are sorted at a time (glass_layers.h); each takes 32 bytes. The
  /// picture does not depend on it.
  std::uint32_t mostFragments = 1U << 21;

  static constexpr RenderQuality plain() { return {Look::Plain, 1}; }
  bool operator==(const RenderQuality&) const = default;
};

}  // namespace stadion
