#pragma once
/// What each node cost App: time in its three phases, and how often it was visited.
///
/// Threads  nodes are timed on whatever threads they run; read when the run is over.

#include "engine/frame_probe.h"

#include <array>
#include <chrono>
#include <map>
#include <mutex>
#include <vector>

namespace stadion {

struct NodeCost {
  NodeRef node;
  std::uint64_t visits = 0;
  std::array<double, 3> ms{};  ///< in all, by NodePhase
  double total() const { return ms[0] + ms[1] + ms[2]; }
};

class NodeTimes final : public FrameProbe {
public:
  void stageBegan(Stage, std::uint64_t, std::uint32_t) override {}
  void stageEnded(Stage, std::uint64_t, std::uint32_t) override {}
  void nodePhaseBegan(NodeRef node, NodePhase phase) override;
  void nodePhaseEnded(NodeRef node, NodePhase phase) override;

  /// The dearest first.
  std::vector<NodeCost> dearest(std::size_t most) const;

private:
  using Clock = std::chrono::steady_clock;
  std::map<NodeRef, NodeCost> costs_;
  std::mutex mutex_;  ///< nodes may compute side by side
  std::map<NodeRef, Clock::time_point> began_;
};

}  // namespace stadion
