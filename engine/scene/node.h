#pragma once
/// A node of the show. All node types have the same cycle and the same interface.
///
/// In each frame in which it has something to do, App lets a node run one cycle: it receives its messages,
/// simulates, and dispatches notifications. Nodes that do not look at each other's results simulate side by
/// side; these are mostly dynamics nodes. A node with nothing to do is not visited. The node itself is not
/// drawn: it publishes an instance record through the scene.
///
/// Ownership  the scene owns every installed node.
/// Threads    App only, except compute(): a thread of the worker pool may run it. The loader thread
///            constructs nodes and owns them until they are installed.
/// Errors     resume() returns false if the restored state does not fit; no other function fails.

#include "engine/core/event.h"
#include "engine/core/frame_probe.h"
#include "engine/core/message.h"
#include "engine/core/node_type.h"
#include "engine/core/state_hash.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stadion {

class PlacedNode;
class Scene;
class StateFields;
struct InputSample;

/// The surroundings of a node during its cycle.
struct FrameContext {
  const TimeSignature& now;  ///< the frame advances the show from now.time - now.step to now.time. If
                             ///< the node skipped frames, the step begins at its last cycle
  const InputSample& input;  ///< trackers at now.time
  Scene& scene;
  bool rested = false;          ///< the node rested until this frame's start, and its own time stood still
  FrameProbe* probe = nullptr;  ///< receives the costs; null: they are not measured

  Nanoseconds start() const { return now.time - now.step; }
  /// When a delivered message takes effect: at its due time, but not before this frame's start.
  Nanoseconds effective(const Message& m) const { return m.due > start() ? m.due : start(); }
};

/// The order of nodes within a frame: nodes that place things come before nodes that look at them. Within a
/// rank, a node comes after the movers that it names (Node::addMovers); else the order is (load number,
/// position in file).
enum class Rank : std::uint8_t { Input, Attachment, Motion, Sensing, Dynamics, Contact, Outcome };

/// An `eventmessage` of a node: the message that it posts at an event.
struct Notification {
  Event event{};
  std::string target;  ///< name or path, resolved from the file the node stands in
  CommandId command{};
  std::vector<std::string> arguments;
  Nanoseconds delay = 0;  ///< [ns]
};

class Node {
public:
  /// Expects that the type outlives the node.
  Node(const NodeType& type, NodeRef self, std::string name)
      : type_(&type), self_(self), name_(std::move(name)) {}
  virtual ~Node() = default;
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  const NodeType& type() const { return *type_; }
  NodeKind kind() const { return type_->kind; }
  NodeRef self() const { return self_; }
  const std::string& name() const { return name_; }
  /// The node, if it has a place in the world; else nullptr.
  virtual PlacedNode* placed() { return nullptr; }
  /// The part of the show that a node has missed since its last cycle: nothing, frames that it makes up for,
  /// or also time.
  enum class Missed : std::uint8_t { Nothing, Frames, Time };
  /// The scene's notes about an installed node. Only the scene's parts use them.
  struct ScheduleState {
    std::uint64_t hash = 0;  ///< the node's term of the state hash
    bool busy = false;
    bool touched = false;     ///< the node's state has changed since `hash` was computed
    bool rests = false;       ///< the node does not run, to save time (cost_budget.h)
    std::uint8_t pace = 0;    ///< the node runs in one of 2^pace frames
    std::uint16_t level = 0;  ///< within its rank: a node comes after those that it looks at
    Missed missed{};
  };
  ScheduleState& scheduleState() { return scheduleState_; }
  const ScheduleState& scheduleState() const { return scheduleState_; }
  void addNotification(Notification n) { notifications_.push_back(std::move(n)); }

  /// Enters the scene: resolves names, adds placements and instances. Called once, when the load is
  /// installed: all nodes of the load exist, and the parent has entered.
  void enter(Scene& scene) { onEnter(scene); }
  /// Removes what enter() added. Called once, in reverse order.
  void leave(Scene& scene) { onLeave(scene); }

  // The node cycle, in three parts. Between the first and the last part, other nodes may have theirs.
  /// Receives this frame's messages in delivery order, and simulates as far as that needs the scene.
  void begin(std::span<const Message> inbox, FrameContext& frame, FrameProbe* probe);
  /// Simulates the rest, which touches only this node. App or a thread of the worker pool runs it.
  void compute(FrameProbe* probe);
  /// Reports the results to the scene and dispatches notifications.
  void conclude(FrameContext& frame, FrameProbe* probe);
  /// Raises and dispatches an event of this node that another node has detected.
  void raiseNow(Event event, Nanoseconds when, FrameContext& frame) {
    raise(event, when);
    dispatch(frame);
  }
  /// Returns true if the node may look at what `earlier` reports in this frame, and so can begin only after
  /// it.
  virtual bool awaits(const Node& earlier, const Scene& scene) const;

  /// Adds the nodes of the same rank that move what this node looks at.
  virtual void addMovers(const Scene&, std::vector<NodeRef>& /*movers*/) const {}

  virtual Rank rank() const { return Rank::Motion; }
  /// Returns true if the node must be visited in the next frame even if no message arrives.
  virtual bool busy() const { return false; }
  /// Adds every field that the show's future depends on, unless another node adds it or it follows from such
  /// fields.
  virtual void hash(StateHash&) const {}
  /// Visits the same fields and all others to be saved, compared or restored (state_fields.h). For a
  /// restored node, resume() is called instead of enter().
  virtual void state(StateFields&) {}
  /// Maps a part number (StateFields::about()) to its node: the bodies of a dynamics node are nodes
  /// themselves.
  virtual NodeRef nodeOf(std::uint32_t /*part*/) const { return self_; }
  /// Called after the node's fields and the scene were restored. The node computes the members that are not
  /// saved. Returns false if the saved state does not fit.
  virtual bool resume(Scene&) { return true; }

protected:
  /// Notes an event; its messages are sent when the node dispatches. A value, such as a distance [m], is for
  /// reports.
  void raise(Event event, Nanoseconds when, std::optional<double> value = {}) {
    raised_.push_back({event, when, value});
  }

private:
  struct Raised {
    Event event;
    Nanoseconds when;
    std::optional<double> value;
  };

  virtual void onEnter(Scene&) {}
  virtual void onLeave(Scene&) {}
  virtual void receive(const Message&, FrameContext&) {}
  virtual void simulate(FrameContext&) {}
  virtual void simulateApart() {}  ///< on any thread
  virtual void afterSimulation(FrameContext&) {}

  void dispatch(FrameContext& frame);

  const NodeType* type_;
  NodeRef self_;
  ScheduleState scheduleState_;
  std::string name_;
  std::vector<Notification> notifications_;
  std::vector<Raised> raised_;
};

}  // namespace stadion
