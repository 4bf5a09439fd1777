#pragma once
/// How joypad, wand and head move the rig through a piece of time.
///
/// The rig turns about World's vertical through the head at w = -turn * turnRate and goes where the wand
/// points, so with R(a) a turn by a about +Z, u the head and d the way ahead in World axes at the piece's
/// start:
///
///     X_WR.q(t) = R(a(t)) X_WR.q(0),   a' = w,
///     X_WR.p(t)' = -w z x R(a) u + forward * speed * R(a) d.
///
/// With constant axes, head and wand this is integrated in closed form: an arc. Else the axes, the head and
/// the wand's turn go evenly from one end of the piece to the other, a(t) is exact, and the rest is Gauss
/// quadrature over parts so short that its error is far below rounding that matters (1e-12 m).
///
/// Units  metres, radians, seconds, axes from -1 to 1.

#include "engine/maths/maths.h"

namespace stadion {

struct RigDrive {
  /// The state of the devices at one end of the piece.
  struct End {
    double turn = 0, forward = 0;  ///< axes
    Vec3 p_RH = Vec3::Zero();      ///< head
    Quat q_RT = Quat::Identity();  ///< wand
  };

  double turnRate = 0;  ///< at full deflection [rad/s]
  double speed = 0;     ///< at full deflection [m/s]
  bool fly = false;     ///< also up and down
  double duration = 0;  ///< [s]

  /// Where the rig is at the end of the piece.
  Pose moved(const Pose& X_WR, const End& first, const End& last) const;

private:
  Vec3 ahead(const Pose& X_WR, const Quat& q_RT) const;
  Vec3 alongArc(const Pose& X_WR, const End& e) const;
  Vec3 alongWay(const Pose& X_WR, const End& first, const End& last) const;
};

}  // namespace stadion
