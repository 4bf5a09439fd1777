#pragma once
/// Values that describe bodies and colliders: ids, surfaces, definitions, modes, states, contact events.
///
/// Frames   node poses X_WN in World W, right-handed, +Z up; N is the node's own frame. C is a body's centre of mass with its principal
///          axes.
/// Units    metres, seconds, kilograms; times in show nanoseconds.

#include "dynamics/shapes/mass_properties.h"
#include "engine/base/time_signature.h"
#include "engine/maths/maths.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace stadion {

/// Ids count up from 1 in the order of creation and are never used again; 0 means none.
using ShapeId = std::uint32_t;
using BodyId = std::uint32_t;
using ColliderId = std::uint32_t;
using FieldId = std::uint32_t;

/// Surface properties of one side of a contact. If one side leaves a value open, the other side decides; if
/// both do, the default holds. A pair has the friction sqrt(a b), and the larger restitution and rolling
/// resistance.
struct Surface {
  std::optional<double> friction;     ///< Coulomb coefficient, default 0.5
  std::optional<double> restitution;  ///< in [0, 1], default 0.5
  std::optional<double> rolling;      ///< rolling resistance, default 0.01
};

struct PairSurface {
  double friction, restitution, rolling;
};
PairSurface combine(const Surface& a, const Surface& b);

/// A body embeds its tip, like a javelin, in the first collider that the tip hits faster than 1 m/s. The
/// collider must stand still.
struct TipEmbedding {
  Vec3 nose = Vec3::UnitX();  ///< direction of the tip, unit, in N
  double tip = 0;             ///< coordinate of the foremost point along the nose [m]
  double reach = 0.01;        ///< length of the tip, behind the foremost point [m]
  double cosine = 0.5;        ///< cosine of the greatest angle between the nose and straight into the surface
  double depth = 0;           ///< depth to which the tip goes in, along its velocity [m]
};

struct BodyFlight;

struct BodyDef {
  ShapeId shape = 0;
  Pose pose;                  ///< X_WN
  Vec3 v = Vec3::Zero();      ///< velocity of the centre of mass [m/s]
  Vec3 omega = Vec3::Zero();  ///< in World [rad/s]
  MassProperties mass;        ///< in N
  Surface surface;
  double damping = 0;            ///< velocity lost as exp(-c t) [1/s]
  double dragArea = 0;           ///< drag coefficient times cross section, for media [m2]
  double releaseDistance = 0.5;  ///< [m]; if infinite, no release is reported
  std::optional<TipEmbedding> embedding;
  std::shared_ptr<const BodyFlight> flight;  ///< null: media act on a point with its drag area
};

struct ColliderDef {
  ShapeId shape = 0;
  Pose pose;  ///< X_WN
  Surface surface;
};

enum class BodyMode : std::uint8_t {
  Flight,       ///< nothing touches it
  Slide,        ///< ball on a flat face, slipping
  Roll,         ///< ball on a flat face, not slipping
  Contact,      ///< advanced by the contact solver
  Rest,         ///< asleep: its state is frozen
  Held,         ///< moved from outside (grabbed)
  Quarantined,  ///< frozen at the last good pose: the state would have become non-finite
  Stuck,        ///< the tip sticks in a collider until that moves or disappears, or a hand takes the body
};
constexpr BodyMode lastOf(BodyMode) {
  return BodyMode::Stuck;
}
/// Returns true if a body in this mode stands.
constexpr bool standsStill(BodyMode mode) {
  return mode == BodyMode::Rest || mode == BodyMode::Quarantined || mode == BodyMode::Stuck;
}

/// How the path of a body in flight is known.
enum class FlightClass : std::uint8_t {
  Exact,   ///< in closed form, under pulls that are the same everywhere
  Series,  ///< to order 16, in one medium that is the same everywhere
  Steps,   ///< by steps of order 5, under anything else
};
constexpr FlightClass lastOf(FlightClass) {
  return FlightClass::Steps;
}

/// The whole simulated state of a body at the end of the last advance, for hashes and reports.
struct BodyState {
  Pose pose;                  ///< X_WN
  Vec3 p = Vec3::Zero();      ///< centre of mass [m]
  Quat q = Quat::Identity();  ///< principal axes C to World
  Vec3 v = Vec3::Zero();      ///< [m/s]
  Vec3 omega = Vec3::Zero();  ///< [rad/s]
  Vec3 L = Vec3::Zero();      ///< angular momentum [kg m2/s]
  BodyMode mode = BodyMode::Flight;
  Nanoseconds clock = 0;  ///< start of its present arc [ns]
  double clockRest = 0;   ///< [s], part of the clock below a nanosecond
  // For reports only:
  FlightClass flight = FlightClass::Exact;  ///< in flight
  std::uint32_t arcs = 0;                   ///< arcs begun so far: a measure of work
  bool asleep() const { return mode == BodyMode::Rest; }
};

/// A side of a pair; body and collider ids count separately.
struct ContactSide {
  bool isBody = false;
  std::uint32_t id = 0;
  auto operator<=>(const ContactSide&) const = default;

  template <class Self, class Fields>
  static void fields(Self& p, Fields& f) {
    f("body", p.isBody), f("id", p.id);
  }
};

/// An impact or a release, as the world reports it.
struct ContactEvent {
  enum class Kind : std::uint8_t { Impact, Release };
  Kind kind = Kind::Impact;
  Nanoseconds time = 0;  ///< [ns]
  ContactSide other;     ///< collider, or the body of a body pair with the smaller id
  BodyId body = 0;
  Vec3 point = Vec3::Zero();   ///< in World [m]
  Vec3 normal = Vec3::Zero();  ///< from `other` to the body
  double speed = 0;            ///< closing speed [m/s]; Release: 0
  double impulse = 0;          ///< along the normal [N s]
};

}  // namespace stadion
