#pragma once
/// Draws a wall's draw lists on the processor, without OpenGL.
///
/// Method     Visibility first: triangles are placed, set up and drawn into bands of rows as depth and number
///            for each sample. Then each triangle that a pixel shows is shaded once, several at a time, and
///            the samples are averaged in linear light. So the cost follows what is seen, not what is drawn
///            over. README.md has the steps.
/// Light      the model of the shaders (pipeline/shader/shaders.h).
/// Same pixels  for the same list on every processor, for any number of threads and walls.
/// Ownership  CpuRoom: what all walls of a show share. It must outlive the renderers.
/// Threads    a renderer: one at a time. Several renderers of a room draw at the same time.
/// Errors     as of a Renderer; draw() throws nothing but RunStopped.

#include "pipeline/cpu_draw/mesh/cpu_mesh.h"
#include "pipeline/cpu_draw/mesh/list_meshes.h"
#include "pipeline/cpu_draw/mesh/mesh_paints.h"
#include "pipeline/cpu_draw/mesh/posed_meshes.h"
#include "pipeline/cpu_draw/picture_bands.h"
#include "pipeline/cpu_draw/picture_rung.h"
#include "pipeline/cpu_draw/picture_setup.h"
#include "pipeline/cpu_draw/piece_costs.h"
#include "pipeline/cpu_draw/shadow_store.h"
#include "pipeline/draw_list/renderer.h"
#include "pipeline/platform/draw_pool.h"
#include "pipeline/shader/look.h"
#include "pipeline/surface/environment_lights.h"

#include <cstdint>
#include <memory>
#include <set>
#include <vector>

namespace stadion {

/// Meshes, shadow maps and memory for all walls.
class CpuRoom {
public:
  /// The pool and the store must outlive the room. Other kernels than the best ones are for tests.
  CpuRoom(const MeshStore& store, Look look, DrawPool& pool, const DrawKernels& kernels);
  CpuRoom(const MeshStore& store, Look look, DrawPool& pool);

  const DrawKernels& kernels() const { return kernels_; }
  DrawPool& pool() { return pool_; }
  CpuMeshCache& meshes() { return meshes_; }
  PosedMeshes& poses() { return poses_; }
  MeshPaints& paints() { return paints_; }
  ShadowStore& shadows() { return shadows_; }
  EnvironmentLights& environments() { return environments_; }
  BandMemory& bands() { return bands_; }

private:
  const DrawKernels& kernels_;
  DrawPool& pool_;
  CpuMeshCache meshes_;
  PosedMeshes poses_;
  MeshPaints paints_;
  ShadowStore shadows_;
  EnvironmentLights environments_;
  BandMemory bands_;
};

class CpuRenderer final : public Renderer {
public:
  /// Pictures of width x height pixels; fails if the size does not serve. Expects a room of the rung's look.
  static Result<std::unique_ptr<CpuRenderer>> create(CpuRoom& room, std::uint32_t width, std::uint32_t height,
                                                     PictureRung rung = {});

  std::optional<Diagnostic> draw(const DrawList& list, const std::function<bool()>& giveUp,
                                 FrameProbe* probe) override;
  std::optional<Diagnostic> draw(const DrawList& list) { return draw(list, {}, nullptr); }
  std::optional<Diagnostic> read(std::uint32_t view, std::span<std::uint8_t> rgba) override;
  bool isLost() const override { return false; }
  const ViewTotals& totals() const override { return totals_; }
  void forgetTotals() override { totals_ = {}; }
  std::string description() const override;
  /// Returns the counts of a view's last picture.
  const DrawCounts& counts(std::uint32_t view) const { return pictures_[view].counts; }
  /// From the next list on. Expects the same look.
  void setRung(const PictureRung& rung) { rung_ = rung; }

private:
  struct Picture {
    explicit Picture(const DrawKernels& kernels, std::size_t bytes) : setup(kernels), rgba(bytes) {}
    PictureSetup setup;
    ViewParameters view{};
    std::vector<std::uint8_t> rgba;
    DrawCounts counts;
    bool drawn = false;  ///< the list's view serves
    std::size_t refused = 0;
  };

  CpuRenderer(CpuRoom& room, std::uint32_t width, std::uint32_t height, PictureRung rung);
  void drawWhole(const DrawList& list, const std::function<bool()>& giveUp, FrameProbe* probe);
  void prepare(const DrawList& list, const std::function<bool()>& giveUp);
  void poseFigures(const DrawList& list);
  ListMeshes meshesOf(const DrawList& list) { return {room_.meshes(), room_.poses(), room_.paints(), list}; }
  void begin(const DrawList& list, std::uint32_t view);
  void drawBands(const SceneParameters& scene, const ShadowParameters* shadow,
                 const std::function<bool()>& giveUp);
  void count(const DrawList& list, Eye eye, FrameProbe* probe);
  void sample(const DrawList& list, const SceneParameters& scene, const ShadowParameters* shadow,
              FrameProbe& probe);
  /// Calls work(picture, piece) for each of the pieces of all pictures, on the pool. Asks `giveUp` before
  /// each.
  void forAll(std::size_t (*pieces)(const Picture&), const std::function<void(Picture&, std::size_t)>& work,
              const std::function<bool()>& giveUp);
  void report(std::string what);

  CpuRoom& room_;
  std::uint32_t width_, height_;
  PictureRung rung_;               ///< without stress
  PictureRung drawing_;            ///< of the current list
  std::vector<Picture> pictures_;  ///< by view
  PieceCosts costs_;
  std::size_t views_ = 0;  ///< number of views in the current list
  ViewTotals totals_{};
  std::set<std::string> reported_;
  std::optional<Diagnostic> problem_;
};

}  // namespace stadion
