#pragma once
/// A scene's state on its way from one host to another, in parts.
///
/// Threads  plain values; the caller locks.

#include "engine/base/time_signature.h"
#include "pipeline/cluster/bus.h"
#include "pipeline/loop/frame_orders.h"

#include <cstdint>
#include <vector>

namespace stadion::cluster {

/// A scene's state between two frames, from which another program can continue.
struct SavedScene {
  std::uint64_t files = 0;          ///< Scene::files()
  std::vector<std::uint8_t> bytes;  ///< SceneSnapshot::save()
};

struct SceneTransfer {
  std::uint64_t to = 0;                   ///< an incarnation, or the leader's session
  std::uint64_t session = 0, serial = 0;  ///< the state is the scene after that order
  std::uint64_t frame = 0;                ///< simulated last
  Nanoseconds time = 0;                   ///< time of frame `frame`
  Standstill still{};                     ///< whether the show stood then
  Presentation presentation{};            ///< how that frame was shown
  SavedScene scene;
};

/// A scene that a host keeps ready while it plays no show, so that a crashed leader does not lose it.
/// `transfer` names its session and its last order.
struct ResumableScene {
  SceneTransfer transfer;
  std::uint64_t show = 0;         ///< CompatibilityKey::show() of that session
  std::uint64_t framesShown = 0;  ///< Follower::framesShown_ then
};

/// May take long, because the scene is large.
void send(Bus& bus, const SceneTransfer& transfer);

/// A scene that is being received.
class IncomingScene {
public:
  /// Adds the next part. Ignores a part that does not follow the previous one or belongs to another scene.
  void add(const StatePart& part);
  bool complete() const { return complete_; }
  std::uint64_t received() const { return received_; }  ///< [byte]
  /// Returns a scene only if it is complete. Afterwards there is none.
  SceneTransfer take();
  std::uint64_t session() const { return transfer_.session; }
  std::uint64_t serial() const { return transfer_.serial; }

private:
  SceneTransfer transfer_;
  std::uint64_t size_ = 0, received_ = 0;  ///< [byte]
  bool complete_ = false;
};

}  // namespace stadion::cluster
