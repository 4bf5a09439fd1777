#pragma once
/// Measures what drawing costs by node, where a probe asks for it (engine/core/frame_probe.h).
///
/// Method   after a frame is drawn, some objects are drawn once more, alone, without the sky. What the same
///          bands cost without them is taken off. Nothing lies in front of them then: what they cost in the
///          frame is less if they are hidden, and the reader scales the costs of all nodes to the whole
///          view's. Rows without objects cost about the same, so every eighth band stands for all.
/// Units    milliseconds of processor time; work is an estimate of cost [pixels].
/// Threads  the calling thread does everything, so that its processor time is the cost.

#include "engine/core/frame_probe.h"
#include "pipeline/cpu_draw/mesh/list_meshes.h"
#include "pipeline/cpu_draw/picture_bands.h"
#include "pipeline/draw_list/draw_list.h"

#include <cstdint>
#include <span>
#include <vector>

namespace stadion {

class PieceCosts {
public:
  PieceCosts(CpuMeshCache& meshes, PosedMeshes& poses, MeshPaints& paints, BandMemory& bands,
             const DrawKernels& kernels)
      : meshes_(meshes), poses_(poses), paints_(paints), bands_(bands), setup_(kernels) {}

  /// A view that has been drawn.
  struct View {
    const DrawList& list;
    std::uint32_t number;
    PictureShading shading;  ///< shading of the view's picture, which is not changed
  };
  /// Measures some objects of the view, and the picture without objects.
  void sampleSome(const View& view, FrameProbe& probe);
  /// Measures the whole view.
  void sampleWhole(const View& view, FrameProbe& probe);
  /// Reports the object of the list with the most to draw, if that is a large part of all.
  void reportLargest(const DrawList& list, FrameProbe& probe);

private:
  /// Items that are drawn alone together.
  struct Piece {
    std::size_t first, count;
  };

  float workOf(const DrawItem& item, const DrawItem* before);
  void findSeen(const View& view);
  void findPieces(FrameProbe& probe);
  std::span<const NodeShare> sharesOf(const Piece& piece);
  double costOf(const View& view, const Piece& piece);
  void setUp(const View& view, const Piece& piece);
  double skyOf(const View& view);
  void measureEmpty(const View& view);
  double rowOf(const View& view, bool surfacesOnly);
  double emptyOf(const View& view, std::span<const std::size_t> bands) const;
  void drawBand(const View& view, std::size_t band, bool surfacesOnly);

  CpuMeshCache& meshes_;
  PosedMeshes& poses_;
  MeshPaints& paints_;
  BandMemory& bands_;
  PictureSetup setup_;
  std::vector<const DrawItem*> seen_;  ///< objects that the view sees, opaque ones first
  std::vector<float> work_;            ///< by object: its work
  std::uint64_t triangles_ = 0;        ///< triangles of the object whose work was computed last
  std::size_t opaque_ = 0;
  float all_ = 0;  ///< the work of all of them
  std::vector<Piece> pieces_;
  std::vector<std::size_t> wanted_;  ///< numbers of the pieces that the probe asks for
  std::vector<NodeRef> owners_;
  std::vector<NodeShare> shares_;
  std::vector<std::size_t> touched_;  ///< bands
  double emptyRowMs_ = 0;             ///< cost of a row without objects and without the sky
  std::size_t turn_ = 0;              ///< bands that were drawn empty last
  double emptySetUpMs_ = 0;           ///< cost of setting up no object
  std::vector<std::uint8_t> rgba_;
};

}  // namespace stadion
