#pragma once
/// Settings that trade picture quality for cost.

#include <cstdint>

namespace stadion {

enum class Look : std::uint8_t {
  /// Light in linear RGB for every pixel, highlights, shadows, a sky with a sun; several samples a pixel.
  Full,
  /// As OpenGL drew without shaders: light at the corners of triangles, computed with stored (sRGB) colours,
  /// the same from all sides; one sample a pixel, no highlights, no shadows, the sky without its glow. The
  /// back of an open surface is lit as its front. For shows that must be fast on a processor.
  Plain,
};

/// Returns the look's name on the command line: "full", "plain".
constexpr const char* nameOf(Look look) {
  return look == Look::Plain ? "plain" : "full";
}

/// When a feature of newer OpenGL is used, if the context has it. No pixel depends on it.
enum class GlUse : std::uint8_t {
  OnCard,  ///< if a graphics card draws
  Always,  ///< in software, too
  Never,
};

/// How data and draw calls reach OpenGL.
struct GlSubmission {
  GlUse mapped = GlUse::OnCard;    ///< data of a frame in memory that stays mapped (upload_ring.h)
  GlUse indirect = GlUse::OnCard;  ///< many draws in one call (indirect_draws.h)

  bool operator==(const GlSubmission&) const = default;
};

struct RenderQuality {
  Look look = Look::Full;
  std::uint32_t samples = 4;  ///< per pixel; 1 = hard edges at about a third of the cost in software

  /// Instances a draw call. In software, one call of a hundred thousand takes many seconds and cannot be
  /// interrupted. 1 = a call for each object.
  std::uint32_t mostAtOnce = 1024;
  /// With one sample a pixel, objects that cover no pixel's middle are not drawn. In software, triangles that
  /// cover none or face away are not drawn either (triangle_culler.h). They would not be visible. False: all
  /// objects in view go to OpenGL, for comparisons.
  bool leavesOutUnseen = true;
  /// In software and in the plain look, small objects are drawn without OpenGL (small_object_rasterizer.h).
  bool drawsSmallObjects = true;

  /// Number of fragments of transparent surfaces that are sorted at a time (glass_layers.h); each takes 32
  /// bytes. The picture does not depend on it.
  std::uint32_t mostFragments = 1U << 21;

  bool reflections = true;  ///< shiny surfaces mirror an environment's maps; else its harmonics alone

  GlSubmission submission{};

  static constexpr RenderQuality plain() { return {Look::Plain, 1}; }
  bool operator==(const RenderQuality&) const = default;
};

}  // namespace stadion
