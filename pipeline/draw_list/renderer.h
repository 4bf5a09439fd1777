#pragma once
/// The interface of a renderer: it draws the lists of one wall and returns the pictures.
///
/// A wall that this process draws, and a wall process, need no more of a renderer than this.
/// gl_draw/gl_renderer.h draws with OpenGL, cpu_draw/cpu_renderer.h without.
///
/// Pictures  one for each view of a list, all of the same size. The same list gives the same pixels.
/// Costs     totals() counts what was drawn. A probe gets the time of each part of a frame.
/// Threads   one thread at a time uses a renderer. A renderer with an OpenGL context is made, used and
///           destroyed on the thread where its context is current.
/// Errors    draw() and read() return each kind of problem once, and draw everything else. They throw nothing
///           but RunStopped.

#include "engine/base/diagnostic.h"
#include "engine/core/frame_probe.h"
#include "pipeline/draw_list/draw_counts.h"
#include "pipeline/draw_list/draw_list.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace stadion {

/// The implementations.
enum class RendererKind : std::uint32_t {
  Cpu,     ///< cpu_draw/cpu_renderer.h
  OsMesa,  ///< gl_draw/gl_renderer.h, with Mesa's software rasteriser
  Egl,     ///< gl_draw/gl_renderer.h, with what the system's EGL finds
};

/// "cpu", "osmesa" or "egl".
constexpr std::string_view nameOf(RendererKind kind) {
  return kind == RendererKind::Cpu ? "cpu" : kind == RendererKind::OsMesa ? "osmesa" : "egl";
}

class Renderer {
public:
  virtual ~Renderer() = default;
  Renderer() = default;
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Draws a complete list, so that no later frame compiles shaders or uploads these meshes. Not counted.
  std::optional<Diagnostic> warmUp(const DrawList& list, const std::function<bool()>& giveUp) {
    auto problem = draw(list, giveUp, nullptr);
    forgetTotals();
    return problem;
  }

  /// Draws all views of the list, which Cull may still be filling, and waits for the end of the drawing: the
  /// time around the call is the cost of the drawing. Returns a new problem, or nothing. Calls `giveUp` now
  /// and then, if it is not empty, on any thread. Once it returns true, RunStopped is thrown and the pictures
  /// are void. `probe` gets spans and counts; null = none.
  virtual std::optional<Diagnostic> draw(const DrawList& list, const std::function<bool()>& giveUp,
                                         FrameProbe* probe) = 0;

  /// Copies the last picture of `view`, which was drawn: 8-bit RGBA (height x width x 4), rows from the top,
  /// sRGB, alpha 255. Expects room for exactly that. Returns a new problem, or nothing.
  virtual std::optional<Diagnostic> read(std::uint32_t view, std::span<std::uint8_t> rgba) = 0;

  /// Returns true if the renderer can never draw again, for example after a reset of the graphics card.
  /// Another renderer must take its place.
  virtual bool isLost() const = 0;

  virtual const ViewTotals& totals() const = 0;
  virtual void forgetTotals() = 0;

  /// Returns a description of the renderer for reports: for example the OpenGL version and the graphics card.
  virtual std::string description() const = 0;
};

}  // namespace stadion
