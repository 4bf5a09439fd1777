#pragma once
/// A ball on a flat face: slide, roll, rest, in closed form.
///
/// Sliding, friction mu g_n slows the centre and turns the ball, so that the slip shrinks at (1 + 1/k) mu g_n
/// with k = I / (m r^2). Without slip the ball rolls, and rolling resistance c slows it at c g_n / (1 +
/// k). With the pull along the face parallel to the motion both are exact; else the arc is cut short enough
/// for an error below 1e-6 m/s.

#include "dynamics/body/rigid_body.h"

namespace stadion {

struct BallStart {
  Vec3 p = Vec3::Zero(), v = Vec3::Zero(), omega = Vec3::Zero();
  Quat q = Quat::Identity();
};

struct BallArc {
  BodyMode mode = BodyMode::Rest;
  Path path;
  Spin spin;
  double horizon = 0;   ///< [s] until the mode ends, the face ends or the arc wears out
  bool leaves = false;  ///< the pull has no component into the face
};

/// The next arc of a ball that touches `face`, under acceleration a. `gripped`: slip is known to have ended.
BallArc ballOnFace(const BallStart& s, const Support& face, const Vec3& a, double radius, double mass,
                   double inertia, bool gripped, bool stopped);

/// Seconds until the contact point of the path leaves the face; infinity if it does not.
double timeToEdge(const Path& path, const Support& face);

}  // namespace stadion
