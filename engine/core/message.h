#pragma once
/// Delayed messages: how nodes talk, except for the direct calls of dynamics and collision nodes.
///
/// A message is posted while its sender dispatches and delivered at the start of its receiver's next App
/// cycle, in an order that no thread can influence: (due time, sender's load number, sender's position in its
/// file, sequence).

#include "engine/base/time_signature.h"
#include "engine/core/command_id.h"

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

namespace stadion {

/// A node's identity: which load it came with and where it stands in that file. Never used again after the
/// node is unloaded, and equal on every replica.
struct NodeRef {
  std::uint32_t load = 0;  ///< from 1; 0 = no node
  std::uint32_t position = 0;

  bool valid() const { return load != 0; }
  auto operator<=>(const NodeRef&) const = default;
};

struct Message {
  Nanoseconds due = 0;  ///< event time + delay: when the command takes effect [ns]
  NodeRef sender;       ///< invalid = from outside the show (operator)
  std::uint64_t sequence = 0;
  NodeRef target;
  CommandId command{};
  std::vector<std::string> arguments;
  NodeRef node;  ///< node that the first argument names; for verbs that take a node
  /// The rest of a path such as arena/ball. The scene looks up its first part when the message is posted, and
  /// the rest on delivery, because sub-scenes can load or unload in between.
  std::string targetInside{}, nodeInside{};

  template <class Self, class Fields>
  static void fields(Self& m, Fields& f) {
    f("due", m.due), f("sender", m.sender), f("sequence", m.sequence), f("target", m.target);
    f("verb", m.command), f("arguments", m.arguments), f("node", m.node);
    f("inside target", m.targetInside), f("inside node", m.nodeInside);
  }
};

/// Holds messages until they are due. App only.
class MessageQueue {
public:
  void post(Message m);
  /// Takes every message that was posted before this call and is due at `now` or earlier, in delivery order.
  std::vector<Message> takeDue(Nanoseconds now);
  bool empty() const { return heap_.empty(); }
  const std::vector<Message>& pending() const { return heap_; }  ///< in no particular order

  template <class Self, class Fields>
  static void fields(Self& self, Fields& f) {
    f("messages", self.heap_), f("sequence", self.sequence_);
  }

private:
  std::vector<Message> heap_;  ///< earliest on top
  std::uint64_t sequence_ = 0;
};

}  // namespace stadion
