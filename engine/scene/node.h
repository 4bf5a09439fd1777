#pragma once
/// A node of the show: identically structured and interfaced, whatever it does.
///
/// In each frame in which it has something to do a node runs one cycle of the application phase: it receives
/// its messages, simulates, and dispatches notifications. Nodes that do not look at each other's results
/// (dynamics nodes, mostly) simulate side by side. A node with nothing to do is not visited at all.
/// What is drawn is not the node but an instance record that it publishes through the scene.
///
/// Threads  App only. Nodes are constructed on the loader thread and belong to it until they are installed.
/// Ownership  the Scene owns every installed node.

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

/// What a node may look at during its cycle.
struct FrameContext {
  const TimeSignature& now;  ///< the frame advances the show from now.time - now.step to now.time; of
                             ///< nodes that run more seldom the step is that since their last cycle
  const InputSample& input;  ///< trackers at now.time
  Scene& scene;
  bool rested = false;  ///< it was kept from running up to this frame's start: its own time stood still
  FrameProbe* probe = nullptr;  ///< who counts, if anybody does

  Nanoseconds start() const { return now.time - now.step; }
  /// When a delivered message takes effect: at its due time, but not before this frame's start.
  Nanoseconds effective(const Message& m) const { return m.due > start() ? m.due : start(); }
};

/// In which order nodes run within a frame: what places things comes before what looks at them. Within a
/// rank, nodes come after those whose movers they name (Node::addMovers), else the order is (load number,
/// position in file).
enum class Rank : std::uint8_t { Input, Attachment, Motion, Sensing, Dynamics, Contact, Outcome };

/// One `eventmessage` of a node: what it posts when something happens to it.
struct Notification {
  Event event{};
  std::string target;  ///< name or path, resolved from the file the node stands in
  Verb verb{};
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
  /// What it has missed since its last cycle: nothing, frames that it makes up for, or time as well.
  enum class Missed : std::uint8_t { Nothing, Frames, Time };
  /// What the scene notes of a node that is in it. The scene's own.
  struct Standing {
    std::uint64_t hash = 0;  ///< its part of the state hash
    bool busy = false;
    bool touched = false;     ///< its state has changed since then
    bool rests = false;       ///< it does not run, to save time (load_control.h), or
    std::uint8_t pace = 0;    ///< only in one of 2^pace frames
    std::uint16_t level = 0;  ///< within its rank: it comes after those that it looks at
    Missed missed{};
  };
  Standing& standing() { return standing_; }
  const Standing& standing() const { return standing_; }
  void addNotification(Notification n) { notifications_.push_back(std::move(n)); }

  /// Takes its place in the scene: names resolve, placements and instances are made. Once, when its load is
  /// installed, after every node of the load exists and after its parent's enter().
  void enter(Scene& scene) { onEnter(scene); }
  /// Gives back what enter() took. Once, in reverse order.
  void leave(Scene& scene) { onLeave(scene); }

  // The node cycle, in three parts. Between the first and the last of them other nodes may have theirs.
  /// Receives this frame's messages, in delivery order, and simulates as far as that needs the scene.
  void begin(std::span<const Message> inbox, FrameContext& frame, FrameProbe* probe);
  /// The rest of the simulation, which touches nothing but the node: on any thread.
  void compute(FrameProbe* probe);
  /// Tells the scene what has come of it, and dispatches notifications.
  void conclude(FrameContext& frame, FrameProbe* probe);
  /// Something has happened to it that another node has found out: told at once.
  void tell(Event event, Nanoseconds when, FrameContext& frame) {
    raise(event, when);
    dispatch(frame);
  }
  /// Whether it may look at what `earlier` tells the scene in this frame, and so can begin only after that.
  virtual bool awaits(const Node& earlier, const Scene& scene) const;

  /// Adds the nodes of its rank that move what it looks at.
  virtual void addMovers(const Scene&, std::vector<NodeRef>& /*movers*/) const {}

  virtual Rank rank() const { return Rank::Motion; }
  /// Whether it wants to be visited in the next frame even if no message arrives.
  virtual bool busy() const { return false; }
  /// Adds every field that the show's future depends on.
  virtual void hash(StateHash&) const {}
  /// The same fields and what follows from them, to be written down, compared or put back. A node that is put
  /// back has not entered, and does not: resume() is called instead.
  virtual void state(StateFields&) {}
  /// The node that those of its fields are about which state() visits as a part's (StateFields::about()): the
  /// bodies of a dynamics node are nodes themselves.
  virtual NodeRef nodeOf(std::uint32_t /*part*/) const { return self_; }
  /// Its fields have been put back, and so has the scene: makes anew what is not written down. False: what
  /// was written down does not fit what there is.
  virtual bool resume(Scene&) { return true; }

protected:
  /// Notes that something happened; the messages that tell of it go out when the node dispatches.
  /// A figure, such as a distance [m], is for reports.
  void raise(Event event, Nanoseconds when, std::optional<double> figure = {}) {
    raised_.push_back({event, when, figure});
  }

private:
  struct Raised {
    Event event;
    Nanoseconds when;
    std::optional<double> figure;
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
  Standing standing_;
  std::string name_;
  std::vector<Notification> notifications_;
  std::vector<Raised> raised_;
};

}  // namespace stadion
