#pragma once
/// Drawing targets of walls: one OpenGL context, with or without a window, from one of several
/// implementations.
///
/// The GlRenderer owns the colour result (an offscreen buffer of the target's size per eye), so all providers
/// give the same pixels.

#include "engine/base/diagnostic.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

struct GlTable;

/// One context, for one wall.
///
/// Ownership  its provider must outlive it.
/// Threads    current on at most one thread at a time, and a thread has at most one target current. Any
///            thread may destroy it once it has been released.
class Target {
public:
  virtual ~Target() = default;
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  /// Makes the context current on the calling thread. Any previous context must have been released. Returns
  /// the error, or nothing.
  virtual std::optional<Diagnostic> makeCurrent() = 0;
  /// Leaves the calling thread without a context. Expects that this target is current on it.
  virtual void release() = 0;

  const GlTable& gl() const { return gl_; }
  /// Serialises the provider's contexts if they must not run at the same time (GlRenderer).
  std::mutex& turns() const { return turns_; }
  std::uint32_t width() const { return width_; }    ///< [pixels]
  std::uint32_t height() const { return height_; }  ///< [pixels]

protected:
  Target(const GlTable& gl, std::mutex& turns, std::uint32_t width, std::uint32_t height)
      : gl_(gl), turns_(turns), width_(width), height_(height) {}

private:
  const GlTable& gl_;
  std::mutex& turns_;
  std::uint32_t width_, height_;
};

/// One OpenGL implementation, loaded at run time and never unloaded.
///
/// Threads  create() may be called from any thread.
class GlProvider {
public:
  virtual ~GlProvider() = default;

  virtual std::string_view name() const = 0;
  /// Creates a context with OpenGL 4.5 core, or with 3.3 core if there is no better one. It is current on no
  /// thread.
  virtual Result<std::unique_ptr<Target>> create(std::uint32_t width, std::uint32_t height) = 0;
  /// Like create(), on the card with this number. Without a number, or without a choice of cards, the card is
  /// that of create(). Fails with a list of the cards if there is no such card.
  virtual Result<std::unique_ptr<Target>> createOn(std::optional<std::uint32_t> card, std::uint32_t width,
                                                   std::uint32_t height);
  /// Describes the cards of this machine, by number; empty if the implementation has no choice. Graphics cards
  /// come before what draws in software.
  virtual std::vector<std::string> cards() { return {}; }
};

enum class GlProviderKind {
  OsMesa,  ///< Mesa's software rasteriser without any window system
  Egl,     ///< EGL without surfaces: software, or a device that the system's EGL finds
};

/// Loads the implementation. Call pinRasteriser() before the first one.
Result<std::unique_ptr<GlProvider>> openGlProvider(GlProviderKind kind);
Result<std::unique_ptr<GlProvider>> openOsMesa();
Result<std::unique_ptr<GlProvider>> openEgl();

/// Returns why this provider cannot make pictures of this size, or nothing. Tests it with a temporary
/// context. Expects that no context is current on the calling thread, and leaves none.
std::optional<Diagnostic> checkPictureSize(GlProvider& provider, std::uint32_t width, std::uint32_t height);

/// Describes the target current here: "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa
/// 22.3.6".
std::string describeGl(const GlTable& gl);

}  // namespace stadion
