#pragma once
/// The part of the state hash that covers nodes. Only nodes whose state changed are hashed again.
///
/// The hash is a sum with one term a node. A changed term replaces the old one. Each term contains the node's
/// load number and position, so exchanged states do not cancel out.
///
/// Ownership  borrows the nodes that are touched, until rehash() or forget().
/// Threads    App only.
/// Errors     none.

#include "engine/core/frame_probe.h"
#include "engine/scene/node.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace stadion {

class NodeHashes {
public:
  /// Marks a node whose state changed outside its own cycle; rehash() hashes it again.
  void markChanged(Node& node) {
    if (std::exchange(node.scheduleState().touched, true)) return;
    touched_.push_back(&node);
  }
  /// Hashes the node again.
  void update(Node& node) {
    const std::uint64_t now = hashOf(node);
    sum_ += now - std::exchange(node.scheduleState().hash, now);
    node.scheduleState().touched = false;
  }
  /// Takes the node out of the sum.
  void remove(Node& node) { sum_ -= std::exchange(node.scheduleState().hash, 0); }
  /// Drops the marks of a load's nodes. Call it before they are destroyed.
  void forget(std::uint32_t load) {
    std::erase_if(touched_, [&](const Node* node) { return node->self().load == load; });
  }
  /// Hashes all marked nodes again.
  void rehash(FrameProbe* probe) {
    for (Node* node : touched_) {
      if (!node->scheduleState().touched) continue;  // its own cycle came after the touch
      const SpanScope span(probe, Span::Settle, node->self());
      update(*node);
    }
    touched_.clear();
  }
  std::uint64_t sum() const { return sum_; }

private:
  static std::uint64_t hashOf(const Node& node) {
    StateHash h((std::uint64_t{node.self().load} << 32) | node.self().position);
    node.hash(h);
    return h.value();
  }

  std::uint64_t sum_ = 0;
  std::vector<Node*> touched_;
};

}  // namespace stadion
