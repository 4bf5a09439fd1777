#pragma once
/// `dynamics`: the simulation node. A collision node that also moves its collidees, by force fields and
/// impacts.
///
/// Motion does not depend on the frame rate. Bodies fly, bounce and rest on clocks of their own. Fields
/// switch and hands grab and release at exact times. A released body continues with the velocity of the hand
/// (hand_motion.h), plus the pushes of the fields in that hand.
///
/// Events    onimpact, onrelease for each pair of collider and collidee, and of two collidees.

#include "dynamics/nodes/collision_node.h"
#include "dynamics/nodes/dyn_object_node.h"
#include "dynamics/nodes/field_node.h"
#include "dynamics/nodes/grips.h"

#include <unordered_map>

namespace stadion {

extern const NodeType kDynamicsType;

class DynamicsNode : public CollisionNode {
public:
  DynamicsNode(NodeRef self, std::string name, CollisionAttributes attributes,
               std::shared_ptr<ShapeStore> shapes)
      : CollisionNode(kDynamicsType, self, std::move(name), std::move(attributes), std::move(shapes)) {}

  Rank rank() const override { return Rank::Dynamics; }
  void hash(StateHash& h) const override;
  void state(StateFields& f) override;
  bool resume(Scene& scene) override;
  void addMovers(const Scene& scene, std::vector<NodeRef>& movers) const override;

protected:
  void onLeave(Scene& scene) override;
  void addCollidee(Part& part, ObjectNode& object, Scene& scene) override;
  bool followsCollidees() const override { return false; }
  void removeCollidee(Part& part, Scene& scene) override;
  bool prepare(FrameContext& frame, std::vector<Nanoseconds>& cuts) override;
  bool needsScene(Nanoseconds end) const override;
  void act(Nanoseconds time, FrameContext* frame) override;
  bool looksAt(const Node& mover, const Scene& scene) const override;
  void move(Nanoseconds from, Nanoseconds to, bool jump) override;
  bool afterStep(FrameContext& frame) override;
  SharedFit refit(const Part& part, const ObjectNode& object, const Scene& scene) override;

private:
  void tellCounts(FrameProbe& probe) const;

  /// A force field that one of the bodies is or was hooked to.
  struct Field {
    NodeRef ref;
    FieldId id = 0;
    PlacementId placement = kNoPlacement;
    Pose pose;           ///< at the end of the last step
    PoseTrack track;     ///< in this frame, if it moves
    AxisTrack strength;  ///< in this frame, if a device's axis says it
    BodyId carrier = 0;  ///< the body of this node that carries the field, if one does
    Pose X_BF;           ///< pose of the field in the coordinates of `carrier`
    Nanoseconds leaveAt = std::numeric_limits<Nanoseconds>::max();

    template <class Self, class Fields>
    static void fields(Self& x, Fields& f) {
      f("ref", x.ref), f("id", x.id), f("placement", x.placement), f("pose", x.pose);
      f("strength", x.strength), f("carrier", x.carrier), f("X_BF", x.X_BF), f("leaves", x.leaveAt);
    }
  };
  struct Velocity {
    Vec3 v = Vec3::Zero(), omega = Vec3::Zero();  ///< in World [m/s], [rad/s]
  };
  /// Something asked of a body, for its exact time.
  struct Order {
    NodeRef body;
    DynObjectNode::Request what;
  };

  FieldId fieldFor(NodeRef ref, Scene& scene);
  bool followFields(FrameContext& frame, std::vector<Nanoseconds>& cuts);
  static bool leaves(Field& f, bool isThere, const FrameContext& frame, std::vector<Nanoseconds>& cuts);
  static bool followTrack(Field& f, FrameContext& frame, std::vector<Nanoseconds>& cuts);
  void followCarrier(Field& f, const FieldNode& node, const FrameContext& frame,
                     std::vector<Nanoseconds>& cuts);
  bool takeSwitches(const Field& f, const FieldNode& node, const FrameContext& frame);
  bool takeOrders(FrameContext& frame, std::vector<Nanoseconds>& cuts);
  void apply(const Order& order, FrameContext& frame);
  void grab(const Part& part, const std::string& tracker, Nanoseconds when, FrameContext& frame);
  void letGo(const Part& part, Nanoseconds when, Scene& scene);
  void publishWay(const Part& part, FrameContext& frame);
  void tellTrouble(const BodyState& before, DynObjectNode& node, FrameContext& frame);
  void carryFields(const Grip& grip, const Scene& scene);
  Velocity startOf(const DynObjectNode& node, const Scene& scene) const;
  BodyId carrierOf(PlacementId field, const Placements& placements) const;

  std::vector<NodeRef> asking_;               ///< bodies of which something has been asked
  std::unordered_map<BodyId, Part*> partOf_;  ///< by its body
  std::vector<Part*> traced_;                 ///< parts whose path in this frame other nodes may read
  std::vector<Field> fields_;
  Grips grips_{world_};
  std::vector<Order> orders_;  ///< commands of this frame, in the order of time
  bool toldOfLimit_ = false;   ///< once is enough
};

}  // namespace stadion
