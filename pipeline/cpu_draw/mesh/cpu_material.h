#pragma once
/// Describes a mesh's material to the kernels, with the values that the uniform blocks of the OpenGL programs
/// have.

#include "engine/asset/mesh.h"
#include "pipeline/cpu_draw/kernels/kernel_data.h"
#include "pipeline/shader/look.h"
#include "pipeline/shader/uniform_blocks.h"

namespace stadion {

/// Writes how a map reads its texture, whose texels `to` has.
void setUse(const MaterialMap& map, TextureParameters& to);
/// Without textures.
MaterialParameters materialParameters(const Material& material, Look look);
/// `maps`: shiny surfaces mirror the maps; else the harmonics. Points to the texels of `light`.
EnvironmentParameters environmentParameters(const EnvironmentRecord& record, const EnvironmentLight& light,
                                            bool maps);
SceneParameters sceneParameters(const SceneBlock& block);

}  // namespace stadion
