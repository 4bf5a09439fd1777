#pragma once
/// The show's world: every loaded file, its nodes, their messages, and what changed in this frame.
///
/// The scene has no control logic: it visits the nodes that have something to do, in an order that is the
/// same everywhere, and collects what they publish.
///
/// Threads  App only; while nodes compute side by side nobody else is in here.

#include "engine/base/crew.h"
#include "engine/core/load_control.h"
#include "engine/input/input_sample.h"
#include "engine/published/records.h"
#include "engine/published/sound_scape.h"
#include "engine/scene/agenda.h"
#include "engine/scene/courses.h"
#include "engine/scene/impact.h"
#include "engine/scene/load.h"
#include "engine/scene/node.h"
#include "engine/scene/placements.h"

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stadion {

class PlacedNode;

/// Counts of the last frame.
struct FrameCounters {
  std::uint64_t nodesVisited = 0;
  std::uint64_t changesPublished = 0;  ///< instance records
  std::uint64_t messagesDelivered = 0;
  std::uint64_t messagesLost = 0;  ///< addressed to nobody (unloaded, or never there)
};

/// Something that happened, for whoever watches a run.
struct EventRecord {
  NodeRef node;
  Event event;
  Nanoseconds when;
  std::optional<double> figure{};  ///< measured: the distance [m]
};

class Scene {
public:
  /// `threads` share the work of nodes that simulate side by side; their number changes no result.
  Scene(SceneLoader& loader, MeshStore& meshes, std::size_t threads = 1);
  ~Scene();

  /// Loads the show's own file and whatever it loads at its start. Before the first frame.
  bool open(const std::string& file);

  /// One frame of the application phase. Fills `changes` with what the later stages must know.
  void advance(const TimeSignature& now, const InputSample& input, ChangeSet& changes, FrameProbe* probe);
  /// Nothing moves: fills `changes` with what the scene is after frame `now`. For one that has been put back
  /// and is to be seen before it goes on.
  void publishAsItStands(const TimeSignature& now, ChangeSet& changes) { publish(now, lastInput_, changes); }
  /// Sets only the viewer and the shadow rings around the head: while the show is paused, the visitor still
  /// looks around. The scene's state stays as it is.
  void look(const InputSample& input, ChangeSet& changes) const;

  // What nodes use during their cycle.

  Placements& placements() { return placements_; }
  const Placements& placements() const { return placements_; }
  const Mesh* mesh(MeshId id) const { return meshes_.find(id); }

  /// The node, or null if it is not loaded. A static object becomes a node of its own by being asked for.
  Node* find(NodeRef ref);
  /// A name or path as seen from `from`: in its file, then in the files that loaded it; "scene/name" looks
  /// into a sub-scene.
  NodeRef resolve(const std::string& name, NodeRef from) const;
  const Load* load(std::uint32_t number) const;
  /// What the node is placed below: its parent, in a sub-scene at least the scene node; invalid = World.
  NodeRef parentOf(NodeRef ref) const;
  /// Turns every static object below `ref` into a node of its own, so that it can move.
  void promoteBelow(NodeRef ref);
  /// Says that a node's state changed outside its own cycle (direct calls).
  void touch(Node& node) {
    if (std::exchange(node.standing().touched, true)) return;
    touched_.push_back(&node);
  }
  PlacementId placementFor(NodeRef parent, NodeRef child);

  void post(const Node& sender, const Notification& n, Nanoseconds when);
  /// A command from outside the show, to be delivered in the next frame.
  bool command(const std::string& target, Verb verb, std::vector<std::string> arguments, Nanoseconds when);
  void note(NodeRef node, Event event, Nanoseconds when, std::optional<double> figure = {});
  /// Tells the author what the show did about a node, with its name and where it is declared.
  void warn(const Node& about, const std::string& what);
  /// Visits `node` in the frame in which `when` falls.
  void wakeAt(Nanoseconds when, NodeRef node);
  /// Visits `node` in this frame still if its rank has not had its turn, else in the next one.
  void wakeNow(NodeRef node);
  /// Wakes `watcher` whenever the placement moves.
  void watch(PlacementId placement, NodeRef watcher);
  void unwatch(PlacementId placement, NodeRef watcher);
  /// Visits `node` in the frame after a load came, and in the frame in which one goes.
  void watchLoads(NodeRef node) { loadWatchers_.insert(node); }
  void unwatchLoads(NodeRef node) { loadWatchers_.erase(node); }
  /// When the load (or what brought it in) is unloaded, as far as it happens in this frame; else kNever.
  Nanoseconds endOf(std::uint32_t load) const;
  static constexpr Nanoseconds kNever = std::numeric_limits<Nanoseconds>::max();
  /// Wakes `watcher` in the frame in which `body` touches something or comes to its end.
  void watchImpacts(NodeRef body, NodeRef watcher) { impactWatchers_.insert({body, watcher}); }
  void unwatchImpacts(NodeRef body, NodeRef watcher);
  /// Whether anybody would look at impacts, or may begin to in this frame: else nobody needs to note them.
  bool impactsWanted() const { return !impactWatchers_.empty() || startsInFrame_; }
  void noteImpact(const Impact& impact);
  const std::vector<Impact>& impacts() const { return impacts_; }  ///< of this frame, as they were noted
  /// Changes whenever a load comes or goes: names may resolve differently.
  std::uint64_t loadsVersion() const { return loadsVersion_; }

  InstanceId addInstance(PlacementId placement, MeshId mesh, bool drawn, NodeRef owner);
  void setDrawn(InstanceId id, bool drawn);
  void removeInstance(InstanceId id);
  /// What the instance shows from now on; kNoMesh = nothing.
  void setMesh(InstanceId id, MeshId mesh);
  /// Whether such an instance, light or sound is there: of what has been put back.
  bool owns(InstanceId id, NodeRef owner) const {
    return id < instances_.size() && instances_[id].live && instances_[id].owner == owner;
  }
  bool isLight(std::size_t handle, NodeRef node) const {
    return handle < lights_.size() && lights_[handle].live && lights_[handle].node == node;
  }
  bool isSound(std::size_t handle, PlacementId placement) const {
    return handle < sounds_.size() && sounds_[handle].live && sounds_[handle].placement == placement;
  }
  /// A mesh that a node has made itself; to be given back with releaseMesh.
  MeshId addMesh(std::unique_ptr<const Mesh> mesh) { return meshes_.add(std::move(mesh)); }
  void releaseMesh(MeshId mesh);

  std::size_t addLight(PlacementId placement, const LightRecord& local, NodeRef node);
  void setLight(std::size_t handle, const LightRecord& local, bool on);
  void removeLight(std::size_t handle);
  void addSky(NodeRef node, const SkyRecord& sky) { skies_.push_back({node, sky}); }
  void setSky(NodeRef node, const SkyRecord& sky);
  void removeSky(NodeRef node);
  /// Whose sky is seen; invalid: nobody's.
  NodeRef sky() const { return skies_.empty() ? NodeRef{} : skies_.back().node; }

  std::size_t addSound(PlacementId placement);
  void setSound(std::size_t handle, bool on, const SoundRecord& sound);
  void removeSound(std::size_t handle);

  /// What the node has to do without at the moment, because it or something above it costs too much.
  Relief reliefOf(NodeRef node) const;
  /// So many times farther away everything counts at the moment, when levels of detail are chosen.
  double stress() const { return stressOf(stressLevel_); }

  /// Show time at the end of this frame; while a load enters, the exact time at which it does.
  Nanoseconds now() const { return now_; }
  Nanoseconds frameStart() const { return frameStart_; }

  void setRig(NodeRef rig, PlacementId placement, double eyeHeight);
  void dropRig(NodeRef rig);
  Pose rigPose() const;  ///< X_WR
  void moveRig(const Pose& X_WR);
  std::optional<Pose> trackerInWorld(const std::string& tracker, const InputSample& input) const;
  /// Where the tracker has been in World since it was known in this frame, from the frame's start if it was
  /// known before, to the frame's end. Null if it is not valid at the end. Holds until the next call.
  const Course* trackerCourse(const std::string& tracker, const FrameContext& frame);
  /// How placements have moved inside this frame.
  Courses& courses() { return courses_; }
  Pose headInRig(const InputSample& input) const;
  const InputSample& lastInput() const { return lastInput_; }  ///< of the frame before

  /// Asks for a sub-scene; it is installed at show time `at`, whenever the loader finished, unless the loader
  /// delays it (see SceneLoader::takesEffect).
  std::uint32_t requestLoad(const std::string& file, NodeRef owner, Nanoseconds at);
  void requestUnload(std::uint32_t number, Nanoseconds at);
  /// Whether that load has been asked for and has not taken effect yet.
  bool awaits(std::uint32_t number) const;

  // For whoever runs the show.

  std::uint64_t stateHash() const;
  /// All that the show's future depends on, between two frames: whoever puts it back goes on to the same
  /// hashes and the same pictures.
  std::vector<std::uint8_t> save();
  /// A hash of all that save() writes, and of files(). stateHash() is kept up to date from frame to frame
  /// and leaves out what usually follows from the rest, such as the way on which a body will go on; this one
  /// visits every field of every node.
  std::uint64_t digest();
  /// A hash of the scripts and models that were loaded: where files differ, it does.
  std::uint64_t files() const;
  /// Puts back what save() wrote, in a scene in which nothing has been opened, of the same files; `script` is
  /// what open() would be given, which need not be where it was. Waits until they are loaded. Nothing: well.
  /// Else why not, in words: this is no such state, or the files have changed; the scene is of no use then.
  std::optional<std::string> restore(std::span<const std::uint8_t> state, const std::string& script);
  /// Where this scene differs from one that save() has written down elsewhere, after the same frame.
  struct Difference {
    NodeRef node;       ///< whose field it is; not valid: of the scene as a whole
    std::string field;  ///< "velocity"
    std::string here, there;
  };
  /// The first node's that differs, else what else does; nothing: they are alike.
  std::optional<Difference> difference(std::span<const std::uint8_t> there);
  const FrameCounters& counters() const { return counters_; }
  const std::vector<EventRecord>& events() const { return events_; }  ///< of the last frame, by time
  std::size_t loadCount() const { return loads_.size(); }
  /// What is heard at the end of the last frame; refilled.
  void listen(const InputSample& input, SoundScape& out) const;
  void forEachNode(const std::function<void(const Node&)>& f) const;
  void forEachLoad(const std::function<void(const Load&)>& f) const;

private:
  struct Instance {
    const Mesh* form = nullptr;  ///< what `mesh` names; null = nothing
    PlacementId placement = kNoPlacement;
    MeshId mesh = kNoMesh;
    NodeRef owner;
    InstanceId next = kNoInstance;  ///< at the same placement
    bool drawn : 1 = true, live : 1 = false, changed : 1 = false;
    bool transparent : 1 = false, leveled : 1 = false;  ///< its form is, has simplified levels

    template <class Self, class Fields>
    static void fields(Self& i, Fields& f) {
      bool drawn = i.drawn, live = i.live;
      f("placement", i.placement), f("mesh", i.mesh), f("owner", i.owner), f("next", i.next);
      f("drawn", drawn), f("live", live);
      if (f.restores()) i.drawn = drawn, i.live = live;
    }
  };
  static constexpr InstanceId kNoInstance = ~InstanceId{0};
  struct Light {
    PlacementId placement = kNoPlacement;
    LightRecord local;
    NodeRef node;
    bool on = true, live = false;

    template <class Self, class Fields>
    static void fields(Self& l, Fields& f) {  // what it is like its node says
      f("placement", l.placement), f("node", l.node), f("on", l.on), f("live", l.live);
    }
  };
  struct Sky {
    NodeRef node;
    SkyRecord record;

    template <class Self, class Fields>
    static void fields(Self& s, Fields& f) {
      f("node", s.node);
    }
  };
  struct SoundSpot {
    PlacementId placement = kNoPlacement;
    SoundRecord sound;
    bool on = false, live = false;

    template <class Self, class Fields>
    static void fields(Self& s, Fields& f) {
      f("placement", s.placement), f("on", s.on), f("live", s.live);
    }
  };
  struct Rig {
    NodeRef node;
    PlacementId placement = kNoPlacement;
    double eyeHeight = 0;

    template <class Self, class Fields>
    static void fields(Self& r, Fields& f) {
      f("node", r.node), f("placement", r.placement), f("eye height", r.eyeHeight);
    }
  };
  /// What a load was asked for with.
  struct Asked {
    std::string file;
    NodeRef owner;
    Affine X_WO = Affine::Identity();

    template <class Self, class Fields>
    static void fields(Self& a, Fields& f) {
      std::string file = a.owner.valid() ? a.file : "";  // where the show's own is, each machine knows
      f("file", file), f("owner", a.owner), f("place", a.X_WO);
      if (f.restores()) a.file = file;
    }
  };
  struct Change {
    Nanoseconds at = 0;
    std::uint32_t number = 0;
    bool load = false;

    template <class Self, class Fields>
    static void fields(Self& c, Fields& f) {
      f("at", c.at), f("number", c.number), f("load", c.load);
    }
  };
  struct Wake {
    Nanoseconds at = 0;
    NodeRef node;
    auto operator<=>(const Wake&) const = default;

    template <class Self, class Fields>
    static void fields(Self& w, Fields& f) {
      f("at", w.at), f("node", w.node);
    }
  };
  /// A node that leaves its tracker in this frame, to go along with its parent from where that is then.
  struct Detached {
    NodeRef node;
    Nanoseconds when;
    PlacementId parent;
    Pose X_WP;  ///< at the frame's start
  };
  /// A node's cycle that is under way.
  struct Cycle {
    Node* node;
    TimeSignature now;
    bool rested;
    FrameContext context(const FrameContext& frame) const {
      return {now, frame.input, frame.scene, rested, frame.probe};
    }
  };
  void applyLoads(const TimeSignature& now, FrameProbe* probe);
  void foreseeUnloads(Nanoseconds now);
  void applyUnloads(const TimeSignature& now, FrameProbe* probe);
  void install(std::unique_ptr<Load> load, Nanoseconds at);
  void remove(std::uint32_t number, std::uint64_t frame);
  void visit(const TimeSignature& now, const InputSample& input, FrameProbe* probe);
  std::vector<Message> callRound(const TimeSignature& now);
  void settleLevels();
  bool callToRound(NodeRef ref);
  void settleTouched(FrameProbe* probe);
  void computeTogether(std::span<const Cycle> batch, FrameProbe* probe);
  std::vector<Detached> detachedBy(const std::vector<Message>& mail, const FrameContext& frame);
  void rejoinParent(const Detached& d, const FrameContext& frame);
  bool takeBatch(const std::vector<Message>& mail, FrameContext& frame, FrameProbe* probe);
  // Load (scene_relief.cpp).
  void obey(const TimeSignature& now);
  void obey(const LoadDecision& decision);
  void spreadRelief();
  void relieve(NodeRef node, const Relief& before, const Relief& now);
  const NodeTerms* termsOf(NodeRef node) const;
  bool isPutOff(Node& node) const;
  bool putOff(Node& node);
  Cycle cycleOf(Node& node, const TimeSignature& now);
  void hashRelief(StateHash& h) const;
  // The state (scene_state.cpp).
  void visitAll(StateFields& f);
  void visitLoads(StateFields& f);
  void visitLoad(StateFields& f, std::uint32_t number);
  void visitNodes(StateFields& f);
  void visitNode(StateFields& f, Node& node);
  void visitRest(StateFields& f);
  bool standsTogether() const;
  std::optional<std::string> resume();
  void publish(const TimeSignature& now, const InputSample& input, ChangeSet& changes);
  bool hasInstances(PlacementId p) const { return p < instancesAt_.size() && instancesAt_[p] != kNoInstance; }
  bool hasLights(PlacementId p) const { return p < lightsAt_.size() && lightsAt_[p] > 0; }
  void publishAt(PlacementId p, const Affine& X_WN, bool shown, ChangeSet& changes);
  void publishInstance(const Instance& i, InstanceId id, const Affine& X_WN, bool shown, ChangeSet& changes);
  void publishFleet(std::span<const PlacementId> ids, std::span<const MemberPlace> places,
                    ChangeSet& changes);
  void describe(const Instance& i, bool shown, InstanceRecord& r) const;
  InstanceRecord& nextRecord(InstanceId id, ChangeSet& changes);
  void handOn(ChangeSet& changes);
  void publishLights(const InputSample& input, ChangeSet& changes);
  void findLightsThatShine();
  void chooseLights(const Vec3& head_W);
  LightRecord lightInWorld(const Light& light) const;
  void tellOfTooManyLights();
  /// Follows the rest of a path, "arena/ball", from a scene node to what is loaded now.
  NodeRef resolveInside(NodeRef from, std::string_view path) const;
  /// A message with its names looked up as seen from `from`, as far as the first part.
  Message addressed(const std::string& target, NodeRef from, std::vector<std::string> arguments) const;
  void markInstancesAt(PlacementId placement);
  Node* promote(Load& load, std::size_t index, const Affine& moved = Affine::Identity());
  Node& nodeInsteadOf(Load& load, std::size_t index);
  bool isBelow(NodeRef ref, NodeRef ancestor) const;
  void enterNode(Node& node);
  void leaveNode(Node& node);
  void setBusy(Node& node);
  void wakeWatchers();
  void markInstance(InstanceId id);
  void rehash(Node& node);
  std::uint64_t nodeHash(const Node& node) const;

  SceneLoader& loader_;
  MeshStore& meshes_;
  Placements placements_;
  std::map<std::uint32_t, std::unique_ptr<Load>> loads_;
  std::uint32_t nextLoad_ = 1;
  std::vector<Change> pendingLoads_;
  std::string script_;                    ///< the show's own
  std::map<std::uint32_t, Asked> asked_;  ///< by number: of those that are there or will come
  MessageQueue messages_;
  Agenda agenda_;
  std::vector<Cycle> batch_;
  std::optional<Visit> current_;
  std::vector<NodeRef> wokenLate_, wokenBefore_;
  std::map<NodeRef, std::uint32_t> reliefLevels_;  ///< of those that have to do without something
  std::map<NodeRef, Relief> reliefs_;              ///< of them and all below them
  std::uint64_t reliefLoads_ = 0;                  ///< loadsVersion_ when these were found
  std::uint32_t stressLevel_ = 0;
  std::set<NodeRef> putOff_;  ///< were woken, and wait for their turn
  struct Paced {
    Nanoseconds since = 0;  ///< when its last cycle ended
    bool rests = false;

    template <class Self, class Fields>
    static void fields(Self& p, Fields& f) {
      f("since", p.since), f("rests", p.rests);
    }
  };
  std::map<NodeRef, Paced> paced_;  ///< those that must be told what they have missed
  std::multimap<PlacementId, NodeRef> watchers_;
  std::uint64_t loadsVersion_ = 0, loadsTold_ = 0;
  std::uint64_t levelsLoads_ = 0;  ///< loadsVersion_ when levels were found, ...
  bool levelsSettled_ = false;     ///< ... and the nodes that move things were known
  std::set<NodeRef> loadWatchers_;
  void rideAlong(Course& way, Nanoseconds start, Nanoseconds end);
  Courses courses_;
  Course trackerWay_;      ///< trackerCourse()'s answer
  Course rigWay_, riddenWay_;
  InputSample lastInput_;  ///< of the frame before
  Pose rigStart_;          ///< X_WR at this frame's start
  std::set<Wake> wakes_;
  std::uint64_t hashSum_ = 0;
  std::vector<Node*> touched_;

  std::vector<Instance> instances_;
  std::vector<InstanceId> freeInstances_, changedInstances_;
  std::vector<InstanceId> instancesAt_;  ///< by placement: the first of them
  std::vector<Light> lights_;
  std::vector<std::uint32_t> lightsAt_;  ///< how many, by placement
  bool lightsChanged_ = true;
  std::vector<std::size_t> wanted_;   ///< that would shine
  std::vector<std::size_t> chosen_;   ///< of these, at most kMostLights
  std::vector<std::size_t> shining_;  ///< those published last, while more than kMostLights would shine
  std::vector<std::pair<double, std::size_t>> brightest_;
  bool toldOfLights_ = false;
  std::vector<SoundSpot> sounds_;
  std::vector<Sky> skies_;  ///< the last one is seen
  std::size_t chunksShown_ = 0;
  std::vector<Rig> rigs_;  ///< the last one is in use
  Pose freeRig_;           ///< of a show without a rig node
  ShadowPlaces shadowPlaces_;
  std::vector<ChangeSet::Chunk> chunkChanges_;
  std::vector<ChangeSet::StaticItem> staticChanges_;
  Crew crew_;
  FrameCounters counters_;
  std::vector<EventRecord> events_;
  std::multimap<NodeRef, NodeRef> impactWatchers_;  ///< by the body that is watched
  bool startsInFrame_ = false;                      ///< somebody was told to start
  std::vector<Impact> impacts_;
  Nanoseconds now_ = 0;
  Nanoseconds frameStart_ = 0;
  std::uint64_t frame_ = 0;
};

}  // namespace stadion
