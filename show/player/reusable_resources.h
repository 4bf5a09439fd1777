#pragma once
/// What a live show leaves to the next one of the same script on the same walls, so that the next group need
/// not wait for it: models that have been read, and contexts into which they have been uploaded.
///
/// Threads  one show's at a time. The provider of the contexts must outlive it.

#include "pipeline/load/imported_meshes.h"
#include "pipeline/wall/wall_contexts.h"

namespace stadion {

struct ReusableResources {
  ImportedMeshes models;
  WallContexts contexts;  ///< contexts of the walls; they use the models, so they are destroyed first
};

}  // namespace stadion
