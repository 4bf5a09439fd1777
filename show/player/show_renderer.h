#pragma once
/// What draws the walls of a show: the processors, OpenGL, or nothing.
///
/// This is the one place that resolves --renderer and --gl. OpenGL is loaded here, and only if it draws or if
/// the machine has a graphics card.
///
/// Ownership  owns the OpenGL implementation or the threads of the CPU renderer; must outlive the stages.
/// Threads    opened before the program starts other threads; then any.

#include "engine/base/diagnostic.h"
#include "pipeline/draw_list/renderer.h"
#include "pipeline/platform/draw_pool.h"
#include "pipeline/shader/look.h"
#include "pipeline/target/target.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace stadion {

struct ShowParts;

/// The renderer that the user asks for.
enum class RendererChoice : std::uint8_t {
  Auto,  ///< OpenGL on a graphics card if there is one, else the processors
  Cpu,   ///< the processors, without OpenGL
  Gl,    ///< OpenGL, on a graphics card or in software
  None,  ///< nothing is drawn: App and Cull alone
};

struct RendererSettings {
  RendererChoice choice = RendererChoice::Auto;
  /// The implementation of OpenGL; nothing: EGL with a graphics card, else OSMesa.
  std::optional<GlProviderKind> gl{};
  std::uint32_t threads = 0;  ///< threads that draw without OpenGL; 0: one for each processor of this process
  GlSubmission submission{};  ///< how OpenGL gets data and draws

  bool drawsNothing() const { return choice == RendererChoice::None; }
};

class ShowRenderer {
public:
  /// Fails if the implementation of OpenGL that is asked for cannot be loaded.
  static Result<std::unique_ptr<ShowRenderer>> open(const RendererSettings& settings);

  RendererKind kind() const { return kind_; }
  bool drawsWithGl() const { return provider_ != nullptr; }
  bool drawsNothing() const { return !provider_ && threads_ == 0; }
  /// Whether a graphics card draws. May make a context, so the rasteriser's settings must be complete.
  bool drawsOnCard();
  /// Threads that draw without OpenGL; 0: OpenGL draws.
  std::uint32_t threads() const { return threads_; }
  /// "no graphics card: /dev has no render node"; empty if it was asked for.
  const std::string& why() const { return why_; }

  /// Returns why pictures of this size cannot be drawn, or nothing. May make a context.
  std::optional<Diagnostic> checkSize(std::uint32_t width, std::uint32_t height);
  /// Returns why this graphics card cannot draw, or nothing. Without OpenGL cards do not matter.
  std::optional<Diagnostic> checkCard(std::uint32_t card);
  /// The stages draw with this. Expects that `parts` already says whether wall processes draw. In this
  /// process the CPU renderer's threads start with the first call; all later stages share them.
  void drawFor(ShowParts& parts);

private:
  ShowRenderer() = default;
  std::optional<Diagnostic> choose(const RendererSettings& settings);
  std::optional<Diagnostic> openGl(GlProviderKind gl);
  bool openCard();

  RendererKind kind_ = RendererKind::Cpu;
  std::unique_ptr<GlProvider> provider_;
  GlSubmission submission_{};
  std::uint32_t threads_ = 0;
  std::unique_ptr<DrawPool> pool_;  ///< null until stages of this process draw
  std::optional<bool> onCard_{};
  std::string why_;
};

}  // namespace stadion
