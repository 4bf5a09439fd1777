#pragma once
/// Bodies that fly, bounce, slide, roll and rest, from one show time to another.
///
/// Hybrid and event-driven: every body follows an arc that is known in closed form (or by a high-order step)
/// until its own next event: an impact, the end of a slide, a field switched on. Frames only sample the arcs,
/// so what happens does not depend on the frame rate. Bodies in lasting contact that has no closed form are
/// advanced by a sub-stepped solver on a time grid of their own.
///
/// Frames   node poses X_WN in World, right-handed, +Z up. Velocities are of the centre of mass.
/// Units    metres, seconds, kilograms; times in show nanoseconds.
/// Threads  one thread at a time; worlds are independent of each other.
/// Errors   unusable arguments are refused (invalid id or false); a body whose state would become non-finite
/// is
///          quarantined at its last good pose. No exception leaves.
/// Order    results depend on nothing but the sequence of calls: no addresses, no hashing, no threads.

#include "dynamics/body/body.h"
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
struct WayPart;
using BodyWay = std::vector<WayPart>;

class World {
public:
  World();
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Shapes may be shared by many bodies and colliders, and with others; they stay until removed. A shape in
  /// use is not removed. 0 if its bounds are not finite.
  ShapeId addShape(std::shared_ptr<const Shape> shape);
  ShapeId addShape(Shape shape) { return addShape(std::make_shared<const Shape>(std::move(shape))); }
  bool removeShape(ShapeId id);
  const Shape* shape(ShapeId id) const;

  /// A body touching something when it appears keeps its place and fires nothing for it.
  BodyId addBody(const BodyDef& def);
  bool removeBody(BodyId id);
  ColliderId addCollider(const ColliderDef& def);
  bool removeCollider(ColliderId id);

  /// Where the collider is at the end of the coming frame; it moves there evenly and its velocity enters
  /// impacts. Not told, it stays. `teleport`: it is there from the frame's start and gives no impulse for the
  /// jump; sleepers that it is put into wake.
  bool moveCollider(ColliderId id, const Pose& end, bool teleport = false);
  /// The same, on a way that is known from the frame's start to its end, where it leads to `end`. A jump in
  /// it must be told by itself, at its time.
  bool moveCollider(ColliderId id, const Pose& end, const BodyWay& way);
  /// A collider that is off takes part in nothing.
  bool enableCollider(ColliderId id, bool on);
  bool enableBody(BodyId id, bool on);
  /// True if the pair is to be ignored (selfcollide off, or a body and the geometry that carries it).
  bool ignorePair(Party a, Party b, bool ignored);
  /// Whether bodies collide with each other at all, default on.
  void setBodiesCollide(bool on);
  /// Divides the steps of lasting contact and of pulled balls on faces by 1, 2, 4, 8 or 16: nearer to the
  /// truth, and dearer. Before the first advance.
  void setFineness(std::uint32_t parts);

  FieldId addField(const ForceField& field, bool on = false);
  bool removeField(FieldId id);
  /// Where the field is at the two ends of the coming frame; its law may change as well.
  bool moveField(FieldId id, const Pose& start, const Pose& end);
  /// How strong it is at the two ends of the coming frame, in multiples of its law; 1 if never told.
  bool setFieldStrength(FieldId id, double start, double end);
  bool setFieldLaw(FieldId id, const FieldLaw& law);
  /// Takes effect at exactly `when`, or at once if that is past. Switching on starts a new activation, which
  /// ends after the field's duration or with an earlier switch off.
  bool switchField(FieldId id, bool on, Nanoseconds when);
  bool fieldOn(FieldId id) const;

  /// From exactly `when` on the body feels (does not feel) the field.
  bool hook(BodyId body, FieldId field, Nanoseconds when);
  bool unhook(BodyId body, FieldId field, Nanoseconds when);
  bool hooked(BodyId body, FieldId field) const;

  /// Jumps. Those who leaned on it wake, and those it is put into.
  bool placeBody(BodyId id, const Pose& X_WN, const Vec3& v, const Vec3& omega);
  /// Adds momentum at a point of World, now.
  bool push(BodyId id, const Vec3& impulse, const Vec3& at);
  /// While held, a body follows `moveHeld` like a collider and pushes others; release gives it v and omega.
  bool holdBody(BodyId id);
  /// `teleport`: it is put there and gives no impulse for the jump.
  bool moveHeld(BodyId id, const Pose& end, bool teleport = false);
  bool moveHeld(BodyId id, const Pose& end, const BodyWay& way);
  bool releaseBody(BodyId id, const Vec3& v, const Vec3& omega);
  /// The fields that the holding hand carries, until told otherwise or it is held anew: while one of them is
  /// a linear field, on, and hooked to the body, its push adds up instead of moving the body.
  bool carryFields(BodyId id, std::vector<FieldId> fields);
  /// The velocity that has added up since the body is held, as the hand is turned now, in World [m/s].
  Vec3 woundUp(BodyId id) const;

  /// From t0 (the last t1, or any start at first) to t1. False if t1 < t0. `continues`: a further part of the
  /// frame that began with an earlier call. A frame is cut where something outside turns, jumps or is
  /// commanded; what is told here of a frame's start and end holds for each part.
  bool advance(Nanoseconds t0, Nanoseconds t1, bool continues = false);
  /// The same, but nothing moves and nothing happens: the world stands still while show time goes on.
  bool pause(Nanoseconds t0, Nanoseconds t1, bool continues = false);

  /// From now on it is noted how the body moves within a frame, or no longer.
  bool traceBody(BodyId id, bool on);
  /// How it has moved from the last frame's start, or since it is traced; empty if it is not.
  const BodyWay& wayOf(BodyId id) const;

  /// Bodies that may not be where, or as, they were before the last frame; by id. All others are.
  const std::vector<BodyId>& changed() const;

  Pose pose(BodyId id) const;  ///< X_WN at t1
  /// Where it will be at `when` > t1 if nothing happens to it; if it is held, where it has been told to go.
  Pose poseAhead(BodyId id, Nanoseconds when) const;
  BodyState state(BodyId id) const;  ///< at t1
  BodyMode mode(BodyId id) const;
  bool moving(BodyId id) const;            ///< false asleep or quarantined: nothing to publish
  std::string troubleOf(BodyId id) const;  ///< why it is quarantined, empty if it is not
  double mass(BodyId id) const;
  /// Total energy of motion [J], for reports.
  double kineticEnergy(BodyId id) const;

  /// All that its future depends on, between two frames, to be written down, compared or put back; but for
  /// shapes and flights. Those are the models', and must be given back before anything else is asked.
  void visit(StateFields& f);
  /// False: there is no such shape, or body, that misses one.
  bool giveBack(ShapeId id, std::shared_ptr<const Shape> shape);
  bool giveBack(BodyId id, std::shared_ptr<const BodyFlight> flight);
  /// Whether everything has been given back.
  bool complete() const;

  /// What happened during the last frame, in the order of time.
  const std::vector<ContactEvent>& events() const;
  /// Of all pairs that touch, or whose release has yet to be told: part of the simulated state.
  std::uint64_t pairsDigest() const;
  /// Of where held bodies were free last, and of the ways out that others are on: part of the simulated
  /// state.
  std::uint64_t waysDigest() const;

  /// Distance between the surfaces of two parties now [m], negative or 0 when they touch.
  double separation(Party a, Party b) const;

  /// Work done by the last advance, for cost reports.
  struct Counters {
    std::uint64_t arcs = 0, impacts = 0, contactSteps = 0, pairTests = 0;
    std::uint64_t contacts = 0;   ///< points, in all steps in contact
    std::uint64_t distances = 0;  ///< asked for on the way to a touch, by what has no closed form
    std::uint64_t tired = 0;      ///< impacts of bodies that have bounced too often in too short a time
    std::uint64_t limited = 0;    ///< frames cut short because their events would not end: never expected
  };
  const Counters& counters() const;

private:
  class Core;
  std::unique_ptr<Core> core_;
};

}  // namespace stadion
