#pragma once
/// A texture with its mipmaps, in the layout that the kernels read.
///
/// Colours   in the full look square roots of linear light: means of them are near to means of light, and
///           eight bits suffice. In the plain look as stored.
/// Threads   immutable after construction.

#include "engine/asset/mesh.h"
#include "pipeline/cpu_draw/kernels/kernel_data.h"
#include "pipeline/shader/look.h"

#include <vector>

namespace stadion {

class CpuTexture {
public:
  /// `alphaCutoff`: below this alpha the texture leaves holes; 0 = it leaves none.
  CpuTexture(const Texture& texture, float alphaCutoff, Look look);

  /// Refers to this object.
  TextureParameters parameters() const;

private:
  struct Linear;
  void addLevel(const Linear& level, Look look);
  void addHalves(Linear level, Look look);

  struct Level {
    std::uint32_t width, height;
    std::size_t first;
  };
  std::vector<std::uint32_t> texels_;
  std::vector<Level> levels_;
};

}  // namespace stadion
