#pragma once
/// The sounds of a frame. App publishes them beside the records of what is seen.
///
/// Frames   World [m].
/// Units    show time in nanoseconds.
/// Threads  plain values.

#include "engine/base/time_signature.h"
#include "engine/core/message.h"
#include "engine/maths/maths.h"

#include <string>
#include <vector>

namespace stadion {

/// A sound that plays.
struct SoundRecord {
  NodeRef node;      ///< the sound node
  std::string file;  ///< below the asset roots
  Vec3 position = Vec3::Zero();
  double gain = 1;   ///< from 0 to 1
  double range = 0;  ///< how far it is heard [m]; 0: everywhere alike, from no direction
  bool loop = false;
  Nanoseconds since = 0;  ///< start time; a new start time is a new start
};

/// All sounds that play, and where they are heard.
struct SoundScape {
  Nanoseconds time = 0;
  Pose X_WH;  ///< the head
  Pose X_WR;  ///< the rig, in which loudspeakers stand
  std::vector<SoundRecord> sounds;
};

}  // namespace stadion
