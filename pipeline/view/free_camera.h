#pragma once
/// A camera apart from the visitor's eyes: it looks at the room, its walls and the visitor from outside, and
/// changes nothing of the show.
///
/// Frames   rig space, so that it goes along with the visitor's platform.
/// Threads  asked on the Cull thread of its view; it may be moved from another thread.

#include "engine/display/wall.h"
#include "engine/published/records.h"

#include <optional>
#include <vector>

namespace stadion {

/// Where it is, and a rectangle in front of it that its picture shows.
struct CameraView {
  Wall screen;
  Vec3 eye = Vec3::Zero();  ///< in R [m]
};

class FreeCamera {
public:
  virtual ~FreeCamera() = default;

  /// Returns nothing while it is off.
  virtual std::optional<CameraView> view() const = 0;
  /// Adds what only it sees.
  virtual void addTo(std::vector<InstanceRecord>& records, const ViewerRecord& viewer) const = 0;
};

}  // namespace stadion
