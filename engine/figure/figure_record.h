#pragma once
/// What a figure plays, as App publishes it: the pose follows from it and from the mesh's skeleton alone.
///
/// Plain, of fixed width, without pointers.

#include <array>
#include <cstdint>
#include <type_traits>

namespace stadion {

/// A clip at a time of it. The first layer is blended over the pose at rest, each further one over those before
/// it.
struct ClipLayer {
  std::uint32_t clip = 0;  ///< into Skeleton::clips
  float weight = 1;        ///< 0: nothing of it, 1: nothing of those before it
  double time = 0;         ///< of the clip [s]

  bool operator==(const ClipLayer&) const = default;
};

struct FigureRecord {
  static constexpr std::size_t kMostLayers = 4;

  std::uint64_t layerCount = 0;  ///< 0: at rest
  std::array<ClipLayer, kMostLayers> layers{};

  bool operator==(const FigureRecord&) const = default;
};
static_assert(std::is_trivially_copyable_v<FigureRecord> && sizeof(FigureRecord) == 72);

/// The most figures of a show at a time. Also the mask of a figure's number in InstanceRecord::flags, so it
/// must be 2^n - 1.
constexpr std::size_t kMostFigures = 4095;
static_assert((kMostFigures & (kMostFigures + 1)) == 0);

}  // namespace stadion
