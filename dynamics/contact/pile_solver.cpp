#include "dynamics/contact/pile_solver.h"

#include "dynamics/contact/pile_energy.h"
#include "dynamics/maths/double4.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr int kJumps = 12, kShifts = 4;
constexpr int kSweeps = 14,
              kStillSweeps = 16;           ///< while it moves; when it comes to rest, and sleep depends on it
constexpr int kMostSweeps = 500;           ///< of small heaps ...
constexpr std::size_t kPileSwept = 40000;  ///< ... and the points that these relax in all
constexpr double kConverged = 1e-8;        ///< a sweep that changes less is the last there [m/s]
constexpr double kSlow = 0.1;              ///< root mean square speed at rest, nearly [m/s]
constexpr double kSettled = 1e-5;          ///< a sweep that changes less is the last [m/s]
constexpr double kSlop = 1e-4;             ///< overlap that is left alone [m]
constexpr double kDeep = 2e-2;             ///< overlap that no step leaves behind: the body was put there [m]
constexpr double kShare = 0.3;             ///< of deeper overlap that a step takes back
constexpr double kMostShift = 2e-3;        ///< in a step [m]
constexpr double kBounceSpeed = 0.5;       ///< slower approaches do not bounce [m/s]

/// Reads the three numbers and the double behind them, which PileBody and PileContact provide, in one load.
inline void load(const Vec3& v, Double4& to) {
  __builtin_memcpy(&to, v.data(), sizeof to);
}
inline void store(const Double4& from, Vec3& v) {
  __builtin_memcpy(v.data(), &from, sizeof from);
}
/// Of the first three.
inline double dot(const Double4& a, const Double4& b) {
  const Double4 each = a * b;
  return each[0] + each[1] + each[2];
}
inline void cross(const Double4& a, const Double4& b, Double4& product) {
  const Double4 nextA{a[1], a[2], a[0], a[3]}, nextB{b[1], b[2], b[0], b[3]};
  const Double4 turned = a * nextB - nextA * b;  // (z, x, y)
  product = Double4{turned[1], turned[2], turned[0], turned[3]};
}

class PileSolver {
public:
  explicit PileSolver(Pile& pile) : pile_(pile), energy_(pile) {}
  void solve();

private:
  double response(std::uint32_t body, const Vec3& arm, const Vec3& along) const;
  double normalVelocity(const PileContact& c) const;
  void prepare(PileContact& c) const;
  void give(const PileContact& c, double pressed, const Vec3& tangential);
  double relax(PileContact& c);
  double sweepAll(bool forward);
  double sweepAvx2(bool forward);
  double sweep(bool forward);
  double meanSquare() const;
  int sweepsFor(std::size_t points) const;
  void converge(int most);
  void go(PileContact& c, double pressed, const Vec3& tangential);
  void jump();
  void shift();
  void push();

  struct Guess {
    double pressed;
    Vec3 tangential;
  };
  Pile& pile_;
  PileEnergy energy_;
  std::vector<Guess> guess_;
  std::vector<Guess> before_, direction_;
};

double PileSolver::response(std::uint32_t body, const Vec3& arm, const Vec3& along) const {
  const PileBody& b = pile_.bodies[body];
  if (b.inverseMass == 0) return 0;
  const Vec3 c = arm.cross(along);
  return b.inverseMass +
         (b.roundInertia > 0 ? b.roundInertia * c.squaredNorm() : c.dot(pile_.inverseInertia[body] * c));
}

double PileSolver::normalVelocity(const PileContact& c) const {
  const PileBody &a = pile_.bodies[c.a], &b = pile_.bodies[c.b];
  if (c.arms < 0) return (a.v - b.v).dot(c.n);
  const PileArms& arms = pile_.arms[static_cast<std::size_t>(c.arms)];
  return (a.v + a.omega.cross(arms.a) - b.v - b.omega.cross(arms.b)).dot(c.n);
}

/// What an impulse changes, along the normal and (at most) across it.
void PileSolver::prepare(PileContact& c) const {
  const PileBody &a = pile_.bodies[c.a], &b = pile_.bodies[c.b];
  double kn = a.inverseMass + b.inverseMass, kt = kn;
  if (c.arms < 0) {
    kt += a.roundInertia * c.leverA * c.leverA + b.roundInertia * c.leverB * c.leverB;
  } else {
    const PileArms& arms = pile_.arms[static_cast<std::size_t>(c.arms)];
    const Vec3 t1 = (std::fabs(c.n.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY()).cross(c.n).normalized(),
               t2 = c.n.cross(t1);
    kn = response(c.a, arms.a, c.n) + response(c.b, arms.b, c.n);
    kt = response(c.a, arms.holdA, t1) + response(c.b, arms.holdB, t1) + response(c.a, arms.holdA, t2) +
         response(c.b, arms.holdB, t2);
  }
  c.normalMass = kn > 0 ? 1 / kn : 0;
  c.tangentMass = kt > 0 ? 1 / kt : 0;
}

void PileSolver::give(const PileContact& c, double pressed, const Vec3& tangential) {
  PileBody &a = pile_.bodies[c.a], &b = pile_.bodies[c.b];
  const Vec3 push = pressed * c.n, impulse = push + tangential;
  a.v += a.inverseMass * impulse;
  b.v -= b.inverseMass * impulse;
  if (c.arms < 0) {
    const Vec3 turn = c.n.cross(impulse);
    a.omega -= a.roundInertia * c.leverA * turn;
    b.omega -= b.roundInertia * c.leverB * turn;
    return;
  }
  const PileArms& arms = pile_.arms[static_cast<std::size_t>(c.arms)];
  const auto turn = [&](PileBody& body, std::uint32_t i, const Vec3& moment) {
    if (body.roundInertia > 0)
      body.omega += body.roundInertia * moment;
    else if (body.inverseMass > 0)
      body.omega += pile_.inverseInertia[i] * moment;
  };
  turn(a, c.a, arms.a.cross(push) + arms.holdA.cross(tangential));
  turn(b, c.b, -arms.b.cross(push) - arms.holdB.cross(tangential));
}

/// One pass over a point; returns the greatest change of a velocity, squared.
double PileSolver::relax(PileContact& c) {
  const PileBody &a = pile_.bodies[c.a], &b = pile_.bodies[c.b];
  const PileArms& arms = pile_.arms[static_cast<std::size_t>(c.arms)];
  const Vec3 apart = a.v - b.v, u = apart + a.omega.cross(arms.a) - b.omega.cross(arms.b);
  const double pressed = std::max(0.0, c.pressed + (c.floor - u.dot(c.n)) * c.normalMass);
  if (pressed == 0 && c.pressed == 0) return 0;
  const Vec3 slip = apart + a.omega.cross(arms.holdA) - b.omega.cross(arms.holdB);
  Vec3 tangential = c.tangential - c.tangentMass * (slip - slip.dot(c.n) * c.n);
  const double most = c.friction * pressed, size = tangential.squaredNorm();
  if (size > most * most) tangential *= most / std::sqrt(size);
  const double more = pressed - c.pressed;
  const Vec3 hold = tangential - c.tangential, step = more * c.n + hold;
  c.pressed = pressed;
  c.tangential = tangential;
  give(c, more, hold);
  const double mass = std::max(a.inverseMass, b.inverseMass);
  return step.squaredNorm() * mass * mass;
}

/// The same where both sides are balls, or moved by nothing: the normal does not turn them.
[[gnu::always_inline]] inline double relaxRound(PileContact& c, std::vector<PileBody>& bodies) {
  constexpr Double4 kThree{1, 1, 1, 0};
  PileBody &a = bodies[c.a], &b = bodies[c.b];
  Double4 n, va, vb, wa, wb, before;
  load(c.n, n);
  load(a.v, va);
  load(b.v, vb);
  const Double4 apart = va - vb;
  const double un = dot(apart, n), pressed = std::max(0.0, c.pressed + (c.floor - un) * c.normalMass);
  if (pressed == 0 && c.pressed == 0) return 0;
  load(a.omega, wa);
  load(b.omega, wb);
  load(c.tangential, before);
  const Double4 rolls = c.leverA * wa + c.leverB * wb;
  Double4 across, turn;
  cross(rolls, n, across);
  Double4 tangential = before - c.tangentMass * (apart - un * n - across);
  const double most = c.friction * pressed, size = dot(tangential, tangential);
  if (size > most * most) tangential *= most / std::sqrt(size);
  const Double4 step = kThree * ((pressed - c.pressed) * n + (tangential - before));
  tangential[3] = c.floor;
  c.pressed = pressed;
  store(tangential, c.tangential);
  cross(n, step, turn);
  store(va + a.inverseMass * step, a.v);
  store(vb - b.inverseMass * step, b.v);
  store(wa - a.roundInertia * c.leverA * turn, a.omega);
  store(wb - b.roundInertia * c.leverB * turn, b.omega);
  const double mass = std::max(a.inverseMass, b.inverseMass);
  return dot(step, step) * mass * mass;
}

[[gnu::always_inline]] inline double PileSolver::sweepAll(bool forward) {
  double change = 0;
  std::vector<PileContact>& all = pile_.contacts;
  const std::size_t n = all.size();
  for (std::size_t i = 0; i < n; ++i) {
    PileContact& c = all[forward ? i : n - 1 - i];
    change = std::max(change, c.arms < 0 ? relaxRound(c, pile_.bodies) : relax(c));
  }
  return change;
}
[[gnu::target("avx2")]] double PileSolver::sweepAvx2(bool forward) {
  return sweepAll(forward);
}
double PileSolver::sweep(bool forward) {
  return hasAvx2() ? sweepAvx2(forward) : sweepAll(forward);
}

/// So many sweeps relax so many points. Balls do not pile up high: they need no more than usual.
int PileSolver::sweepsFor(std::size_t points) const {
  return pile_.arms.empty() ? 0 : static_cast<int>(points / pile_.contacts.size());
}

/// Changes what a contact point pushes.
void PileSolver::go(PileContact& c, double pressed, const Vec3& tangential) {
  give(c, pressed, tangential);
  c.pressed += pressed;
  c.tangential += tangential;
}

/// Small heaps can afford more sweeps, and need them where they are tall. What a sweep did is a gradient: the
/// next one begins farther along it, conjugate to where it went before (Silcowitz, Niebe and Erleben 2010).
void PileSolver::converge(int most) {
  std::vector<PileContact>& all = pile_.contacts;
  const std::size_t n = all.size();
  before_.resize(n);
  direction_.assign(n, {0, Vec3::Zero()});
  double last = 0;
  for (int i = 0; i < most; ++i) {
    for (std::size_t k = 0; k < n; ++k) before_[k] = {all[k].pressed, all[k].tangential};
    if (sweep(i % 2 == 0) < kConverged * kConverged || i + 1 == most) return;
    double square = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const double dp = all[k].pressed - before_[k].pressed;
      square += (dp * dp + (all[k].tangential - before_[k].tangential).squaredNorm()) /
                std::max(all[k].normalMass, 1e-300);
    }
    const double beta = last > 0 ? square / last : 2;
    last = square;
    if (beta > 1) {
      for (Guess& d : direction_) d = {0, Vec3::Zero()};
      continue;
    }
    for (std::size_t k = 0; k < n; ++k) {
      const Guess step{beta * direction_[k].pressed, beta * direction_[k].tangential};
      direction_[k] = {step.pressed + all[k].pressed - before_[k].pressed,
                       step.tangential + all[k].tangential - before_[k].tangential};
      if (step.pressed != 0 || !step.tangential.isZero(0)) go(all[k], step.pressed, step.tangential);
    }
  }
}

/// Of the members' speeds at the step's start [m2/s2].
double PileSolver::meanSquare() const {
  double sum = 0;
  for (std::size_t i = 0; i < pile_.members; ++i) sum += pile_.start[i].v.squaredNorm();
  return sum / static_cast<double>(std::max<std::size_t>(pile_.members, 1));
}

/// Bodies that would meet within the step bounce now, or slow down so far that they just meet.
void PileSolver::jump() {
  bool any = false;
  for (PileContact& c : pile_.contacts) {
    const double closing = -normalVelocity(c), gap = std::max(c.gap, 0.0) / pile_.h;
    c.floor = closing > kBounceSpeed && closing > gap ? c.restitution * closing : -gap;
    any = any || closing > gap + kSettled;
    c.pressed = 0;
    c.tangential.setZero();
  }
  if (!any) return;
  const std::vector<PileBody> before = pile_.bodies;
  const int affordable = sweepsFor(kPileSwept / 4);
  for (int i = 0; i < std::clamp(affordable, kJumps, kMostSweeps); ++i)
    if (sweep(i % 2 != 0) < kSettled * kSettled) break;
  energy_.boundJump(pile_, before);
}

/// Takes back a share of what overlaps; what is in the way moves along.
void PileSolver::shift() {
  pile_.shift.assign(pile_.bodies.size(), Vec3::Zero());
  bool any = false;
  for (PileContact& c : pile_.contacts) {
    c.floor = c.gap < -kSlop ? std::min(kMostShift, kShare * (-kSlop - c.gap)) : std::min(0.0, -c.gap);
    any = any || c.floor > 0;
    c.pressed = 0;
  }
  if (!any) return;
  std::vector<Vec3>& d = pile_.shift;
  for (int i = 0; i < kShifts; ++i)
    for (PileContact& c : pile_.contacts) {
      const double ka = pile_.bodies[c.a].inverseMass, kb = pile_.bodies[c.b].inverseMass;
      const double more = std::max(-c.pressed, (c.floor - (d[c.a] - d[c.b]).dot(c.n)) / (ka + kb));
      c.pressed += more;
      d[c.a] += more * ka * c.n;
      d[c.b] -= more * kb * c.n;
    }
  energy_.payShift(pile_, kDeep);
  for (PileContact& c : pile_.contacts) c.gap += (d[c.a] - d[c.b]).dot(c.n);
}

/// Forces through the step.
void PileSolver::push() {
  std::vector<PileContact>& all = pile_.contacts;
  for (std::size_t k = 0; k < all.size(); ++k) {
    PileContact& c = all[k];
    c.pressed = guess_[k].pressed;
    c.tangential = guess_[k].tangential;
    c.floor = std::min(0.0, -2 * std::max(c.gap, 0.0) / pile_.h - normalVelocity(c));
  }
  pile_.start = pile_.bodies;
  for (std::size_t i = 0; i < pile_.members; ++i) pile_.bodies[i].v += pile_.h * pile_.pull[i];
  for (const PileContact& c : all)
    if (c.pressed > 0) give(c, c.pressed, c.tangential);
  const bool still = meanSquare() < kSlow * kSlow;
  const int sweeps = still ? kStillSweeps : kSweeps;
  const int affordable = sweepsFor(still ? kPileSwept : kPileSwept / 4);
  if (affordable > 2 * sweeps) {
    converge(std::min(affordable, kMostSweeps));
  } else {
    for (int i = 0; i < sweeps; ++i)
      if (sweep(i % 2 == 0) < kSettled * kSettled) break;
  }
  for (const PileContact& c : all) {  // rolling resistance takes spin
    if (!(c.rolling * c.pressed > 0)) continue;
    PileBody& a = pile_.bodies[c.a];
    const double most = c.rolling * c.pressed * a.roundInertia, w = a.omega.norm();
    if (w > 0) a.omega *= std::max(0.0, 1 - most / w);
  }
  energy_.boundWork(pile_);
}

void PileSolver::solve() {
  guess_.reserve(pile_.contacts.size());
  for (PileContact& c : pile_.contacts) {
    prepare(c);
    guess_.push_back({c.pressed, c.tangential});
  }
  jump();
  shift();
  push();
}

}  // namespace

void solvePile(Pile& pile) {
  PileSolver(pile).solve();
}

}  // namespace stadion
