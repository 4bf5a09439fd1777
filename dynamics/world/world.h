#pragma once
/// A world of rigid bodies that fly, bounce, slide, roll and rest.
///
/// A program adds shapes, bodies, colliders and fields, and advances the world from one show time to the
/// next. Then it reads poses and contact events.
///
/// Method   every body follows an arc until its next event: an impact, the end of a slide, a switched field.
///          The arc is known in closed form, or from an integrator of high order. Frames only sample arcs, so
///          motion does not depend on the frame rate. Lasting contact has a solver with steps of its own.
/// Frames   node poses X_WN in World, right-handed, +Z up. Velocities are of the centre of mass.
/// Units    metres, seconds, kilograms; times in show nanoseconds.
/// Threads  one thread at a time; worlds are independent of each other.
/// Errors   unusable arguments are refused (invalid id or false). A body whose state would not be finite
///          is quarantined at its last good pose. No exception leaves.
/// Order    results depend on nothing but the sequence of calls: no addresses, no hashing, no threads.

#include "dynamics/body/body.h"
#include "dynamics/collision/impact_scheme.h"
#include "dynamics/motion/force_field.h"
#include "dynamics/shapes/shape.h"
#include "engine/base/time_signature.h"
#include "engine/maths/maths.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stadion {

class StateFields;
struct ArcPiece;
using ArcTrack = std::vector<ArcPiece>;

/// The class has more than 30 methods, because it is the one interface to bodies, colliders and fields. It
/// passes calls on to its parts (world_core.h).
class World {
public:
  World();
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Adds a shape, which many bodies, colliders and worlds may share. 0 if its bounds are not finite. A shape
  /// stays until it is removed, and one in use is not removed.
  ShapeId addShape(std::shared_ptr<const Shape> shape);
  ShapeId addShape(Shape shape) { return addShape(std::make_shared<const Shape>(std::move(shape))); }
  bool removeShape(ShapeId id);
  const Shape* shape(ShapeId id) const;

  /// A body that touches something when it appears keeps its place and reports no impact.
  BodyId addBody(const BodyDef& def);
  bool removeBody(BodyId id);
  ColliderId addCollider(const ColliderDef& def);
  bool removeCollider(ColliderId id);

  /// Sets the pose of the collider at the end of the coming frame. It moves there evenly, and its velocity
  /// counts in impacts. Without a call it stays. `teleport`: it is there from the frame's start and gives no
  /// impulse for the jump; sleeping bodies that it is put into wake.
  bool moveCollider(ColliderId id, const Pose& end, bool teleport = false);
  /// Moves the collider on a known path from the frame's start to its end, which is `end`. A jump needs a
  /// call of its own at its time.
  bool moveCollider(ColliderId id, const Pose& end, const ArcTrack& arcs);
  /// A collider or body that is off takes part in nothing.
  bool enableCollider(ColliderId id, bool on);
  bool enableBody(BodyId id, bool on);
  /// Sets whether a pair never collides (selfcollide off, or a body and the geometry that carries it).
  bool ignorePair(ContactSide a, ContactSide b, bool ignored);
  /// Sets whether bodies collide with each other; on by default.
  void setBodiesCollide(bool on);
  /// Divides the steps of lasting contact and of pulled balls on faces by 1, 2, 4, 8 or 16. This is more
  /// exact and costs more. Expects that the world has not been advanced.
  void setStepDivider(std::uint32_t parts);
  /// Sets how first contacts are found; exactly by default. Expects that the world has not been advanced.
  void setImpactScheme(const ImpactScheme& scheme);

  FieldId addField(const ForceField& field, bool on = false);
  bool removeField(FieldId id);
  /// Sets the poses of the field at the two ends of the coming frame.
  bool moveField(FieldId id, const Pose& start, const Pose& end);
  /// Sets its strength at the two ends of the coming frame, in multiples of its law; 1 by default.
  bool setFieldStrength(FieldId id, double start, double end);
  bool setFieldLaw(FieldId id, const FieldLaw& law);
  /// Switches at exactly `when`, or at once if that is past. Switching on starts a new activation. It ends
  /// when the field's duration, from `when` on, is over, or earlier if the field is switched off.
  bool switchField(FieldId id, bool on, Nanoseconds when);
  bool fieldOn(FieldId id) const;

  /// From exactly `when` on the body feels the field, or no longer feels it.
  bool hook(BodyId body, FieldId field, Nanoseconds when);
  bool unhook(BodyId body, FieldId field, Nanoseconds when);
  bool hooked(BodyId body, FieldId field) const;

  /// The body jumps. Bodies that leaned on it wake, and so do bodies that it is put into.
  bool placeBody(BodyId id, const Pose& X_WN, const Vec3& v, const Vec3& omega);
  /// Adds momentum [N s] at a point of World, now.
  bool push(BodyId id, const Vec3& impulse, const Vec3& at);
  /// A held body follows `moveHeld` like a collider and pushes others. Its release gives it v and omega.
  bool holdBody(BodyId id);
  /// `teleport`: the body is there from the frame's start and gives no impulse for the jump.
  bool moveHeld(BodyId id, const Pose& end, bool teleport = false);
  bool moveHeld(BodyId id, const Pose& end, const ArcTrack& arcs);
  bool releaseBody(BodyId id, const Vec3& v, const Vec3& omega);
  /// Sets the fields that the holding hand carries, until the next call or grab. While such a field is
  /// linear, on and hooked to the body, its push adds up instead of moving the body.
  bool carryFields(BodyId id, std::vector<FieldId> fields);
  /// The velocity that has added up since the grab, turned with the hand, in World [m/s].
  Vec3 accumulatedVelocity(BodyId id) const;

  /// Advances the world [ns]. `from` is the end of the last call, or any time in the first call. Returns
  /// false, and does nothing, if `from` is another time or if to < from.
  /// `continues`: a further part of the frame that an earlier call began. The caller cuts a frame where
  /// external motion turns, jumps or receives a command. "Start" and "end of the frame" above then mean those
  /// of each part.
  bool advance(Nanoseconds from, Nanoseconds to, bool continues = false);
  /// Advances show time, but the world stands still.
  bool pause(Nanoseconds from, Nanoseconds to, bool continues = false);

  /// Starts or stops recording how the body moves within a frame.
  bool traceBody(BodyId id, bool on);
  /// Returns the path of the body from the last frame's start, or since recording started. Empty if it is not
  /// recorded.
  const ArcTrack& arcsOf(BodyId id) const;

  /// Bodies whose state may have changed in the last frame, by id. No other state has.
  const std::vector<BodyId>& changed() const;

  Pose pose(BodyId id) const;  ///< X_WN at the end of the last frame
  /// Returns the pose at a later time `when`, if nothing happens to the body. For a held body, the pose set
  /// by moveHeld.
  Pose poseAhead(BodyId id, Nanoseconds when) const;
  BodyState state(BodyId id) const;  ///< at the end of the last frame
  BodyMode mode(BodyId id) const;
  bool moving(BodyId id) const;                   ///< false if asleep or quarantined: nothing to publish
  std::string quarantineReason(BodyId id) const;  ///< reason of the quarantine; empty if there is none
  double mass(BodyId id) const;
  /// Total energy of motion [J], for reports.
  double kineticEnergy(BodyId id) const;

  /// Saves, compares or restores, between two frames, all that the future depends on, except shapes and
  /// flights. These belong to the models. Give them back before any other call.
  void visitState(StateFields& f);
  /// False if no such shape or body lacks one.
  bool restoreShape(ShapeId id, std::shared_ptr<const Shape> shape);
  bool restoreFlight(BodyId id, std::shared_ptr<const BodyFlight> flight);
  /// Returns true if everything has been given back.
  bool complete() const;

  /// The impacts and releases of the last frame, by time.
  const std::vector<ContactEvent>& events() const;
  /// Hash of the pairs that touch or await their release: part of the simulated state.
  std::uint64_t pairsDigest() const;
  /// Hash of the last free places of held bodies and of ways out: part of the simulated state.
  std::uint64_t recoveryDigest() const;

  /// Distance between the surfaces of two sides now [m], negative or 0 when they touch.
  double separation(ContactSide a, ContactSide b) const;

  /// Work done by the last advance, for cost reports.
  struct Counters {
    std::uint64_t arcs = 0, impacts = 0, contactSteps = 0, pairTests = 0;
    std::uint64_t contacts = 0;       ///< contact points, in all steps
    std::uint64_t distances = 0;      ///< computed in searches for touches without closed form
    std::uint64_t dampedBounces = 0;  ///< impacts without rebound, since the body has bounced too often
    std::uint64_t limited = 0;        ///< frames cut short because of endless events: never expected
  };
  const Counters& counters() const;

private:
  class Core;
  std::unique_ptr<Core> core_;
};

}  // namespace stadion
