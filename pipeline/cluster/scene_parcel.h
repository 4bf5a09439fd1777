#pragma once
/// A scene's state on its way from one machine to another, in parts.
///
/// Threads  plain values; the caller locks.

#include "engine/base/time_signature.h"
#include "pipeline/cluster/bus.h"
#include "pipeline/loop/frame_orders.h"

#include <cstdint>
#include <vector>

namespace stadion::cluster {

/// A scene between two frames, as it can be taken over.
struct SavedScene {
  std::uint64_t files = 0;          ///< Scene::files()
  std::vector<std::uint8_t> bytes;  ///< SceneSnapshot::save()
};

struct SceneParcel {
  std::uint64_t to = 0;                   ///< an incarnation, or the session of who leads
  std::uint64_t session = 0, serial = 0;  ///< it is the scene after that order
  std::uint64_t frame = 0;                ///< simulated last
  Nanoseconds time = 0;                   ///< of that
  Standstill still{};                     ///< whether the show stood then
  Presentation shown{};                   ///< how that frame was shown
  SavedScene scene;
};

/// One that a machine holds ready while it has no show, lest it be lost with who leads. `parcel` says after
/// which order of which session it is.
struct KeptScene {
  SceneParcel parcel;
  std::uint64_t show = 0;         ///< Agreement::show() of that session
  std::uint64_t framesShown = 0;  ///< Follower::framesShown_ then
};

/// May take long: it is large.
void send(Bus& bus, const SceneParcel& parcel);

/// One that is received.
class IncomingScene {
public:
  /// The next part; what does not follow the one before, or is of another scene, is passed over.
  void add(const StatePart& part);
  bool complete() const { return complete_; }
  std::uint64_t received() const { return received_; }  ///< [byte]
  /// Only what has come whole. Afterwards there is none.
  SceneParcel take();
  std::uint64_t session() const { return parcel_.session; }
  std::uint64_t serial() const { return parcel_.serial; }

private:
  SceneParcel parcel_;
  std::uint64_t size_ = 0, received_ = 0;  ///< [byte]
  bool complete_ = false;
};

}  // namespace stadion::cluster
