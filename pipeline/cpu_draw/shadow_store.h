#pragma once
/// Shadow maps of the frames that are being drawn: one set for all walls.
///
/// Rings    A set holds the four rings side by side, two by two, like the texture of the OpenGL renderer.
///          Still objects are drawn once and kept until a ring's `stillKey` changes. When its `movingKey`
///          changes, movers are drawn over a copy, in the part that they cover.
/// Same     A set depends on the keys and lists alone, not on sets that were drawn before it.
/// Threads  any. Walls that draw the same frame get the same set; the first one draws it.

#include "pipeline/cpu_draw/kernels/kernel_data.h"
#include "pipeline/cpu_draw/mesh/list_meshes.h"
#include "pipeline/draw_list/draw_list.h"
#include "pipeline/platform/draw_pool.h"

#include <array>
#include <memory>
#include <mutex>
#include <vector>

namespace stadion {

/// The depths that the light sees, in texels, and their bounds by tiles (ShadowParameters).
class ShadowSet {
public:
  ShadowSet();
  /// For a list with these shadows, whose rings the set holds. Refers to this object.
  ShadowParameters parameters(const DrawShadows& shadows, int taps) const;

private:
  friend class ShadowStore;
  static constexpr std::size_t kTiles = kShadowSide / kShadowTile;
  struct Ring {
    std::uint64_t stillKey = 0, movingKey = 0;
    bool drawn = false;
    std::array<int, 4> moved{};  ///< texels of the ring that movers cover: from x, y to x, y
  };
  bool holds(const DrawShadows& shadows) const;
  void bound(std::size_t ring, const std::array<int, 4>& area);
  void boundColumns(int left, int right, int low, int high, float* least, float* most) const;

  std::vector<float> depths_;
  std::vector<float> bounds_;  ///< least and greatest depth of each tile
  std::array<Ring, kShadowRings> rings_;
};

class ShadowStore {
public:
  explicit ShadowStore(const DrawKernels& kernels) : kernels_(kernels) {}

  /// Expects shadows of a light.
  std::shared_ptr<const ShadowSet> find(const DrawShadows& shadows, const ListMeshes& meshes, DrawPool& pool);

private:
  using Area = std::array<int, 4>;
  struct Still {
    std::uint64_t key = 0;
    bool drawn = false;
    std::vector<float> depths;
  };
  std::shared_ptr<ShadowSet> freeSet();
  void update(ShadowSet& set, const DrawShadows& shadows, const ListMeshes& meshes, DrawPool& pool);
  void updateRing(ShadowSet& set, const DrawShadows& shadows, std::size_t ring, const ListMeshes& meshes,
                  DrawPool& pool);
  const Still& still(const DrawShadows& shadows, std::size_t ring, const ListMeshes& meshes, DrawPool& pool);
  void drawCasters(const DrawShadows& shadows, std::size_t ring, std::span<const DrawItem> casters,
                   const ListMeshes& meshes, DrawPool& pool, float* depths, int stride) const;

  const DrawKernels& kernels_;
  std::mutex mutex_;
  std::vector<std::shared_ptr<ShadowSet>> sets_;
  std::array<Still, kShadowRings> still_;
};

}  // namespace stadion
