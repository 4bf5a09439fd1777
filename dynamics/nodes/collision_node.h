#pragma once
/// `collision`: reports when its colliders and collidees touch. The dynamics node is a collision node that
/// moves its collidees as well.
///
/// The node reads placements and moves bodies by direct calls. It is visited only while one of its parts
/// moves.
///
/// Events    onimpact: once when a separated pair touches; onrelease: once when the pair is farther apart
///           than releasedistance again. Both carry the exact time.
/// Commands  enable, disable, toggle, reset. While the node is off, its bodies stand still.
/// Times     external motion is followed within the frame: the knots of a tracker's path, commands, loads and
///           unloads, each at its exact time.
/// Threads   App; compute() on any thread, with the world of this node only.

#include "dynamics/nodes/shape_store.h"
#include "dynamics/world/world.h"
#include "engine/core/shared_rows.h"
#include "engine/nodes/switch_state.h"

#include <limits>

namespace stadion {

struct CollisionAttributes {
  std::vector<std::string> colliders, collidees;  ///< names as seen from its file
  double releaseDistance = 0.5;                   ///< [m]
  bool selfCollide = true;
  bool on = true;
  std::vector<SharedFit> fits;  ///< fits of colliders in its file: made by the loader, kept for App to find
  std::uint32_t fineness = 1;   ///< as in World::setStepDivider
  ImpactScheme impacts = {};    ///< as in World::setImpactScheme
};

class CollisionNode : public Node {
public:
  CollisionNode(const NodeType& type, NodeRef self, std::string name, CollisionAttributes attributes,
                std::shared_ptr<ShapeStore> shapes);

  /// A node that moves nothing is visited after all bodies have been moved.
  Rank rank() const override { return Rank::Contact; }
  bool busy() const override { return switch_.on() && awake_; }
  void hash(StateHash& h) const override;
  void state(StateFields& f) override;
  NodeRef nodeOf(std::uint32_t part) const override;
  bool resume(Scene& scene) override;
  bool awaits(const Node& earlier, const Scene& scene) const override;
  void addMovers(const Scene& scene, std::vector<NodeRef>& movers) const override;

  /// The world after the last step, for reports.
  const World& world() const { return world_; }
  const ImpactScheme& impacts() const { return attributes_.impacts; }

  struct Overlap {
    std::string a, b;
    double depth;  ///< [m]
  };
  /// Pairs of its parts that stick in each other by more than `deeperThan` [m], in the order of the script.
  /// Only those whose bounds overlap are measured.
  std::vector<Overlap> overlaps(double deeperThan) const;
  /// An object that takes part and is loaded, and how it collides.
  struct Participant {
    NodeRef object;
    const FittedShape* fit;  ///< null if it has no usable triangle
  };
  std::vector<Participant> participants() const;

protected:
  /// An object that takes part.
  struct Part {
    std::string name;
    NodeRef ref;           ///< invalid while it is not loaded
    std::uint32_t id = 0;  ///< id of the part's collider or body in the world
    SharedFit fit;         ///< null if it has no usable triangle
    ShapeId shape = 0;
    PlacementId placement = kNoPlacement;
    Pose pose;        ///< at the end of the last step, where the next one begins; the placement is at its end
    PoseTrack track;  ///< in this frame, if something outside moves it
    ArcTrack arcs;    ///< path of the part in this frame, if a body of another dynamics node carries it
    /// When it leaves, and which node then has its name.
    Nanoseconds leaveAt = std::numeric_limits<Nanoseconds>::max(), nextAt = 0;
    NodeRef next;
    std::optional<Vec3> refit;  ///< for a restored part: the scale at which its fit is found again

    template <class Self, class Fields>
    static void fields(Self& p, Fields& f) {
      if (!f.restores()) p.refit = p.fit ? std::optional(p.fit->scale) : std::nullopt;
      f("ref", p.ref), f("id", p.id), f("fit", p.refit), f("shape", p.shape), f("placement", p.placement);
      f("pose", p.pose), f("leaves", p.leaveAt), f("next at", p.nextAt), f("next", p.next);
    }
  };

  void onEnter(Scene& scene) override;
  void onLeave(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) final;
  void simulateApart() final;
  void afterSimulation(FrameContext& frame) final;

  /// Puts a collidee into the world; here as a body that is moved from outside.
  virtual void addCollidee(Part& part, ObjectNode& object, Scene& scene);
  /// Returns true if something outside moves its collidees.
  virtual bool followsCollidees() const { return true; }
  virtual void removeCollidee(Part& part, Scene& scene);
  // The frame is cut where something outside turns, jumps or is commanded; then act, move, act, ... in turn.
  /// Looks at what has changed outside, and adds the times at which the frame must be cut. True if anything
  /// has.
  virtual bool prepare(FrameContext& frame, std::vector<Nanoseconds>& cuts);
  /// Returns true if something happens in this frame that needs the scene at its exact time.
  virtual bool needsScene(Nanoseconds end) const;
  /// Applies the changes that happen at `time`. `frame` is null if none of them needs the scene.
  virtual void act(Nanoseconds time, FrameContext* frame);
  /// Returns true if `mover` moves one of the nodes that this one looks at, or one that carries such a node.
  virtual bool looksAt(const Node& mover, const Scene& scene) const;
  /// Tells the world where things that are moved from outside go until `to`; evenly, or as the world stands
  /// still in between, with a jump.
  virtual void move(Nanoseconds from, Nanoseconds to, bool jump);
  /// Tells the outside what the step has done. True if the next frame must be simulated in any case.
  virtual bool afterStep(FrameContext& frame);

  /// How the object collides where it is now; null if it has no usable triangle.
  SharedFit fitOf(const ObjectNode& object, const Scene& scene);
  SharedFit fitAt(const Vec3& scale, const ObjectNode& object, const Scene& scene);
  /// The same for a restored part.
  virtual SharedFit refit(const Part& part, const ObjectNode& object, const Scene& scene) {
    return fitAt(*part.refit, object, scene);
  }
  /// Connects restored parts with their objects. Returns false if an object is missing.
  bool resumeParts(Scene& scene);
  /// Adds the shape to the world; 0 of null.
  ShapeId addShape(const SharedFit& fit);

  World world_;
  CollisionAttributes attributes_;
  std::vector<Part> colliders_, collidees_;

  /// The part's way in this frame, with the times added to the cuts at which it must be told. True if it
  /// moves.
  bool follow(Part& part, FrameContext& frame, std::vector<Nanoseconds>& cuts) const;
  void followFrom(Part& part, const Pose& before, FrameContext& frame) const;
  bool followBody(Part& part, const Pose& before, const FrameContext& frame) const;
  static bool moves(const Part& part) { return !part.arcs.empty() || !part.track.empty(); }
  static bool jumps(const Part& part, Nanoseconds time);
  static Pose poseAt(const Part& part, Nanoseconds time, Limit limit);
  /// Adds the other dynamics node that moves the node or something that carries it.
  void addMover(NodeRef node, const Scene& scene, std::vector<NodeRef>& movers) const;
  /// Returns true if `mover` moves the node or something that carries it.
  static bool isMovedBy(const Node& mover, NodeRef node, const Scene& scene);
  static void addCuts(const PoseTrack& track, std::vector<Nanoseconds>& cuts);

private:
  void noteImpacts(Scene& scene) const;
  NodeRef nodeOf(ContactSide key) const;
  void findParts(Scene& scene);
  void findPart(Part& part, Scene& scene);
  ColliderDef colliderOf(Part& part, const ObjectNode& object, const Scene& scene);
  void addCollider(Part& part, const ObjectNode& object, Scene& scene);
  void removeCollider(Part& part, Scene& scene);
  void bring(Part& part, ObjectNode& object, bool isCollider, Nanoseconds time, FrameContext& frame);
  void changeParts(Nanoseconds time, FrameContext& frame);
  bool foresee(FrameContext& frame, std::vector<Nanoseconds>& cuts);
  void actAt(Nanoseconds time, FrameContext* frame);
  void step(FrameContext* frame);

  std::shared_ptr<ShapeStore> shapes_;
  SwitchState switch_;
  /// A command that switched it, at its exact time.
  struct Switching {
    Nanoseconds when;
    bool on;
  };
  std::vector<Switching> switchings_;  ///< switches in this frame, in order
  bool on_;                            ///< at advancedTo_
  std::vector<Part*> comingOrGoing_;   ///< parts that stand in files that come or go in this frame
  std::uint64_t loadsSeen_ = ~std::uint64_t{0};
  bool awake_ = true;
  Nanoseconds advancedTo_ = 0;
  /// The parameters of the present frame's step.
  struct FrameStep {
    Nanoseconds from = 0, to = 0;
    std::vector<Nanoseconds> cuts;
    bool outside = false;  ///< something has changed outside
    bool rested = false;   ///< the node rested until `from`
    bool done = false;
  };
  FrameStep step_;
};

/// Returns the attributes in the declaration of a collision or dynamics node.
CollisionAttributes collisionAttributesOf(const NodeRequest& request, ShapeStore& shapes);
/// Warns of a node without collidees, and of colliders that are given twice.
void lintContacts(const Declaration& node, LintScope& scope);

extern const NodeType kCollisionType;
inline constexpr AttributeSpec kColliderRow{.name = "collider",
                                            .kind = ValueKind::Reference,
                                            .help = "takes part, and is not moved",
                                            .repeatable = true,
                                            .targets = kModelTypes,
                                            .acts = true};
inline constexpr AttributeSpec kReleaseDistanceRow{
    .name = "releasedistance",
    .kind = ValueKind::Number,
    .help = "how far the surfaces of a pair must be apart for onrelease",
    .standard = "0.5",
    .unit = "m",
    .range = kLengthRange};
inline constexpr EventSpec kContactEvents[] = {
    {"onimpact", "a pair that was apart has touched"},
    {"onrelease", "a pair that posted onimpact is farther apart than releasedistance"}};

}  // namespace stadion
