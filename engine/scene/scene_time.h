#pragma once
/// Where the show is in time, for the parts of the scene.
///
/// Threads  App only; the Scene writes it, its parts read it.

#include "engine/base/time_signature.h"

#include <cstdint>

namespace stadion {

struct SceneTime {
  std::uint64_t frame = 0;  ///< number of this frame
  Nanoseconds now = 0;    ///< show time at the frame's end; while a load enters, the exact time of its entry
  Nanoseconds start = 0;  ///< show time at the frame's start
};

}  // namespace stadion
