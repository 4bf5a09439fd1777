#pragma once
/// What the cases are compared with: solutions in long double that share no code with any engine.
///
/// Errors   below 1e-12 in the state, which tests/profiling shows by halving the steps (the tumbling disc:
///          1e-9).

#include "bench/dynamics/engine.h"

namespace stadion::bench {

/// x'' = g - k |v| v by Runge and Kutta's classic method.
struct DragReference {
  std::vector<V3> p, v;  ///< at the frames 0..N
  DragReference(V3 p0, V3 v0, V3 g, double k, double dt, int frames, int stepsPerFrame = 500);
};

/// A rigid body that no torque acts on, by Taylor series of order 24. omega0 in the body's frame.
struct SpinReference {
  std::vector<Q4> q;      ///< body to world
  std::vector<V3> omega;  ///< in the world
  SpinReference(V3 inertia, V3 omega0, Q4 q0, double dt, int frames, int stepsPerFrame = 8);
};

/// Height of the lowest point at time t of a ball dropped from h0 with restitution e; `count`: bounces so
/// far.
double bounceHeight(double h0, double e, double g, double t, int* count = nullptr);
/// When it bounces for the k-th time, from 1.
double bounceTime(double h0, double e, double g, int k);

/// A disc that tumbles about z into a frictionless wall, seen along z: a rectangle R x b (half extents).
struct Tumbling {
  double x = 0, v = 0;          ///< position and velocity of its centre, towards the wall [m, m/s]
  double angle = 0, omega = 0;  ///< about z [rad, rad/s]
};
struct TumblingDisc {
  double R, b, mass, inertia, restitution;
  double wall;  ///< the wall's x [m]
};
/// Where it is after `seconds`, hit by hit.
Tumbling tumbleAgainstWall(const TumblingDisc& disc, Tumbling start, double seconds, double step = 1e-5);

}  // namespace stadion::bench
