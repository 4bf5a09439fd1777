#pragma once
/// `collision`: tells when its colliders and collidees touch. The dynamics node is a collision node that
/// moves its collidees as well.
///
/// Events    onimpact: once when a separated pair touches; onrelease: once when it has come apart again
/// farther than
///           releasedistance. Both carry the exact time.
/// Commands  enable, disable, toggle, reset.
/// Time-critical: it reads placements and moves bodies by direct calls, in App only. It is visited only while
/// something in it moves.

#include "dynamics/world.h"
#include "engine/nodes/object_node.h"
#include "engine/nodes/switched.h"

namespace stadion {

struct CollisionAttributes {
  std::vector<std::string> colliders, collidees;  ///< names as seen from its file
  double releaseDistance = 0.5;                   ///< [m]
  bool selfCollide = true;
  bool on = true;
};

class CollisionNode : public Node {
public:
  CollisionNode(NodeKind kind, NodeRef self, std::string name, CollisionAttributes attributes);

  Rank rank() const override { return Rank::Dynamics; }
  bool busy() const override { return switch_.on() && awake_; }
  void hash(StateHash& h) const override;

  /// What the last step did, for reports.
  const World& world() const { return world_; }

  struct Overlap {
    std::string a, b;
    double depth;  ///< [m]
  };
  /// Pairs of its parts that stick in each other by more than `deeperThan` [m].
  std::vector<Overlap> overlaps(double deeperThan) const;

protected:
  /// An object that takes part.
  struct Part {
    std::string name;
    NodeRef ref;           ///< invalid while it is not loaded
    std::uint32_t id = 0;  ///< its collider or body in the world
    ShapeId shape = 0;
    PlacementId placement = kNoPlacement;
    Pose pose;  ///< at the end of the last step
  };

  void onEnter(Scene& scene) override;
  void onLeave(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) final;

  /// Puts a collidee into the world; here as a body that is moved from outside.
  virtual void addCollidee(Part& part, ObjectNode& object, Scene& scene);
  virtual void removeCollidee(Part& part, Scene& scene);
  /// Tells the world what has changed outside since the last step. True if anything has.
  virtual bool beforeStep(FrameContext& frame);
  /// Tells the outside what the step has done. True if the next frame must be simulated in any case.
  virtual bool afterStep(FrameContext& frame);

  World world_;
  CollisionAttributes attributes_;
  std::vector<Part> colliders_, collidees_;

private:
  void findParts(Scene& scene);
  bool moveColliders(FrameContext& frame);

  Switched switch_;
  std::uint64_t loadsSeen_ = ~std::uint64_t{0};
  bool awake_ = true;
  Nanoseconds advancedTo_ = 0;
};

}  // namespace stadion
