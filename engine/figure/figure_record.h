#pragma once
/// What a figure plays, as App publishes it: the pose follows from it and from the mesh's skeleton alone.
///
/// Plain, of fixed width, without pointers.

#include <array>
#include <cstdint>
#include <type_traits>

namespace stadion {

/// A clip at a time of it. The first layer is blended over the pose at rest, each further one over those before
/// it. An added one adds its clip's difference to that clip's beginning.
struct ClipLayer {
  std::uint32_t clip = 0;  ///< into Skeleton::clips
  float weight = 1;        ///< 0: nothing of it; 1: nothing of those before it, or all of the difference
  double time = 0;         ///< of the clip [s]

  bool operator==(const ClipLayer&) const = default;
};

struct FigureRecord {
  static constexpr std::size_t kMostLayers = 4, kMostAdded = 4;

  std::uint32_t layerCount = 0;  ///< 0: at rest
  std::uint32_t addedCount = 0;
  std::uint32_t root = 0;  ///< 1 + the bone whose way along the ground moves the node; 0: none
  std::uint32_t unused = 0;
  std::array<ClipLayer, kMostLayers> layers{};
  std::array<ClipLayer, kMostAdded> added{};  ///< on top of the layers

  bool operator==(const FigureRecord&) const = default;
};
static_assert(std::is_trivially_copyable_v<FigureRecord> && sizeof(FigureRecord) == 144);

/// The most figures of a show at a time. Also the mask of a figure's number in InstanceRecord::flags, so it
/// must be 2^n - 1.
constexpr std::size_t kMostFigures = 4095;
static_assert((kMostFigures & (kMostFigures + 1)) == 0);

}  // namespace stadion
