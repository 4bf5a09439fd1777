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
SceneParameters sceneParameters(const SceneBlock& block);

}  // namespace stadion
