#pragma once
/// What the world keeps of a body, a collider and their motion through one frame. Internal to dynamics/.
///
/// Times    tau is seconds after the start of the present window; an arc's age is `age0 + tau`.

#include "dynamics/body/body.h"
#include "dynamics/motion/arc.h"
#include "dynamics/motion/arc_track.h"
#include "dynamics/motion/body_flight.h"
#include "dynamics/motion/drag_flight.h"
#include "dynamics/motion/instant.h"
#include "dynamics/shapes/shape.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <array>
#include <vector>

namespace stadion {

/// Events on known arcs are found up to this time beyond the end of an arc: a touch there belongs to it [s].
constexpr double kTurnTolerance = 1e-10;

/// A straight move with constant angular velocity through the frame, or a path of known arcs.
struct GuidedMotion {
  Pose start, end;
  Vec3 v = Vec3::Zero(), omega = Vec3::Zero();
  double begin = 0;  ///< tau of `start`
  double rate = 0;   ///< 1 / frame length [1/s]
  bool moving = false;
  ArcTrack arcs;         ///< in this frame: the known arcs, which replace the straight move
  std::size_t part = 0;  ///< piece of `arcs` at the last turn

  void set(const Pose& from, const Pose& to, double tau, double seconds) {
    start = from;
    end = to;
    begin = tau;
    moving = seconds > 0 && (from.p != to.p || from.q.coeffs() != to.q.coeffs());
    rate = moving ? 1 / seconds : 0;
    v = moving ? Vec3((to.p - from.p) * rate) : Vec3::Zero();
    omega = moving ? Vec3(from.q * det::logRotation(from.q.conjugate() * to.q) * rate) : Vec3::Zero();
  }
  /// Follows `arcs` from tau to `until` instead of the straight move. `origin`: start of the window.
  void follow(const Instant& origin, double tau, double until) {
    if (arcs.empty()) return;
    rebase(origin);
    part = partAfter(tau + 1e-12);
    moving = false;
    for (std::size_t i = part; i < arcs.size() && arcs[i].tau < until; ++i)
      moving = moving || !arcs[i].stands();
    if (!moving) {
      arcs.clear();
      v.setZero();
      omega.setZero();
    }
  }
  void rebase(const Instant& origin) {
    for (ArcPiece& p : arcs) p.tau = p.from.since(origin);
  }
  bool guided() const { return !arcs.empty(); }
  Kinematics at(double tau) const {
    if (guided()) return arcs[partAt(tau)].at(tau);
    const Pose X = moving ? det::interpolate(start, end, (tau - begin) * rate) : end;
    return {X, X.p, v, omega};
  }
  /// Returns a bound of the motion over times that lie in one piece of the arcs.
  MotionBound boundOver(double from, double to) const {
    if (guided()) return arcs[partAt(from)].boundOver(from, to);
    return {v.norm(), 0, omega.norm(), 0};
  }
  /// Returns the time at which the next piece of the way begins [s]; infinity if there is none.
  double nextTurn() const {
    return part + 1 < arcs.size() ? arcs[part + 1].tau : std::numeric_limits<double>::infinity();
  }
  /// Returns the piece of `arcs` that holds at tau. At a turn, this is the piece that has been reached.
  std::size_t partAt(double tau) const {
    if (arcs[part].tau <= tau && !(tau > nextTurn() + kTurnTolerance)) return part;
    return partAfter(tau);
  }
  std::size_t partAfter(double tau) const {
    const auto next = std::ranges::upper_bound(arcs, tau, {}, &ArcPiece::tau);
    return next == arcs.begin() ? 0 : static_cast<std::size_t>(next - arcs.begin()) - 1;
  }
};

/// A flat face that a ball slides or rolls on.
struct Support {
  ContactSide on;              ///< collider, or none
  std::int32_t triangle = -1;  ///< triangle of a mesh; -1: the support is no mesh
  Vec3 point = Vec3::Zero();   ///< the plane that the ball's surface touches
  Vec3 normal = Vec3::UnitZ();
  int edges = 0;  ///< the face ends where n . x < d for one of these
  std::array<Vec3, 4> edgeNormal{Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};
  std::array<double, 4> edgeOffset{};
  double friction = 0, rolling = 0, restitution = 0;

  /// Returns true if a ball at p that moves with v has come to the face's end.
  bool ends(const Vec3& p, const Vec3& v) const {
    constexpr double kAtEdge = 1e-9;  // [m]
    for (std::size_t i = 0; i < static_cast<std::size_t>(edges); ++i)
      if (edgeNormal[i].dot(p) - edgeOffset[i] <= kAtEdge && edgeNormal[i].dot(v) < 0) return true;
    return false;
  }
};

/// The force at a contact point in the solver's last step, with which the next step starts.
struct WarmStart {
  std::uint64_t key = 0;
  Vec3 force = Vec3::Zero();  ///< on the body [N]
  double step = 0;            ///< duration of that step: a short blow is no guess for a long push [s]
};

struct Hook {
  FieldId field = 0;
};

/// Records how the velocity of a body that hardly moves changes. A body that accelerates does not fall
/// asleep.
struct SleepCandidate {
  Vec3 v = Vec3::Zero(), omega = Vec3::Zero();  ///< velocity when the present look began
  double since = 0;                             ///< quiet time of the body when the present look began [s]
  double span = 0;                              ///< duration of the present look [s]
  bool balanced = false;                        ///< result of the last look
};

/// The members that the world reads for every body in flight. They are together and begin with a cache line,
/// because most of the cost of many bodies in flight is to fetch them.
struct alignas(64) RigidMotion {
  BodyId id = 0;
  BodyMode mode = BodyMode::Flight;
  bool enabled = true, fresh = true;
  bool active = false, marked = false;  ///< in the world's lists of these names
  bool stirred = false;                 ///< the body is in the world's list of stirred bodies
  bool aligned = false;                 ///< X_NC is the identity
  bool atMostOneNear = false;           ///< at most `nearCollider` is near the swept space
  bool lazy = false;                    ///< nothing is near, and arcs are made on request (Foresight)
  std::uint32_t version = 0;            ///< counts arcs: older predictions are void
  Instant since;                        ///< when the present arc began
  double age0 = 0;                      ///< age of the arc at the start of the window [s]
  double until = 0;                     ///< greatest valid tau; infinity if unlimited
  double validAge = 0;                  ///< `until` as an age [s]
  double pathAge = 0;                   ///< age up to which the path is valid [s]; the spin may end earlier
  double spinStart = 0;                 ///< the arc's age at which the spin's own began
  Pose pose;                            ///< X_WN at the end of the last frame, sampled from the arc
  Path path;
  Spin spin;
};

/// How a body leaves a collider into which a hand has put it (penetration_recovery.h).
struct PenetrationRecovery {
  ColliderId of = 0;
  Vec3 normal = Vec3::UnitZ();  ///< unit, in the collider's frame
  double side = 1;              ///< 1: out of the front of its faces, -1: out of their back
};

/// Properties that are constant while a body lives: shape, mass, surface and air.
struct BodyMatter {
  ShapeId shapeId = 0;
  const Shape* shape = nullptr;
  Sphere bound;          ///< bounding sphere of the shape, centre in N
  double reach = 0;      ///< greatest distance of a surface point from the centre of mass [m]
  bool centred = false;  ///< a ball that rotates about its own centre: it has closed forms
  Surface surface;
  double mass = 1, inverseMass = 1;  ///< [kg], [1/kg]
  Vec3 inertia = Vec3::Ones();       ///< about the principal axes [kg m2]
  Pose X_NC, X_CN;                   ///< centre of mass and principal axes in N, and back
  double damping = 0;                ///< [1/s]
  double dragArea = 0;               ///< [m2]
  double releaseDistance = 0.5;      ///< [m]
  std::optional<TipEmbedding> embedding;
  std::shared_ptr<const BodyFlight> flight;
  Quat q_CA = Quat::Identity();  ///< flight frame A to C, of a body with `flight`
};

/// A body in lasting contact. Much of it outlasts the mode: a sleeping body keeps its neighbours and forces,
/// and wakes with them.
struct BodyContact {
  std::vector<ContactSide> touching;  ///< sides that the body leans on, or nearly; also for a body at rest
  std::vector<ContactSide> leaning;   ///< sides in `touching` that ContactMemory calls touching
  std::vector<WarmStart> warmStarts;  ///< forces of the last step on the points of this body
  double energyCredit = 0;            ///< energy that contact forces took and may give back [J]
  Vec3 endL = Vec3::Zero();  ///< angular momentum at the end of the step, except for Driven spins [kg m2/s]
  double dueAge = 0;         ///< age at which the solver continues; 0: at once [s]
  bool inPile = false;       ///< a member of a pile, advanced together with the others
  bool sleepsNext = false;   ///< in a pile: it falls asleep when the present step is over
  bool restsInPile = false;  ///< at rest: it fell asleep as a member of a pile
  bool wedged = false;       ///< in an island: external motion presses it against something fixed
  bool unsolved = false;     ///< in an island: the last step had no exact solution, or took too long
  double quietTime = 0;      ///< time for which the body has hardly moved [s]
  SleepCandidate sleepCandidate;  ///< in an island
  Vec3 drift = Vec3::Zero(),
       twist = Vec3::Zero();  ///< moved and turned in `quietTime`, or since the last look [m], [rad]
  std::uint32_t slot = 0;     ///< scratch of the contact solver
};

/// The part of a body that a hand holds or has just released.
struct BodyGrip {
  GuidedMotion held;
  ArcTrack nextArcs;                ///< arcs in the coming part of a frame, if they are known
  std::vector<FieldId> carried;     ///< fields in the same hand
  Vec3 accumulated = Vec3::Zero();  ///< velocity from the pushes of these fields, added up, in N [m/s]
  Instant accumulatedTo;            ///< time up to which `accumulated` is added up
  Vec3 freePlace = Vec3::Zero();    ///< last middle of `bound` outside of all colliders
  bool letGo = false;               ///< a hand has released the body at this moment
  std::vector<PenetrationRecovery> recoveries;  ///< from the colliders in which the body was released
};

/// The record of a body's path within a frame (state/body_traces.h).
struct BodyTrace {
  bool traced = false;   ///< the path is recorded for other nodes
  bool awaited = false;  ///< the path is recorded because a pair may part
  bool put = false;      ///< the body has been placed from outside
  ArcTrack arcs;
};

/// The whole state of a body.
///
/// The parts are no std::variant of modes, because they outlast modes: a ball that rests keeps the face on
/// which it rolled, a body that wakes starts its contact from the forces of the last one, and a snapshot
/// saves all of it.
struct RigidBody : RigidMotion, BodyMatter {
  EvenPull even;    ///< a path that is a series: what acts on the body
  double step = 0;  ///< last step of the general integrator [s]
  Support support;  ///< Slide, Roll, Rest: the face
  std::vector<Hook> hooks;
  BodyContact contact;
  BodyGrip grip;
  BodyTrace trace;
  std::uint32_t impacts = 0;         ///< in the short time `impactSpan`
  Nanoseconds impactSpan = -1;       ///< counts spans of 16 ms
  std::string trouble;               ///< why it is quarantined
  Aabb swept;                        ///< in the rest of the window, as far as it is known
  std::uint32_t place = 0xffffffff;  ///< in the broad phase
  ColliderId nearCollider = 0;       ///< collider near the swept space, if `atMostOneNear`; 0: none

  bool isBall() const { return std::holds_alternative<BallShape>(*shape); }
  /// How far the ball's centre is from the centre of mass [m].
  double eccentricity() const { return (X_CN * std::get<BallShape>(*shape).centre).norm(); }
  double radius() const { return std::get<BallShape>(*shape).radius; }
  bool movable() const {
    return mode != BodyMode::Held && mode != BodyMode::Quarantined && mode != BodyMode::Stuck;
  }

  double age(double tau) const { return age0 + tau; }
  double spinAge(double tau) const { return age0 + tau - spinStart; }
  Vec3 position(double tau) const { return path.position(age(tau)); }
  Vec3 velocity(double tau) const { return path.velocity(age(tau)); }
  Quat orientation(double tau) const { return spin.orientation(spinAge(tau)); }
  /// In a step of contact the arc turns with the mean of the step, through which the momentum grows evenly.
  bool torqued() const {
    return mode == BodyMode::Contact && contact.dueAge > 0 && spin.kind != Spin::Kind::Driven;
  }
  Vec3 angularMomentum(double tau) const {
    if (!torqued()) return spin.angularMomentum(spinAge(tau));
    const double share = std::clamp(2 * age(tau) / contact.dueAge - 1, -1.0, 1.0);
    return spin.L + share * (contact.endL - spin.L);
  }
  /// The angular velocity that belongs to the angular momentum.
  Vec3 angularVelocity(double tau) const { return angularVelocity(tau, orientation(tau)); }
  Vec3 angularVelocity(double tau, const Quat& q) const {  ///< if the orientation is known already
    if (!torqued()) return spin.angularVelocity(spinAge(tau), q);
    const Vec3 inverse = inertia.cwiseInverse();
    if (inverse.x() == inverse.y() && inverse.y() == inverse.z()) return inverse.x() * angularMomentum(tau);
    return q * inverse.cwiseProduct(q.conjugate() * angularMomentum(tau));
  }
  /// X_WN alone.
  Pose poseAt(double tau) const {
    if (mode == BodyMode::Held) return grip.held.at(tau).pose;
    const Pose X_WC{position(tau), orientation(tau)};
    return aligned ? X_WC : X_WC * X_CN;
  }
  Kinematics at(double tau) const {
    if (mode == BodyMode::Held) {
      Kinematics k = grip.held.at(tau);
      const Vec3 c = k.pose * X_NC.p;
      k.v = k.velocityAt(c);
      k.p = c;
      return k;
    }
    const Pose X_WC{position(tau), orientation(tau)};
    return {X_WC * X_CN, X_WC.p, velocity(tau), spin.angularVelocity(spinAge(tau), X_WC.q)};
  }
  MotionBound boundOver(double from, double to) const;
};

struct Collider {
  ColliderId id = 0;
  ShapeId shapeId = 0;
  const Shape* shape = nullptr;
  Surface surface;
  Sphere bound;  ///< in N
  bool enabled = true;
  Pose now;                  ///< X_WN at the start of the coming frame
  std::optional<Pose> next;  ///< pose at the end of the coming frame
  ArcTrack nextArcs;         ///< arcs to that pose, if they are known
  GuidedMotion motion;
  /// Plane of a PlaneShape, at the motion's end.
  Vec3 planePoint = Vec3::Zero(), planeNormal = Vec3::UnitZ();
  bool disturbed = false;  ///< the collider moved, jumped or appeared: sleeping bodies on it wake
  bool fresh = true;
  std::uint32_t version = 0;  ///< counts motions: older predictions are void
  Aabb swept;
  std::uint32_t place = 0xffffffff;  ///< in the broad phase

  void move(const Pose& from, const Pose& to, double tau, double seconds) {
    motion.set(from, to, tau, seconds);
    if (const auto* plane = std::get_if<PlaneShape>(shape)) {
      planePoint = to * plane->pose.p;
      planeNormal = to.q * plane->normal();
    }
  }
};

inline MotionBound RigidBody::boundOver(double from, double to) const {
  if (mode == BodyMode::Held) return grip.held.boundOver(from, to).seenFrom(X_NC.p.norm());
  return boundOf(path, age(from), age(to), spin, spinAge(to));
}

}  // namespace stadion
