#pragma once
/// Where the frame loop reports what it does. Implemented by the profiling floor; absent when nobody asks.
///
/// Threads  each function is called on the thread that does the work.

#include "engine/message.h"
#include "engine/time_signature.h"

#include <cstdint>

namespace stadion {

enum class Stage : std::uint32_t { App, Cull, Draw, Swap };
enum class NodePhase : std::uint32_t { Receive, Simulate, Dispatch };

class FrameProbe {
public:
  virtual ~FrameProbe() = default;
  virtual void stageBegan(Stage, std::uint64_t frame, std::uint32_t wall) = 0;
  virtual void stageEnded(Stage, std::uint64_t frame, std::uint32_t wall) = 0;
  virtual void nodePhaseBegan(NodeRef, NodePhase) = 0;
  virtual void nodePhaseEnded(NodeRef, NodePhase) = 0;
};

}  // namespace stadion
