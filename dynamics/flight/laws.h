#pragma once
/// The models of flight_model.h as a few scalars each, in lanes. Internal to dynamics/flight/.
///
/// With k the axis, u the velocity in the air and u_p its part across k, all bodies of revolution have
///   F = -(rho/2) (across u_p + (along u_k + push) k),   M = (rho/2) (turn k x u - damp w_p)
/// and balls F = -(rho/2) (across u - swerve w x u). A law gives these scalars; they are rates: degree one in
/// u, `push` degree two. A law is plain numbers, made once from the model.
///
/// Linkage  internal; includes nothing but lanes.h (see there).

#include "dynamics/flight/lanes.h"

namespace stadion {
namespace {

/// The motion in the air that a law looks at.
template <class S>
struct Airflow {
  S speed;   ///< |u|
  S along;   ///< u_k
  S across;  ///< |u_p|
};

template <class S>
struct Rates {
  S across, along, push, turn, damp;
};

/// The airflow, and k x u, whose size is |u_p|: no digits are lost nose on.
template <class S>
struct Crossing {
  V3<S> lift;
  Airflow<S> flow;
};
template <class S>
[[gnu::always_inline]] inline Crossing<S> crossing(const V3<S>& u, const V3<S>& k) {
  const V3<S> c = cross(k, u);
  return {c, {root(dot(u, u)), dot(u, k), root(dot(c, c))}};
}

struct RodLaw {
  static constexpr bool kPushes = false;
  double axialArea, crossArea, liftArea, crossArm, liftArm, damping;

  template <class S>
  [[gnu::always_inline]] Rates<S> rates(const Airflow<S>& f) const {
    const S cross = crossArea * f.across, lift = liftArea * f.along;
    return {cross + lift, axialArea * f.speed, S{}, crossArm * cross + liftArm * lift, damping * f.speed};
  }
};

struct PlateLaw {
  static constexpr bool kPushes = false;
  double dragArea, liftArea, liftGrowth, stallArea, momentVolume, inverseStall, damping;

  template <class S>
  [[gnu::always_inline]] Rates<S> rates(const Airflow<S>& f) const {
    const S s = atMost(S(size(f.along) / atLeast(f.speed, 1e-150)), 1.0);
    S r = s * s * inverseStall;
    r = atMost(r, 1e9);
    r = r * r;
    r = r * r;
    const S attached = 1.0 / (1.0 + r * r);
    const S lift = attached * (liftArea + liftGrowth * s) + (1.0 - attached) * (stallArea * (1.6 - 0.6 * s));
    const S drag = dragArea * f.speed;
    return {drag, drag + lift * f.speed, S{}, momentVolume * attached * f.along, damping * f.speed};
  }
};

struct BallLaw {
  double area, dragLow, dragDrop, criticalSpeed, inverseWidth, radius, liftMost, inverseScale;

  template <class S>
  [[gnu::always_inline]] S drag(const S& speed) const {
    const S e = expOf(S((speed - criticalSpeed) * inverseWidth));
    return area * (dragLow + dragDrop / (1.0 + e)) * speed;
  }
  /// From |u| and |w x u|: area CL |u|^2 / |w x u|, which is finite without spin.
  template <class S>
  [[gnu::always_inline]] S swerve(const S& speed, const S& sideways) const {
    const S y = sideways * radius * inverseScale / atLeast(S(speed * speed), 1e-300);
    const S near = 1.0 - y * (0.5 - y * (1.0 / 6 - y * (1.0 / 24)));
    const S share = y < 1e-3 ? near : (1.0 - expOf(S(-y))) / atLeast(y, 1e-3);
    return area * liftMost * radius * inverseScale * share;
  }
};

/// `Piece` holds a cubic for each of the four columns.
template <class Piece>
struct TableLaw {
  static constexpr bool kPushes = true;
  const Piece* pieces;
  int count;

  template <class Cubic>
  [[gnu::always_inline]] static double value(const Cubic& c, double t) {
    return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
  }
  /// Where the angle between k and u lies among the pieces: sine over the sum of sine and cosine runs evenly
  /// enough, and needs no arc tangent.
  [[gnu::always_inline]] double place(const Airflow<double>& f) const {
    const double sum = size(f.along) + f.across;
    const double quarter = f.across / atLeast(sum, 1e-150);
    return 0.5 * count * (f.along < 0.0 ? 2 - quarter : quarter);
  }
  [[gnu::always_inline]] Rates<double> rates(const Airflow<double>& f) const {
    const double at = place(f);
    const int i = at >= 0 ? (at < count ? static_cast<int>(at) : count - 1) : 0;
    const double t = at - i;
    const Piece& p = pieces[i];
    const double v = f.speed, push = v * v * value(p.along, t);
    const Rates<double> r{v * value(p.across, t), 0, push, v * value(p.turn, t), v * value(p.damp, t)};
    // What slows the motion along the axis goes with it: then no strength is too great for a step.
    const bool slows = (push < 0.0 ? -f.along : f.along) > 0.02 * v;
    return slows ? Rates<double>{r.across, push / f.along, 0, r.turn, r.damp} : r;
  }
};

}  // namespace
}  // namespace stadion
