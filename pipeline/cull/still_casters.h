#pragma once
/// The objects that stand still and cast shadows into a ring of the shadow maps.
///
/// They follow from the place of the ring and from the objects that stand still. So they are found once for
/// all walls. They are found again only after the ring has followed the head, or after an object has
/// appeared, gone or begun to move. In the other frames, a hundred thousand still objects cost nothing.
///
/// Threads  any, at once. The first call finds them while the others wait. A result never changes.

#include "pipeline/draw_list/draw_list.h"
#include "pipeline/state/scene_state.h"

#include <memory>
#include <mutex>

namespace stadion {

/// A ring across the light.
struct RingPlace {
  std::size_t ring = 0;
  Mat3 axes = Mat3::Identity();  ///< rows: right, up, towards the light, in World
  Vec3 centre_L = Vec3::Zero();  ///< along the axes [m]
  Vec3 centre_W = Vec3::Zero();  ///< `centre_L` in World [m]

  bool operator==(const RingPlace& o) const {
    return ring == o.ring && axes == o.axes && centre_L == o.centre_L;
  }
  /// Returns true if the thing casts a shadow into the ring that can be seen. `p`: its middle from the
  /// ring's, along the axes.
  bool isReachedBy(const InstanceRecord& r, const Vec3& p) const;
  /// Returns the item that draws the instance into the ring.
  DrawItem itemOf(const InstanceRecord& r) const;
};

/// Returns true if the instance casts shadows.
bool casts(const InstanceRecord& r);
/// Returns a number in which every bit of x changes about half of the bits (a hash finaliser).
std::uint64_t mixedBits(std::uint64_t x);
/// Returns a hash of the mesh, its level and its place.
std::uint64_t keyOf(const DrawItem& item);

struct RingCasters {
  std::shared_ptr<const std::vector<DrawItem>> items;
  std::uint64_t key = 0;  ///< sum of the items' keys
};

class StillCasters {
public:
  RingCasters at(const RingPlace& place, const SlotView& state);

private:
  struct Known {
    RingPlace place;
    std::uint64_t version = 0;
    RingCasters casters;
  };
  /// Number of places that are kept for each ring, the newest first. While walls are at different frames, two
  /// are asked for in turn.
  static constexpr std::size_t kKept = 2;

  std::mutex mutex_;
  std::array<std::array<Known, kKept>, kShadowRings> known_;
};

}  // namespace stadion
