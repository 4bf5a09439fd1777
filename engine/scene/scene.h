#pragma once
/// The scene of a show: all loaded files and their nodes, advanced frame by frame.
///
/// The scene consists of parts, each a class of its own, and has no other logic than their order in a frame:
///
///     tree         the loaded files and their nodes; names
///     requests     loads and unloads that are pending
///     schedule     which nodes are visited in a frame, in what order
///     placements   where nodes are; pose tracks: how they moved within the frame
///     degradation  what nodes must do without to save time
///     feed         rig, head and trackers as nodes see them
///     instances    what is drawn; figures, paints, lights, sounds
///     publisher    hands the changes of a frame to the later stages
///     impacts      what dynamics found out about touches
///     hashes       the nodes' part of the state hash
///
/// A node gets the scene with its FrameContext and uses the parts. Half of the public functions give access
/// to them, so there are more than 30. SceneSnapshot saves and restores a scene.
///
/// Ownership  owns its parts and all installed nodes; borrows the loader and the meshes.
/// Threads    App only. While nodes compute side by side, nothing else is in here.
/// Errors     those of a show's files go to the loader; lookups of nodes that are not loaded return null.

#include "engine/base/worker_pool.h"
#include "engine/published/paint_table.h"
#include "engine/scene/degradation.h"
#include "engine/scene/figure_records.h"
#include "engine/scene/impact_watch.h"
#include "engine/scene/input_feed.h"
#include "engine/scene/instances.h"
#include "engine/scene/lights.h"
#include "engine/scene/load_requests.h"
#include "engine/scene/node_hashes.h"
#include "engine/scene/node_schedule.h"
#include "engine/scene/publisher.h"
#include "engine/scene/scene_tree.h"
#include "engine/scene/sound_sources.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stadion {

/// Counts of the last frame.
struct FrameCounters {
  std::uint64_t nodesVisited = 0;
  std::uint64_t changesPublished = 0;  ///< instance records
  std::uint64_t messagesDelivered = 0;
  std::uint64_t messagesLost = 0;  ///< messages whose target is not loaded
};

/// Something that happened in a frame, for observers of a run.
struct EventRecord {
  NodeRef node;
  Event event;
  Nanoseconds when;
  std::optional<double> value{};  ///< for a measurement: the distance [m]
};

class Scene : private SceneTree::Host {
public:
  /// `threads` share the work of nodes that simulate side by side; their number changes no result.
  Scene(SceneLoader& loader, MeshStore& meshes, std::size_t threads = 1);
  ~Scene() override;

  // For the frame loop.

  /// Loads the show's own file and what it loads at its start. Call it before the first frame.
  bool open(const std::string& file);
  /// Runs one frame of the application phase. Fills `changes` with what the later stages must know.
  void advance(const TimeSignature& now, const InputSample& input, ChangeSet& changes, FrameProbe* probe);
  /// Fills `changes` with the scene after frame `now`, and moves nothing. A restored scene is shown by it
  /// before it goes on.
  void publishAsItStands(const TimeSignature& now, ChangeSet& changes);
  /// Sets only the viewer and the shadow rings: the visitor looks around while the show is paused. The state
  /// does not change.
  void updateViewer(const InputSample& input, ChangeSet& changes) const {
    publisher_.updateViewer(input, changes);
  }
  /// Fills `out` with what is heard at the end of the last frame.
  void collectSounds(const InputSample& input, SoundScape& out) const;
  /// Posts a command from outside the show; it is delivered in the next frame. False if the target is
  /// unknown.
  bool command(const std::string& target, CommandId command, std::vector<std::string> arguments,
               Nanoseconds when);
  /// Hash of the scene after the last frame. It covers:
  ///   - of each node, the fields on which its future depends. `dynamics` and `collision` nodes add what
  ///     their bodies, colliders and fields do not: switch, pairs, grips, free places, recoveries
  ///   - show time, the free rig, the numbers of the loaded files
  ///   - pending messages, alarms, loads and unloads; the degradation of nodes
  /// It does not cover parameters that never change, unhashed() fields (state_fields.h), stress, and the
  /// rest of a world: predicted events, search structures, the solver's memory. SceneSnapshot::digest()
  /// covers the part of these that a snapshot saves.
  std::uint64_t stateHash() const;
  const FrameCounters& counters() const { return counters_; }
  const std::vector<EventRecord>& events() const { return events_; }  ///< events of the last frame, by time

  // Parts.

  SceneTree& tree() { return tree_; }
  const SceneTree& tree() const { return tree_; }
  NodeSchedule& schedule() { return schedule_; }
  Placements& placements() { return placements_; }
  const Placements& placements() const { return placements_; }
  PoseTracks& poseTracks() { return poseTracks_; }
  const Degradation& degradation() const { return degradation_; }
  InputFeed& feed() { return feed_; }
  const InputFeed& feed() const { return feed_; }
  Instances& instances() { return instances_; }
  const Instances& instances() const { return instances_; }
  FigureRecords& figures() { return figures_; }
  PaintTable& paints() { return paints_; }
  Lights& lights() { return lights_; }
  const Lights& lights() const { return lights_; }
  SoundSources& sounds() { return sounds_; }
  ImpactWatch& impacts() { return impacts_; }
  const ImpactWatch& impacts() const { return impacts_; }
  const LoadRequests& requests() const { return requests_; }

  // For nodes.

  /// The node, or null if it is not loaded. A static object becomes a node (see SceneTree).
  Node* find(NodeRef ref) { return tree_.find(ref); }
  /// Show time at the end of this frame; while a load enters, the exact time of its entry.
  Nanoseconds now() const { return time_.now; }
  Nanoseconds frameStart() const { return time_.start; }
  /// Sends the message of a notification; it arrives at `when` plus the notification's delay.
  void post(const Node& sender, const Notification& n, Nanoseconds when);
  /// Reports an event to the run's output. No node receives it.
  void note(NodeRef node, Event event, Nanoseconds when, std::optional<double> value = {});
  /// Tells the author what the show did about a node, with its name and where it is declared.
  void warn(const Node& about, const std::string& what);
  /// Says that a node's state changed outside its own cycle.
  void markChanged(Node& node) { hashes_.markChanged(node); }
  void moveRig(const Pose& X_WR);
  /// Asks for a sub-scene. It is installed at show time `at` (see LoadRequests). Returns its number.
  std::uint32_t requestLoad(const std::string& file, NodeRef owner, Nanoseconds at);
  /// Asks that the sub-scene leaves at show time `at`.
  void requestUnload(std::uint32_t number, Nanoseconds at);

private:
  friend class SceneSnapshot;

  /// A node that leaves its tracker in this frame and rejoins its parent from where that is then.
  struct Detached {
    NodeRef node;
    Nanoseconds when;
    PlacementId parent;
    Pose X_WP;  ///< at the frame's start
  };
  /// A node's cycle that is under way.
  struct Cycle {
    Node* node;
    Degradation::Turn turn;
    FrameContext context(const FrameContext& frame) const {
      return {turn.now, frame.input, frame.scene, turn.rested, frame.probe};
    }
  };

  // SceneTree::Host
  void leftChunk(ChunkId chunk, std::uint32_t index) override { publisher_.hideStatic(chunk, index); }
  void promoted(Node& node, const Affine& X_WN) override;

  void applyLoads(const TimeSignature& now, FrameProbe* probe);
  void applyUnloads(const TimeSignature& now, FrameProbe* probe);
  void install(std::unique_ptr<LoadedScene> load, Nanoseconds at);
  void remove(std::uint32_t number, std::uint64_t frame);
  void enterNode(Node& node);
  void leaveNode(Node& node);
  void visit(const TimeSignature& now, const InputSample& input, FrameProbe* probe);
  std::vector<Message> callRound(const TimeSignature& now);
  bool takeBatch(const std::vector<Message>& mail, FrameContext& frame, FrameProbe* probe);
  void computeTogether(FrameProbe* probe);
  void conclude(const Cycle& cycle, FrameContext& frame, FrameProbe* probe);
  std::vector<Detached> detachedBy(const std::vector<Message>& mail, const FrameContext& frame);
  void rejoinParent(const Detached& d, const FrameContext& frame);
  void publish(const TimeSignature& now, const InputSample& input, ChangeSet& changes);
  Message addressed(const std::string& target, NodeRef from, std::vector<std::string> arguments) const;

  SceneLoader& loader_;
  SceneTime time_;
  Placements placements_;
  PoseTracks poseTracks_;
  SceneTree tree_;
  LoadRequests requests_;
  Instances instances_;
  FigureRecords figures_;
  PaintTable paints_;
  Lights lights_;
  SoundSources sounds_;
  InputFeed feed_;
  Degradation degradation_;
  NodeSchedule schedule_;
  ImpactWatch impacts_;
  Publisher publisher_;
  NodeHashes hashes_;
  MessageQueue messages_;
  WorkerPool workers_;
  std::vector<Cycle> batch_;  ///< nodes whose cycles run side by side
  FrameCounters counters_;
  std::vector<EventRecord> events_;
};

}  // namespace stadion
