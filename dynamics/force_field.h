#pragma once
/// What pushes bodies: plain descriptions that the world evaluates; the scene nodes that own them move and
/// switch them.
///
/// Frames   a field has a pose at the start and at the end of the frame and moves evenly between them.
/// Forces   all fields here act at the centre of mass. A new kind is a new struct in `FieldLaw` and one case
/// in
///          `accelerationOf` (point, vortex, wind, drag region); what depends on velocity has it at hand
///          there.

#include "engine/maths/maths.h"
#include "engine/time_signature.h"

#include <variant>

namespace stadion {

/// The same push everywhere.
struct LinearField {
  enum class Unit { Acceleration, Force };
  Vec3 push = Vec3::Zero();  ///< in the field's own coordinates [m/s2 or N]
  Unit unit = Unit::Acceleration;
};

/// Away from the field's origin (strength > 0) or towards it (< 0), inside `radius` only.
struct SphericalField {
  enum class Falloff { None, Linear, Square };  ///< 1, 1 - d/R, (1 - d/R)^2
  double strength = 0;                          ///< at the centre [m/s2 or N]
  double radius = 1;                            ///< [m]
  Falloff falloff = Falloff::Linear;
  LinearField::Unit unit = LinearField::Unit::Acceleration;
};

using FieldLaw = std::variant<LinearField, SphericalField>;

struct ForceField {
  FieldLaw law;
  Pose start, end;           ///< X_WF at the two ends of the frame
  Nanoseconds duration = 0;  ///< longest activation [ns], 0 = no limit

  bool moving() const { return start.p != end.p || start.q.coeffs() != end.q.coeffs(); }
  /// True if a body anywhere feels one constant vector through the frame.
  bool uniform() const;
};

/// What a body of `mass` [kg] at `p` [m] with `v` [m/s] gains [m/s2]; s in [0, 1] from frame start to end.
Vec3 accelerationOf(const ForceField& field, const Vec3& p, const Vec3& v, double mass, double s);

}  // namespace stadion
