#pragma once
/// What a wall draws before its first frame, so that no frame has to compile shaders or upload meshes.
///
/// Threads  free functions, any thread.

#include "pipeline/draw_list/draw_list.h"

#include <span>

namespace stadion {

/// A complete list, and one of each mesh in the store that it does not show: those are drawn in front of the
/// viewer at their coarsest level. One more of each that scripts make transparent (`fading`) has such a paint.
DrawList warmUpList(const DrawList& first, const MeshStore& meshes, std::span<const MeshId> fading = {});

}  // namespace stadion
