#pragma once
/// One step of a body of revolution through air, in lanes. Internal to dynamics/flight/.
///
/// Half a step of free flight, all of the air's kick, half a step of free flight (Strang splitting). Free
/// flight is exact: parabola and symmetric top. With L the angular momentum in World, q' = exp(h L / It) q
/// exp(h Om k), Om = L.k (1/Ia - 1/It). The kick takes the air's rates as they are in the middle of the step;
/// drag is the exact flow v / (1 + rate h), which no strength makes unstable.
///
/// Linkage  internal; includes nothing but laws.h (see lanes.h).

#include "dynamics/flight/laws.h"

namespace stadion {
namespace {

/// Everything of a step that is the same for all bodies of a kind.
struct StepNumbers {
  double gravity[3], wind[3];
  double h, half;        ///< the step, and half of it [s]
  double fall;           ///< h^2 / 8
  double quarterTurn;    ///< h / (4 It): half the angle that L turns the body by in half a step
  double spinTurn;       ///< h/2 (1/Ia - 1/It)
  double inverseAcross;  ///< 1 / It
  double kick;           ///< rho h / (2 m)
  double twist;          ///< rho h / 2
};

template <class S>
struct Motion {
  V3<S> p, v;
  Q4<S> q;
  V3<S> L;
};

template <class S>
struct HalfAngle {
  S sinc, cosine;  ///< sin(a) / a and cos(a)
};
constexpr double kSmallSquare = 0.6;

template <class S>
[[gnu::always_inline]] inline bool anyAbove(const S& z, double limit) {
  if constexpr (sizeof(S) == sizeof(double))
    return z > limit;
  else {
    const auto above = z > limit;
    long long some = 0;
    for (unsigned i = 0; i < sizeof(S) / sizeof(double); ++i) some |= above[i];
    return some != 0;
  }
}

/// From the square of the angle.
template <class S>
[[gnu::always_inline]] inline HalfAngle<S> halfAngle(const S& z) {
  HalfAngle<S> a{sincOf(z), cosOf(z)};
  if (anyAbove(z, kSmallSquare)) [[unlikely]] {
    const S angle = root(z);
    const Turn<S> t = turn(angle);
    a.sinc = z > kSmallSquare ? t.sine / angle : a.sinc;
    a.cosine = z > kSmallSquare ? t.cosine : a.cosine;
  }
  return a;
}

/// exp(2 f L) q.
template <class S>
[[gnu::always_inline]] inline Q4<S> turnedBy(const V3<S>& L, double f, const Q4<S>& q) {
  const V3<S> half = S(all<S>(f)) * L;
  const HalfAngle<S> a = halfAngle(S(dot(half, half)));
  return Q4<S>{a.cosine, a.sinc * half.x, a.sinc * half.y, a.sinc * half.z} * q;
}

/// q exp(2 half k), its length brought back to one.
template <int Axis, class S>
[[gnu::always_inline]] inline Q4<S> spunBy(const Q4<S>& q, const S& half) {
  const HalfAngle<S> a = halfAngle(S(half * half));
  const S n = 1.5 - 0.5 * ((q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z));
  const S s = n * a.sinc * half, c = n * a.cosine;
  if constexpr (Axis == 0)
    return {q.w * c - q.x * s, q.x * c + q.w * s, q.y * c + q.z * s, q.z * c - q.y * s};
  else
    return {q.w * c - q.z * s, q.x * c + q.y * s, q.y * c - q.x * s, q.z * c + q.w * s};
}

template <class S>
[[gnu::always_inline]] inline V3<S> spread(const double (&v)[3]) {
  return {all<S>(v[0]), all<S>(v[1]), all<S>(v[2])};
}

/// Half a step of the centre.
template <class S>
[[gnu::always_inline]] inline void fall(const StepNumbers& n, const V3<S>& g, Motion<S>& m) {
  m.p = m.p + S(all<S>(n.half)) * m.v + S(all<S>(n.fall)) * g;
  m.v = m.v + S(all<S>(n.half)) * g;
}

/// The exact flow of what slows at this rate times the step; what drives instead is left as it is.
template <class S>
[[gnu::always_inline]] inline S kept(const S& x) {
  return x > 0.0 ? 1.0 / (1.0 + x) : 1.0 - x;
}

/// Changes velocity and angular momentum by the push of the air, which moves with the wind, in a step.
/// `axial` is L.k, which stays constant.
template <class Law, class S>
[[gnu::always_inline]] inline void kick(const Law& law, const StepNumbers& n, const V3<S>& k, const S& axial,
                                        Motion<S>& m) {
  const V3<S> wind = spread<S>(n.wind), u = m.v - wind;
  const Crossing<S> c = crossing(u, k);
  const Rates<S> r = law.rates(c.flow);
  const S across = kept(S(n.kick * r.across)), along = kept(S(n.kick * r.along));
  S forward = (along - across) * c.flow.along;
  if constexpr (Law::kPushes) {  // not by more than the speed
    const S push = n.kick * r.push, speed = atLeast(c.flow.speed, 1e-150);
    forward = forward - push * speed / root(S(speed * speed + push * push));
  }
  m.v = wind + across * u + forward * k;
  const S damped = 1.0 / (1.0 + n.twist * n.inverseAcross * r.damp);
  // A moment goes with two powers of u_p: as it is in the middle of the kick.
  const S lever = n.twist * r.turn * atLeast(S(1.0 - n.kick * r.across), 0.0);
  m.L = (damped * m.L + S((1.0 - damped) * axial) * k) + lever * c.lift;
}

template <int Axis, class Law, class S>
[[gnu::always_inline]] inline void revolvedStep(const Law& law, const StepNumbers& n, Motion<S>& m) {
  const V3<S> g = spread<S>(n.gravity);
  fall(n, g, m);
  m.q = turnedBy(m.L, n.quarterTurn, m.q);
  const V3<S> k = axisOf<Axis>(m.q);
  const S axial = dot(m.L, k);
  kick(law, n, k, axial, m);
  m.q = turnedBy(m.L, n.quarterTurn, spunBy<Axis>(m.q, S(n.spinTurn * axial)));
  fall(n, g, m);
}

/// Without air.
template <int Axis, class S>
[[gnu::always_inline]] inline void freeStep(const StepNumbers& n, Motion<S>& m) {
  const V3<S> g = spread<S>(n.gravity);
  const S spin = n.spinTurn * dot(m.L, axisOf<Axis>(m.q));
  m.p = m.p + S(all<S>(n.h)) * m.v + S(all<S>(4 * n.fall)) * g;
  m.v = m.v + S(all<S>(n.h)) * g;
  m.q = turnedBy(m.L, 2 * n.quarterTurn, spunBy<Axis>(m.q, spin));
}

/// Magnus lift turns the velocity, drag shortens it; a ball's spin lasts.
template <class S>
[[gnu::always_inline]] inline void ballStep(const BallLaw& law, const StepNumbers& n, Motion<S>& m) {
  const V3<S> g = spread<S>(n.gravity), wind = spread<S>(n.wind);
  fall(n, g, m);
  const V3<S> u = m.v - wind, w = S(all<S>(n.inverseAcross)) * m.L, side = cross(w, u);
  const S speed = root(S(dot(u, u)));
  const S swerve = law.swerve(speed, root(S(dot(side, side)))), slow = kept(S(n.kick * law.drag(speed)));
  const V3<S> c = S(0.5 * n.kick * swerve) * w;
  const V3<S> turned = u + S(2.0 / (1.0 + dot(c, c))) * cross(c, u + cross(c, u));
  m.v = wind + slow * turned;
  m.q = turnedBy(m.L, 2 * n.quarterTurn, spunBy<0>(m.q, S{}));
  fall(n, g, m);
}

}  // namespace
}  // namespace stadion
