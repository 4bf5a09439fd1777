#pragma once
/// Force fields and media. A field is a plain value: the world evaluates it, and its scene node moves and
/// switches it.
///
/// Laws     linear, spherical, point, vortex, medium. docs/extend.md says how to add one.
/// Frames   a field has a pose X_WF and a strength at both ends of the frame; both change evenly.
/// Forces   all laws here act at the centre of mass.
/// Units    SI; a strength is an acceleration [m/s2] or a force [N], as `unit` says.

#include "engine/base/time_signature.h"
#include "engine/maths/maths.h"

#include <optional>
#include <variant>

namespace stadion {

/// A push that is the same everywhere.
struct LinearField {
  enum class Unit { Acceleration, Force };
  Vec3 push = Vec3::Zero();  ///< in the field's own coordinates [m/s2 or N]
  Unit unit = Unit::Acceleration;
  bool operator==(const LinearField&) const = default;
};

/// Away from the field's origin (strength > 0) or towards it (< 0), inside `radius` only.
struct SphericalField {
  enum class Falloff { None, Linear, Square };  ///< 1, 1 - d/R, (1 - d/R)^2
  double strength = 0;                          ///< at the centre [m/s2 or N]
  double radius = 1;                            ///< [m]
  Falloff falloff = Falloff::Linear;
  LinearField::Unit unit = LinearField::Unit::Acceleration;
  bool operator==(const SphericalField&) const = default;
};

/// Attracts (strength < 0) or repels from the field's origin by the inverse square of the distance.
struct PointField {
  double strength = 0;     ///< at one metre [m/s2 or N]
  double softening = 0.1;  ///< r^2 + softening^2 stands for r^2, so that nothing becomes infinite [m]
  LinearField::Unit unit = LinearField::Unit::Acceleration;
  bool operator==(const PointField&) const = default;
};

/// Around the field's z axis, right-handed for strength > 0: grows evenly to `core`, then falls with 1 / r
/// (Rankine's vortex), and pulls inward by `inward` times as much.
struct VortexField {
  double strength = 0;  ///< at the core's edge [m/s2 or N]
  double core = 1;      ///< [m]
  double inward = 0;
  double radius = 1e300;  ///< nothing beyond [m]
  LinearField::Unit unit = LinearField::Unit::Acceleration;
  bool operator==(const VortexField&) const = default;
};

/// Air or water that moves with the wind u: a = -c (v - u) - (rho A / 2 m) |v - u| (v - u), A the body's drag
/// area. Within `region` only.
struct MediumField {
  enum class Region { Everywhere, Ball, Box };
  double density = 1.225;    ///< rho [kg/m3]
  double viscosity = 0;      ///< c [1/s]
  Vec3 wind = Vec3::Zero();  ///< in the field's own coordinates [m/s]
  Region region = Region::Everywhere;
  Vec3 centre = Vec3::Zero();  ///< centre of the region, in the field's own coordinates [m]
  Vec3 half = Vec3::Ones();    ///< Box: half extents; Ball: radius in x [m]
  bool operator==(const MediumField&) const = default;
};

using FieldLaw = std::variant<LinearField, SphericalField, PointField, VortexField, MediumField>;

struct ForceField {
  FieldLaw law;
  Pose start, end;             ///< X_WF at the two ends of the frame
  Nanoseconds duration = 0;    ///< longest activation [ns], 0 = no limit
  double first = 1, last = 1;  ///< strength at the two ends of the frame, in multiples of the law's

  bool moving() const { return start.p != end.p || start.q.coeffs() != end.q.coeffs(); }
  /// Returns true if the push at a given place changes in the course of the frame.
  bool changing() const { return moving() || first != last; }
  /// True if a body anywhere feels one constant vector through the frame.
  bool uniform() const;
  /// A medium that is the same everywhere through the frame, or nothing.
  const MediumField* evenMedium() const;
};

/// The properties of a body on which a field acts.
struct BodyInField {
  double mass = 1;      ///< [kg]
  double dragArea = 0;  ///< drag coefficient times cross section [m2]
  Vec3 p = Vec3::Zero(), v = Vec3::Zero();
};

/// The coefficients c [1/s] and k [1/m] of -c u - k |u| u.
struct Drag {
  double linear = 0, quadratic = 0;
  Vec3 wind = Vec3::Zero();  ///< in World [m/s]
  bool resists() const { return linear != 0 || quadratic != 0; }
  Vec3 at(const Vec3& v) const { return -(linear + quadratic * (v - wind).norm()) * (v - wind); }
};
Drag dragOf(const MediumField& medium, const Quat& q_WF, double mass, double dragArea);

/// The law with its push `factor` times as strong; a medium with its wind so.
FieldLaw scaled(const FieldLaw& law, double factor);

/// How far a body at p may go in one step without passing over what the field does somewhere; infinity if it
/// does the same everywhere [m].
double strideIn(const ForceField& field, const Vec3& p);

/// The air (or water) at a place.
struct Air {
  double density = 0;        ///< [kg/m3]
  Vec3 wind = Vec3::Zero();  ///< in World [m/s]
};
/// Returns the air of a medium at p. Nothing outside the medium, and for fields that are no medium. s as
/// below.
std::optional<Air> airAt(const ForceField& field, const Vec3& p, double s);

/// Returns the acceleration of the body by the field [m/s2]; s in [0, 1] from frame start to end.
Vec3 accelerationOf(const ForceField& field, const BodyInField& body, double s);

}  // namespace stadion
