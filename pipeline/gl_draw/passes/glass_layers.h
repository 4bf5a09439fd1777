#pragma once
/// Transparent surfaces in the right order for every sample of every pixel, whatever their size and wherever
/// they intersect.
///
/// Method   Each fragment of a transparent surface is put into a list of its pixel: colour, depth, the slope
///          of its depth, and which samples it covers. Then, for every sample, the fragments that cover it
///          and lie in front of what is opaque are sorted by their depth there and blended over it.
/// Rule     The kExactLayers nearest fragments of a sample are blended one over the other, nearest first:
///
///              colour += left x alpha x fragment's colour;  left *= 1 - alpha
///
///          What lies behind them is blended together as one layer, in an order that does not matter: its
///          colour is the mean weighted by alpha, what it lets through is the product of 1 - alpha. The
///          sample becomes colour + left x what was there. In the full look that happens in linear light.
/// Ties     At the same depth, the surface that is later in the list (then: the later part, then the later
///          triangle) lies in front. No order of arrival counts, so that pictures are the same to the bit for
///          any number of threads.
/// Cost     Only where there are transparent surfaces, and only in the part of the picture that their
///          bounding boxes cover. Fragments take at most RenderQuality::mostFragments x 32 bytes: where there
///          are more, the picture is drawn in several bands.
/// Errors   create() fails below OpenGL 4.3; the renderer then sorts whole objects.
/// Ownership  owns its GL objects. Threads: the thread on which the context is current.
///
/// Size     more than 20 fields: most are the GL objects of one pass, with the places of its uniforms.

#include "engine/base/diagnostic.h"
#include "pipeline/gl/gl_object.h"
#include "pipeline/gl/gl_program.h"
#include "pipeline/gl_draw/passes/eye_buffers.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace stadion {

/// A part of a picture, from the bottom left [pixels].
struct PixelArea {
  std::int32_t x = 0, y = 0, width = 0, height = 0;

  bool empty() const { return width <= 0 || height <= 0; }
  bool operator==(const PixelArea&) const = default;
};

PixelArea intersection(const PixelArea& a, const PixelArea& b);

/// Which parts of a picture may be covered: squares of pixels, joined into a few areas that do not overlap.
class CoveredAreas {
public:
  CoveredAreas(std::uint32_t width, std::uint32_t height);
  void clear();
  /// A box, by its corners in clip space.
  void cover(std::span<const std::array<float, 4>, 8> corners);
  /// All that is covered.
  const std::vector<PixelArea>& areas();
  /// Returns the smallest rectangle around all covered areas.
  PixelArea bounds() const { return bounds_; }

private:
  static constexpr std::int32_t kSquare = 32;

  std::int32_t width_, height_, columns_, rows_;
  std::vector<char> covered_;  ///< by square, row after row
  PixelArea bounds_;
  std::vector<PixelArea> areas_;
};

class GlassLayers {
public:
  /// Returns true if this OpenGL can.
  static bool isSupported(const GlTable& gl);
  /// So many fragments are kept at a time.
  static Result<std::unique_ptr<GlassLayers>> create(const GlTable& gl, std::uint32_t width,
                                                     std::uint32_t height, std::uint32_t samples,
                                                     std::uint32_t mostFragments);

  /// Draws transparent surfaces over what has been drawn of `eye`. `surfaces` draws them all with layered
  /// surface programs, and is called once or several times, with another scissor; it may throw. Leaves the
  /// scissor test off and depth writing on.
  void draw(EyeBuffers& buffers, std::uint32_t eye, CoveredAreas& covered,
            const std::function<void()>& surfaces);
  /// For the program in use, before each of its draw calls. `first`: the number of the first triangle of the
  /// first instance, `perInstance`: how far the next instance's is from it.
  void setSurface(const GlProgram& program, std::uint32_t first, std::uint32_t perInstance) const;
  /// Draw calls of the last draw(), but for those of `surfaces`.
  std::uint32_t calls() const { return calls_; }

private:
  GlassLayers(const GlTable& gl, std::uint32_t width, std::uint32_t height, std::uint32_t samples,
              std::uint32_t mostFragments, GlProgram blend);

  void hold(std::uint32_t fragments);
  bool collect(const PixelArea& area, const std::function<void()>& surfaces);
  void blend(const PixelArea& band, const std::vector<PixelArea>& areas);
  void clearHeads(const PixelArea& area);

  const GlTable& gl_;
  std::uint32_t width_, height_;
  bool sampled_;
  std::uint32_t most_;
  GlProgram blend_;
  GLint row_, heads_, nodes_, depths_, corners_;  ///< uniforms of `blend_`
  GlBuffer count_, head_, node_;
  GlTexture headTexture_, nodeTexture_;
  GlVertexArray nothing_;
  std::uint32_t room_ = 0;       ///< for fragments
  std::uint32_t collected_ = 0;  ///< fragments of the last area
  PixelArea area_;               ///< the area that is drawn now
  std::uint64_t total_ = 0;      ///< fragments of the last draw()
  std::uint32_t calls_ = 0;
};

}  // namespace stadion
