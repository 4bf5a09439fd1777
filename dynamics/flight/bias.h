#pragma once
/// The paper's bias (Eq. 4): a body's longest axis turns towards its velocity, without a force or a torque.
/// The path of the centre and the angular velocity stay as they are.
///
/// Frames   `q_WA` is the flight frame A in World (`flight_shape.h`): x is the longest axis, to the nose.
/// Forms    Flow        the angle from the nose to the velocity falls as exp(-rate t): the paper's bias in a
///                      form that does not depend on the frame rate. A step of h applies h/2 before the
///                      centre moves, with the old velocity, and h/2 after it, with the new one (Strang).
///          Paper       Eq. 4 to the letter: a share of the angle every frame, whatever it lasts.
///          Covariance  the velocity, seen from the body, flows as u' = rate |v| (C u - (u.C u) u) with the
///                      surface's covariance C / l1 (Oja's flow, here exactly). Rods point along v, either
///                      end first; flat bodies lay their plane along v; balls do not turn. The rate is per
///                      metre of flight.
/// Limits   no velocity: nothing turns, and Flow fades in up to some 0.1 m/s. Nose backwards: it turns about
///          A's y. Round bodies (`PrincipalAxes::round`) have rate 0.

#include "dynamics/flight/flight_shape.h"

namespace stadion {

enum class BiasForm { Flow, Paper, Covariance };

struct Bias {
  BiasForm form = BiasForm::Flow;
  double rate = 0;             ///< Flow [1/s], Paper [share a frame], Covariance [1/m]
  Vec3 spread = Vec3::Ones();  ///< l / l1 along A's axes
};

/// For this body; rate 0 if it is round.
Bias biasFor(const FlightShape& shape, BiasForm form, double rate);

/// The rate [1/s] of Flow that turns the share b of the angle in each frame at `hz`, as the paper's does.
double biasRate(double share, double hz);

/// q_WA after the bias has acted for `seconds` on a body that flies with v [m/s] in World. Paper: after one
/// frame.
Quat biased(const Bias& bias, const Quat& q_WA, const Vec3& v, double seconds);

}  // namespace stadion
