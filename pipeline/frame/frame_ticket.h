#pragma once
/// A frame's times and flags, which travel with it from App through its slot and its draw lists to the swap.
///
/// Threads  a plain value; each stage has its own copy.

#include "engine/base/time_signature.h"
#include "pipeline/frame/presentation.h"

#include <chrono>

namespace stadion {

struct FrameTicket {
  TimeSignature signature;
  std::chrono::steady_clock::time_point began{};  ///< start of App, which is also when it sampled the poses
  /// False: the walls skip this frame. It is neither culled nor drawn, and the last pictures stay. The swap
  /// still counts it as shown.
  bool drawn = true;
  Presentation presentation{};
  bool last = false;  ///< no frame follows it
  /// The measurement time of the head's pose with which its pictures are drawn. If that is unknown, the time
  /// of sampling.
  std::chrono::steady_clock::time_point posed{};

  /// Drawing was not possible for this long, so the frame counts as begun that much later.
  void delay(std::chrono::steady_clock::duration by) {
    began += by;
    posed += by;
  }
};

}  // namespace stadion
