#pragma once
/// Draws the objects of a view that have transparent parts.
///
/// Order    their opaque parts come with the opaque objects. Their transparent parts are sorted for every
///          sample (glass_layers.h). Below OpenGL 4.3 whole objects are drawn far to near instead, blended and
///          without writing depth.
/// Errors   if the buffers for layers cannot be made, nothing transparent is drawn, and the problem is
///          reported.
/// Threads  the thread on which the context is current.

#include "pipeline/gl_draw/passes/glass_layers.h"
#include "pipeline/gl_draw/passes/surface_drawing.h"

#include <cstdint>
#include <memory>

namespace stadion {

class TransparentPass {
public:
  TransparentPass(const PassContext& with, SurfaceDrawing& surfaces, std::uint32_t mostFragments,
                  ProblemLog& problems);

  /// Draws the opaque parts, after all opaque objects.
  void drawOpaqueParts(std::uint32_t view);
  /// Draws the transparent parts over everything else. `from`: the view's block.
  void draw(const ViewBlock& from, std::uint32_t view);

  /// Returns true if there are buffers for layers: not before the first transparent object is seen.
  bool holdsLayers() const { return layers_ != nullptr; }

private:
  template <class Draw>
  void forEachCall(std::uint32_t view, bool oneByOne, const Draw& draw);
  void drawSorted(std::uint32_t view);
  void drawBackToFront(const MeshParts& mesh, std::uint32_t first, std::uint32_t count);
  bool findCovered(const ViewBlock& from, std::uint32_t view);
  bool makeLayers();
  void drawLayers(std::uint32_t view);
  void drawIntoLayers(const MeshParts& mesh, std::uint32_t first, std::uint32_t count);

  const PassContext& with_;
  SurfaceDrawing& surfaces_;
  std::uint32_t mostFragments_;
  ProblemLog& problems_;
  bool layered_;                         ///< sorted for every sample
  std::unique_ptr<GlassLayers> layers_;  ///< from the first transparent object on
  CoveredAreas covered_;                 ///< parts of the current view's picture
  std::uint32_t triangles_ = 0;  ///< number of triangles drawn in the current view before the next call
};

}  // namespace stadion
