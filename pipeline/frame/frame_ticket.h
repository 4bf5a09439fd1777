#pragma once
/// What travels with a frame from App through its slot and its draw lists to the swap.
///
/// Threads  a plain value; each stage has its own copy.

#include "engine/base/time_signature.h"
#include "pipeline/frame/presentation.h"

#include <chrono>

namespace stadion {

struct FrameTicket {
  TimeSignature signature;
  std::chrono::steady_clock::time_point began{};  ///< when App began it, and sampled the poses
  bool drawn = true;  ///< false: nobody looks at it, so it is neither culled nor drawn
  Presentation shown{};
  bool last = false;  ///< no frame follows it
  /// When the head's pose was measured that its pictures are drawn with; where nobody knows, when it was
  /// sampled.
  std::chrono::steady_clock::time_point posed{};

  /// Nothing could be drawn for so long, and it counts as begun so much later.
  void delay(std::chrono::steady_clock::duration by) { began += by, posed += by; }
};

}  // namespace stadion
