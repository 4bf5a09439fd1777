#pragma once
/// The colour table of a projector, as the warp's kernels take it.
///
/// Order    light is shared and encoded first, with the curve that the wall file states for the display; then the
///          table maps these values. So the table sees what the projector would get without it.
/// Method   linear between entries of a curve. In a solid, the cube around a colour is cut into six tetrahedra along
///          its grey diagonal, and the colour is a mean of the corners of its tetrahedron.
/// Ownership  copies the table.
/// Threads    constant after it was made; then any.
/// Sources  Kasson, Nin, Plouffe, Hafner, "Performing color space conversions with three-dimensional linear
///          interpolation" (1995).

#include "engine/colour_table/colour_table.h"
#include "engine/display/projector.h"
#include "pipeline/projection/warp_kernel.h"

#include <vector>

namespace stadion {

class ProjectorTable {
public:
  /// Expects a table that is not empty.
  ProjectorTable(const ColourTable& table, const ProjectorLight& light);
  ProjectorTable(const ProjectorTable&) = delete;
  ProjectorTable& operator=(const ProjectorTable&) = delete;

  const WarpTable& forKernels() const { return table_; }

private:
  std::vector<float> encoded_;  ///< (3 x (kWarpSteps + 1))
  std::vector<float> curve_, solid_;
  WarpTable table_;
};

}  // namespace stadion
