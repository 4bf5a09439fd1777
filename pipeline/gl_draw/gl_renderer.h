#pragma once
/// Draws a wall's draw lists with OpenGL 3.3 core.
///
/// Passes      shadow maps, as far as they have changed; then for each view: small objects without OpenGL,
///             opaque objects, the sky where nothing was drawn, transparent objects, and the average of the
///             samples. Each pass is a class in gl_draw/passes; this one orders them. They share a GpuScene.
/// Light       computed in linear RGB; pictures are in sRGB (shaders.h).
/// Beginning   with the first items of a list that Cull still fills, unless a pass must know all items first.
/// Same pixels for the same list in every thread, context and provider of one Mesa version.
/// Ownership   owns its GL objects; the function table, the mutex and the mesh store must outlive it. Meshes
///             are uploaded at their first use, and freed once the store has freed them.
/// Threads     made, used and destroyed on the thread where its context is current. Renderers of a software
///             rasteriser take turns: Mesa 22.3 (lp_scene_is_resource_referenced) looks without a lock
///             whether its other contexts draw with a texture that is bound or read, and crashes if one of
///             them ends a scene just then. They wait for their pixels together.
/// Errors      each kind is returned once, never thrown; everything else is drawn.

#include "pipeline/draw_list/renderer.h"
#include "pipeline/gl/problem_log.h"
#include "pipeline/gl_draw/gpu/gpu_scene.h"
#include "pipeline/gl_draw/passes/eye_buffers.h"
#include "pipeline/gl_draw/passes/opaque_pass.h"
#include "pipeline/gl_draw/passes/pass_context.h"
#include "pipeline/gl_draw/passes/shadow_pass.h"
#include "pipeline/gl_draw/passes/sky_pass.h"
#include "pipeline/gl_draw/passes/small_object_pass.h"
#include "pipeline/gl_draw/passes/transparent_pass.h"
#include "pipeline/gl_draw/sampling/draw_pieces.h"
#include "pipeline/shader/look.h"

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

namespace stadion {

class GlRenderer final : public Renderer {
public:
  /// Pictures of width x height pixels. Fails if the size or the context does not serve.
  static Result<std::unique_ptr<GlRenderer>> create(const GlTable& gl, std::mutex& turns,
                                                    const MeshStore& meshes, std::uint32_t width,
                                                    std::uint32_t height, RenderQuality quality = {});
  ~GlRenderer() override;

  std::optional<Diagnostic> draw(const DrawList& list, const std::function<bool()>& giveUp,
                                 FrameProbe* probe) override;
  std::optional<Diagnostic> draw(const DrawList& list) { return draw(list, {}, nullptr); }
  /// Draws one view.
  std::optional<Diagnostic> draw(const DrawList& list, std::uint32_t view);
  std::optional<Diagnostic> read(std::uint32_t view, std::span<std::uint8_t> rgba) override;

  /// Returns true if the driver has given up the context, because the graphics card was reset or removed.
  bool isLost() const override { return contextIsLost_; }
  const ViewTotals& totals() const override { return totals_; }
  void forgetTotals() override { totals_ = {}; }
  std::string description() const override;

  std::uint32_t width() const { return context_.width; }    ///< [pixels]
  std::uint32_t height() const { return context_.height; }  ///< [pixels]
  /// Returns the counts of the view that was drawn last.
  const DrawCounts& counts() const { return scene_.calls().counts(); }
  std::size_t meshesHeld() const { return scene_.meshes().size(); }
  /// Returns true if there are buffers for transparent objects: not before the first one is seen.
  bool holdsLayers() const { return transparent_.holdsLayers(); }

private:
  using Turn = std::unique_lock<std::mutex>;

  /// Views [first, end) of a list.
  struct Views {
    const DrawList& list;
    std::uint32_t first, end;
  };

  GlRenderer(const GlTable& gl, std::mutex& turns, const MeshStore& meshes, std::uint32_t width,
             std::uint32_t height, RenderQuality quality);
  std::optional<Diagnostic> build();
  Turn turn() const;
  void drawViews(const Views& of, const std::function<bool()>& giveUp, FrameProbe* probe);
  void submit(const Views& of, FrameProbe* probe, Turn& turn);
  void begin(const DrawList& list, FrameProbe* probe);
  bool drawShadows(const DrawList& list, FrameProbe* probe);
  void drawView(const DrawView& from, std::uint32_t index, FrameProbe* probe, Turn& turn);
  void beginPicture(std::uint32_t view, bool withSmallObjects);
  void drawNothing();
  void reportCounts(FrameProbe& probe) const;
  std::optional<Diagnostic> collectProblems();

  const GlTable& gl_;
  std::mutex& turns_;
  Turn lastTurn_;  ///< held while the members below are destroyed
  bool takesTurns_;
  Look look_;
  ClipDepth clipDepth_;
  ProblemLog problems_;
  StopRequest stop_;
  GpuScene scene_;
  EyeBuffers buffers_;
  DrawPieces pieces_;
  PassContext context_;
  SurfaceDrawing surfaces_;
  ShadowPass shadows_;
  SmallObjectPass small_;
  OpaquePass opaque_;
  std::unique_ptr<SkyPass> sky_;  ///< from build() on
  TransparentPass transparent_;
  ViewTotals totals_{};
  bool contextIsLost_ = false;
};

}  // namespace stadion
