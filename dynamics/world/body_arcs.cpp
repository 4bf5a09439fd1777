#include "dynamics/world/body_arcs.h"

#include "dynamics/maths/dormand_prince.h"
#include "dynamics/motion/drag_flight.h"

#include <cmath>

namespace stadion {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

struct State {
  Vec3 p, v;
};

/// One step of Dormand and Prince's pair of orders 5 and 4 for p'' = f(tau, p, v).
template <class F>
State dormandPrince(F f, double tau, const State& s, double h, double& error) {
  namespace pair = dormand_prince;
  Vec3 kp[7], kv[7];
  State y = s;
  for (int i = 0; i < 7; ++i) {
    y = s;
    for (int j = 0; j < i; ++j) {
      y.p += h * pair::kWeights[i][j] * kp[j];
      y.v += h * pair::kWeights[i][j] * kv[j];
    }
    kp[i] = y.v;
    kv[i] = f(tau + pair::kTimes[i] * h, y.p, y.v);
  }
  Vec3 ep = Vec3::Zero(), ev = Vec3::Zero();
  for (int i = 0; i < 7; ++i) {
    ep += h * pair::kError[i] * kp[i];
    ev += h * pair::kError[i] * kv[i];
  }
  error = std::max(ep.norm(), ev.norm());
  return y;
}

}  // namespace

void BodyArcs::setArc(RigidBody& b, double tau, const Path& path, const Spin& spin, double horizon,
                      BodyMode mode) {
  const auto sane = [](const Vec3& x, double most) {
    return x.cwiseAbs().maxCoeff() <= most;
  };  // false of NaN
  if (!spin.q0.coeffs().allFinite() || !spin.L.allFinite() || !sane(spin.L, 1e30) ||
      !spin.omega.allFinite() || !sane(spin.omega, 1e12)) {
    quarantine(b, tau, "its state would become infinite or undefined");
    return;
  }
  b.spin = spin;
  b.spinStart = 0;
  setPath(b, tau, path, horizon, mode);
}

/// A new path from tau on; the spin has its own beginning.
void BodyArcs::setPath(RigidBody& b, double tau, const Path& path, double horizon, BodyMode mode) {
  ++counters_.arcs;
  const auto sane = [](const Vec3& x) { return x.allFinite() && x.cwiseAbs().maxCoeff() <= 1e12; };
  if (!sane(path.c[0]) || !sane(path.c[1]) || !sane(path.c[2])) {
    quarantine(b, tau, "its state would become infinite or undefined");
    return;
  }
  if (&path != &b.path) b.path = path;
  const bool starts = standsStill(b.mode) && !standsStill(mode);
  b.mode = mode;
  b.since = time_.instantAt(tau);
  b.age0 = -tau;
  b.pathAge = horizon;
  b.validAge = std::min(horizon, b.spinStart + b.spin.horizon);
  b.contact.dueAge = 0;
  b.contact.sleepsNext = b.lazy = false;
  b.contact.restsInPile = b.contact.inPile && mode == BodyMode::Rest;
  b.contact.inPile = b.contact.inPile && mode == BodyMode::Contact;
  b.until = tau + b.validAge;
  ++b.version;
  if (mode != BodyMode::Flight && !b.contact.inPile) supports_.note(b);
  active_.add(b);
  if (starts) traces_.expectPartings(b, tau);
  traces_.note(b, tau);
  if (!changes_.immediate())
    changes_.mark(b);  // a change between frames is looked at when the next one begins
}

void BodyArcs::quarantine(RigidBody& b, double tau, std::string why) {
  b.trouble = std::move(why);
  const Pose X_WC = b.pose * b.X_NC;
  const bool usable = b.path.c[0].allFinite() && b.spin.q0.coeffs().allFinite();
  const Vec3 p = usable && b.position(tau).allFinite() && b.position(tau).cwiseAbs().maxCoeff() <= 1e12
                     ? b.position(tau)
                     : X_WC.p;
  const Quat q = usable && b.orientation(tau).coeffs().allFinite() ? b.orientation(tau) : X_WC.q;
  b.path = Path::still(p);
  b.spin = Spin::still(q);
  b.mode = BodyMode::Quarantined;
  b.since = time_.instantAt(tau);
  b.age0 = -tau;
  b.until = b.validAge = b.pathAge = kUnlimited;
  b.support.on = {};
  b.contact.touching.clear();
  ++b.version;
  traces_.note(b, tau);
}

void BodyArcs::startFlight(RigidBody& b, double tau, const Vec3& p, const Vec3& v, const Quat& q,
                           const Vec3& L) {
  if (b.support.on.id) memory_.setTouching(ContactMemory::keyOf(b.support.on, {true, b.id}), false);
  b.support.on = {};
  b.spin = b.flight ? spinFrom(b, tau, {p, v, q, L}) : Spin::free(q, L, b.inertia);
  b.spinStart = 0;
  if (!q.coeffs().allFinite() || !(L.cwiseAbs().maxCoeff() <= 1e30) || !L.allFinite()) {
    b.spin = Spin::still(b.pose.q * b.X_NC.q);
    quarantine(b, tau, "its state would become infinite or undefined");
    return;
  }
  if (b.flight && flyInAir(b, tau, {p, v, q, L})) return;
  fly(b, tau, p, v);
}

/// Flight under the even pull that the body knows; false if it is too near to standing in the air for a
/// series.
bool BodyArcs::resist(RigidBody& b, double tau, const Vec3& p, const Vec3& v) {
  const double horizon = dragFlight(p, v, b.even.pull, b.even.drag, 1.0, 5e-10, b.path);
  if (horizon > 1e-4) setPath(b, tau, b.path, horizon, BodyMode::Flight);
  return horizon > 1e-4;
}

/// Flight from here; the spin goes on as it is.
void BodyArcs::fly(RigidBody& b, double tau, const Vec3& p, const Vec3& v) {
  const auto even = fields_.evenPullOn(b);
  if (even && !even->drag.resists()) {
    setPath(b, tau, Path::parabola(p, v, even->pull, b.damping), kUnlimited, BodyMode::Flight);
    return;
  }
  if (even) {
    const Drag total{even->drag.linear + b.damping, even->drag.quadratic, even->drag.wind};
    b.even = {even->pull - b.damping * total.wind, total};
    if (resist(b, tau, p, v)) return;
  }
  const auto f = [&](double at, const Vec3& x, const Vec3& u) {
    return Vec3(fields_.accelerationAt(b, x, u, at) - b.damping * u);
  };
  double h = std::min({b.step > 0 ? b.step : 0.01, 0.05, fields_.knownFor(b, tau)}), error = 0;
  h = std::min(h, fields_.timeToPass(b, p, v, h * f(tau, p, v).norm()));
  State end{p, v};
  const double tolerance = 1e-13 * (1 + v.norm());
  for (int i = 0; i < 60; ++i) {
    end = dormandPrince(f, tau, {p, v}, h, error);
    if (error <= tolerance || !(error == error) || h < 1e-7) break;
    h *= std::clamp(0.9 * det::pow(tolerance / error, 0.2), 0.1, 0.8);
  }
  b.step = h * (error > 0 ? std::clamp(0.9 * det::pow(tolerance / error, 0.2), 0.3, 4.0) : 4.0);
  const Vec3 from[3] = {p, v, f(tau, p, v)}, to[3] = {end.p, end.v, f(tau + h, end.p, end.v)};
  setPath(b, tau, Path::hermite(from, to, h), h, BodyMode::Flight);
}

/// Starts a flight whose spin began earlier, unless the spin ends here as well. `pullsAsBefore`: the same
/// fields act on the body as in the last arc.
void BodyArcs::continueFlight(RigidBody& b, double tau, const Vec3& p, const Vec3& v, bool pullsAsBefore) {
  const double spinAge = b.spinAge(tau);
  if (b.flight) return startFlight(b, tau, p, v, b.orientation(tau), b.spin.angularMomentum(spinAge));
  if (spinAge > b.spin.horizon - 1e-9) return startFlight(b, tau, p, v, b.orientation(tau), b.spin.L);
  b.spinStart = -spinAge;
  if (pullsAsBefore && b.path.isSeries() && resist(b, tau, p, v)) return;
  fly(b, tau, p, v);
}

/// An arc of flight has ended, the motion goes on as it was. False if only the expansion of the spin has worn
/// out.
bool BodyArcs::flyOn(RigidBody& b, double tau) {
  const double age = b.age(tau);
  if (age < b.pathAge - 1e-9) {
    const Quat q = b.orientation(tau);
    setSpin(b, tau,
            b.flight ? spinFrom(b, tau, {b.position(tau), b.velocity(tau), q, b.angularMomentum(tau)})
                     : Spin::free(q, b.spin.L, b.inertia));
    return false;
  }
  continueFlight(b, tau, b.position(tau), b.velocity(tau), true);
  return true;
}

/// How long a ball stays at rest on its face: until what pulls at it, as far as that is known, becomes too
/// much for friction [s].
double BodyArcs::restLasts(const RigidBody& b, const BallStart& s, double tau) const {
  const double known = fields_.knownFor(b, tau);
  const auto rests = [&](double after) {
    const Vec3 a = fields_.accelerationAt(b, s.p, s.v, tau + after);
    const BallArc arc = ballOnFace(s, b.support, a, b.radius(), b.mass, b.inertia.x(), true, true);
    return !arc.leaves && arc.mode == BodyMode::Rest;
  };
  if (known == kUnlimited || rests(known)) return kUnlimited;
  // What keeps a ball at rest is a cone of pulls: one that goes evenly from inside to outside leaves it once.
  double holds = 0, breaks = known;
  for (int i = 0; i < 60 && breaks - holds > 1e-12; ++i) {
    const double middle = 0.5 * (holds + breaks);
    (rests(middle) ? holds : breaks) = middle;
  }
  return breaks;
}

/// The next arc of a ball that touches its face. Pulls that are not the same everywhere and always are taken
/// from the middle of a short step.
BallArc BodyArcs::arcOnFace(const RigidBody& b, double tau, const BallStart& s, bool gripped,
                            bool stopped) const {
  const auto arcUnder = [&](const Vec3& a) {
    return ballOnFace(s, b.support, a, b.radius(), b.mass, b.inertia.x(), gripped, stopped);
  };
  const Vec3 a = fields_.accelerationAt(b, s.p, s.v, tau);
  BallArc arc = arcUnder(a);
  if (fields_.uniformFor(b) || arc.leaves) return arc;
  if (arc.mode == BodyMode::Rest) {
    arc.horizon = restLasts(b, s, tau);
    return arc;
  }
  double step = std::min(grid_.faceStep(), fields_.knownFor(b, tau));
  const Vec3 along = a - b.support.normal * b.support.normal.dot(a);
  const auto arcAfter = [&](double after) {
    const Vec3 p = s.p + after * (s.v + 0.5 * after * along), v = s.v + after * along;
    return arcUnder(fields_.accelerationAt(b, p, v, tau + after));
  };
  if (arcAfter(step).leaves) {  // when it does so is the end of the step
    double holds = 0;
    while (step - holds > 1e-12) {
      const double middle = 0.5 * (holds + step);
      (arcAfter(middle).leaves ? step : holds) = middle;
    }
  }
  if (const BallArc better = arcAfter(0.5 * step); !better.leaves) arc = better;
  arc.horizon = arc.mode == BodyMode::Rest ? step : std::min(arc.horizon, step);
  return arc;
}

void BodyArcs::startOnFace(RigidBody& b, double tau, const BallStart& s, bool gripped, bool stopped) {
  const ContactSide self{true, b.id};
  const BallArc arc = arcOnFace(b, tau, s, gripped, stopped);
  if (arc.leaves) {
    startFlight(b, tau, s.p, s.v, s.q, b.inertia.x() * s.omega);
    return;
  }
  memory_.setTouching(ContactMemory::keyOf(b.support.on, self), true);
  if (arc.mode == BodyMode::Rest) b.contact.touching = {b.support.on};
  if (b.damping > 0 && arc.mode != BodyMode::Rest) {
    // Drag on top of friction: short arcs of mean deceleration.
    Path path = arc.path;
    const double h = std::min(arc.horizon, grid_.faceStep());
    path.c[2] -= 0.5 * b.damping * path.c[1];
    path.degree = 2;
    setArc(b, tau, path, arc.spin, h, arc.mode);
    return;
  }
  setArc(b, tau, arc.path, arc.spin, arc.horizon, arc.mode);
}

void BodyArcs::freeze(RigidBody& b, double tau) {
  setArc(b, tau, Path::still(b.position(tau)), Spin::still(b.orientation(tau)), kUnlimited, BodyMode::Rest);
}

}  // namespace stadion
