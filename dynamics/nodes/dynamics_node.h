#pragma once
/// `dynamics`: the simulation node. A collision node that also moves its collidees, by the forces that they
/// are hooked to and by what they run into.
///
/// Events    onimpact, onrelease per pair of collider and collidee, and of two collidees.
/// What happens inside a frame does not depend on the frame rate: bodies fly, bounce and rest on clocks of
/// their own, and fields switch at exact times.

#include "dynamics/nodes/collision_node.h"
#include "dynamics/nodes/dyn_object_node.h"
#include "dynamics/nodes/field_node.h"

namespace stadion {

class DynamicsNode : public CollisionNode {
public:
  DynamicsNode(NodeRef self, std::string name, CollisionAttributes attributes)
      : CollisionNode(NodeKind::Dynamics, self, std::move(name), std::move(attributes)) {}

protected:
  void onLeave(Scene& scene) override;
  void addCollidee(Part& part, ObjectNode& object, Scene& scene) override;
  void removeCollidee(Part& part, Scene& scene) override;
  bool beforeStep(FrameContext& frame) override;
  bool afterStep(FrameContext& frame) override;

private:
  /// A force field that one of the bodies is or was hooked to.
  struct Field {
    NodeRef ref;
    FieldId id = 0;
    PlacementId placement = kNoPlacement;
    Pose pose;  ///< at the end of the last step
  };
  /// A body in the visitor's hand.
  struct Grip {
    BodyId body;
    std::string tracker;
    Pose X_TN;  ///< how it lies in the hand
    Pose last;  ///< its pose a frame ago
    Vec3 v = Vec3::Zero(), omega = Vec3::Zero();
  };

  FieldId fieldFor(NodeRef ref, Scene& scene);
  bool moveFields(FrameContext& frame);
  bool obeyRequests(FrameContext& frame);
  bool moveGrips(FrameContext& frame);
  void grab(Part& part, const std::string& tracker, FrameContext& frame);
  void letGo(BodyId body);

  std::vector<Field> fields_;
  std::vector<Grip> grips_;
};

}  // namespace stadion
