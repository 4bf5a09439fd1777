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
/// Errors   a call with an unknown id or an unusable argument, such as a pose that is not finite, changes
///          nothing: it returns the id 0 or false. A body whose state would not be finite is quarantined at
///          its last good pose. No exception leaves.
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

  /// Adds a shape, which many bodies, colliders and worlds may share. Returns 0 if its bounds are not finite
  /// or empty. Expects a shape.
  ShapeId addShape(std::shared_ptr<const Shape> shape);
  /// Adds a shape that this world alone uses.
  ShapeId addShape(Shape shape) { return addShape(std::make_shared<const Shape>(std::move(shape))); }
  /// Removes a shape. Returns false, and keeps it, if a body or collider uses it.
  bool removeShape(ShapeId id);
  /// The shape, or null if there is none. Valid until it is removed.
  const Shape* shape(ShapeId id) const;

  /// Adds a body that flies. If it touches something there, it keeps its place and reports no impact.
  /// Returns 0 if its shape is unknown or a plane.
  BodyId addBody(const BodyDef& def);
  /// Removes a body; what leaned on it wakes.
  bool removeBody(BodyId id);
  /// Adds a collider, which stands still until moveCollider(). Returns 0 if its shape is unknown.
  ColliderId addCollider(const ColliderDef& def);
  /// Removes a collider; what leaned on it wakes.
  bool removeCollider(ColliderId id);

  /// Sets the pose of the collider at the end of the coming frame. It moves there evenly, and its velocity
  /// counts in impacts. Without a call it stays. `teleport`: it is there from the frame's start and gives no
  /// impulse for the jump; sleeping bodies that it is put into wake.
  bool moveCollider(ColliderId id, const Pose& end, bool teleport = false);
  /// Moves the collider on a known path from the frame's start to its end, which is `end`. A jump needs a
  /// call of its own at its time.
  bool moveCollider(ColliderId id, const Pose& end, const ArcTrack& arcs);
  /// Switches a collider. While it is off, it takes part in nothing.
  bool enableCollider(ColliderId id, bool on);
  /// Switches a body. While it is off, it takes part in nothing. It starts from rest when it is on again.
  bool enableBody(BodyId id, bool on);
  /// Sets whether a pair never collides (selfcollide off, or a body and the geometry that carries it).
  void ignorePair(ContactSide a, ContactSide b, bool ignored);
  /// Sets whether bodies collide with each other; on by default. If they stop, those that lean on each other
  /// wake.
  void setBodiesCollide(bool on);
  /// Divides the steps of lasting contact and of pulled balls on faces by 1, 2, 4, 8 or 16. This is more
  /// exact and costs more. Expects that the world has not been advanced.
  void setStepDivider(std::uint32_t parts);
  /// Sets how first contacts are found; exactly by default. Expects that the world has not been advanced.
  void setImpactScheme(const ImpactScheme& scheme);

  /// Adds a field. It acts on bodies that are hooked to it, while it is on. Returns 0 if one of its poses is
  /// unusable or its duration negative.
  FieldId addField(const ForceField& field, bool on = false);
  /// Removes a field, and unhooks all bodies from it.
  bool removeField(FieldId id);
  /// Sets the poses of the field at the two ends of the coming frame.
  bool moveField(FieldId id, const Pose& start, const Pose& end);
  /// Sets its strength at the two ends of the coming frame, in multiples of its law; 1 by default.
  bool setFieldStrength(FieldId id, double start, double end);
  /// Replaces its law from the start of the coming frame on.
  bool setFieldLaw(FieldId id, const FieldLaw& law);
  /// Switches at exactly `when`, or at once if that is past. Switching on starts a new activation. It ends
  /// when the field's duration, from `when` on, is over, or earlier if the field is switched off.
  bool switchField(FieldId id, bool on, Nanoseconds when);
  /// Returns true if the field is on now; false also if there is no such field.
  bool fieldOn(FieldId id) const;

  /// From exactly `when` on the body feels the field.
  bool hook(BodyId body, FieldId field, Nanoseconds when);
  /// From exactly `when` on the body no longer feels the field.
  bool unhook(BodyId body, FieldId field, Nanoseconds when);
  /// Returns true if the body is hooked to the field now.
  bool hooked(BodyId body, FieldId field) const;

  /// The body jumps to X_WN and flies on with velocity v [m/s] and omega [rad/s] in World. Bodies that leaned
  /// on it wake, and so do bodies that it is put into. A quarantine ends.
  bool placeBody(BodyId id, const Pose& X_WN, const Vec3& v, const Vec3& omega);
  /// Adds momentum [N s] at a point of World, now. Returns false if the body is held, quarantined or stuck.
  bool push(BodyId id, const Vec3& impulse, const Vec3& at);
  /// Holds a body: it follows moveHeld() like a collider and pushes others. Returns false if it is
  /// quarantined.
  bool holdBody(BodyId id);
  /// Sets the pose of a held body at the end of the coming frame. Returns false if the body is not held.
  /// `teleport`: it is there from the frame's start and gives no impulse for the jump.
  bool moveHeld(BodyId id, const Pose& end, bool teleport = false);
  /// Moves a held body on a known path, as moveCollider() does.
  bool moveHeld(BodyId id, const Pose& end, const ArcTrack& arcs);
  /// Lets a held body fly on with velocity v [m/s] and omega [rad/s] in World. Returns false if it is not
  /// held.
  bool releaseBody(BodyId id, const Vec3& v, const Vec3& omega);
  /// Sets the fields that the holding hand carries, until the next call or grab. While such a field is
  /// linear, on and hooked to the body, its push adds up instead of moving the body. Returns false if the
  /// body is not held.
  bool carryFields(BodyId id, std::vector<FieldId> fields);
  /// The velocity that has added up since the grab, turned with the hand, in World [m/s]. Zero if the body is
  /// not held.
  Vec3 accumulatedVelocity(BodyId id) const;

  /// Advances the world [ns]. `from` is the end of the last call, or any time in the first call. Returns
  /// false, and does nothing, if `from` is another time or if to < from.
  /// `continues`: a further part of the frame that an earlier call began. The caller cuts a frame where
  /// external motion turns, jumps or receives a command. "Start" and "end of the frame" above then mean those
  /// of each part.
  bool advance(Nanoseconds from, Nanoseconds to, bool continues = false);
  /// Advances show time, but the world stands still. Returns as advance() does.
  bool pause(Nanoseconds from, Nanoseconds to, bool continues = false);

  /// Starts or stops recording how the body moves within a frame.
  bool traceBody(BodyId id, bool on);
  /// Returns the path of the body from the last frame's start, or since recording started. Empty if it is not
  /// recorded.
  const ArcTrack& arcsOf(BodyId id) const;

  /// The bodies whose state may have changed in the last frame, in order of id. The state of all other bodies
  /// is unchanged.
  const std::vector<BodyId>& changed() const;

  /// X_WN at the end of the last frame; identity if there is no such body.
  Pose pose(BodyId id) const;
  /// Returns the pose at a later time `when`, if nothing happens to the body. For a held body, the pose set
  /// by moveHeld.
  Pose poseAhead(BodyId id, Nanoseconds when) const;
  /// The state at the end of the last frame; a default one if there is no such body.
  BodyState state(BodyId id) const;
  /// What the body does now; Rest if there is no such body.
  BodyMode mode(BodyId id) const;
  /// Returns false if the body stands: it is asleep, quarantined or stuck. Then there is nothing to publish.
  bool moving(BodyId id) const;
  /// Returns true if a field switches itself off later, as its duration says. Then time must go on, although
  /// nothing moves.
  bool awaitsCommands() const;
  /// The reason why the body is quarantined; empty if it is not.
  std::string quarantineReason(BodyId id) const;
  /// The mass [kg]; 0 if there is no such body.
  double mass(BodyId id) const;
  /// Energy of translation and rotation [J], for reports.
  double kineticEnergy(BodyId id) const;

  /// Saves, compares or restores, between two frames, all that the future depends on, except shapes and
  /// flights. These belong to the models. Give them back before any other call.
  void visitState(StateFields& f);
  /// Gives a restored world a shape back. Returns false if that shape is unknown or not missing.
  bool restoreShape(ShapeId id, std::shared_ptr<const Shape> shape);
  /// Gives a restored body its flight back. Returns false if the body is unknown or its flight not missing.
  bool restoreFlight(BodyId id, std::shared_ptr<const BodyFlight> flight);
  /// Returns true if no shape or flight of a body or collider is missing.
  bool complete() const;

  /// The impacts and releases of the last frame, in order of time. Valid until the next advance().
  const std::vector<ContactEvent>& events() const;
  /// Hash of the pairs that touch or await their release: part of the simulated state.
  std::uint64_t pairsDigest() const;
  /// Hash of the last free places of held bodies and of recoveries from penetration: part of the simulated
  /// state.
  std::uint64_t recoveryDigest() const;

  /// Distance between the surfaces of two sides now [m], negative or 0 when they touch. Infinite if one
  /// of them does not exist.
  double separation(ContactSide a, ContactSide b) const;

  /// Work done by the last advance, for cost reports.
  struct Counters {
    std::uint64_t arcs = 0, impacts = 0, contactSteps = 0, pairTests = 0;
    std::uint64_t contacts = 0;       ///< contact points, in all steps
    std::uint64_t distances = 0;      ///< computed in searches for touches without closed form
    std::uint64_t dampedBounces = 0;  ///< impacts without rebound, since the body has bounced too often
    std::uint64_t limited = 0;        ///< frames cut short because of endless events: never expected
  };
  /// What the last advance() has counted.
  const Counters& counters() const;

private:
  class Core;
  std::unique_ptr<Core> core_;
};

}  // namespace stadion
