#include "dynamics/world/impacts.h"

#include "dynamics/contact/patch_impact.h"
#include "dynamics/world/ball_support.h"
#include "dynamics/world/piles.h"

#include <cmath>

namespace stadion {
namespace {

/// Bounces that would rise less than this are over [m]: all that follow are lower still, and last for less
/// than two milliseconds on earth with a restitution of 0.8.
constexpr double kLastBounce = 1e-7;
/// Likewise, between bodies that have no closed form to rest in [m].
constexpr double kLastRattle = 1e-6;
constexpr double kExact =
    1e-9;  ///< a touch is taken to its surface from no farther, so that no body is lifted [m]
constexpr Nanoseconds kSpan = 16'000'000;     ///< in which impacts are counted [ns]
constexpr std::uint32_t kMostImpacts = 60;    ///< in that time, then the contact solver takes over
constexpr std::uint32_t kMostRattles = 4;     ///< the same where bounces die away soon
constexpr std::uint32_t kMostInThick = 1;     ///< and among many balls, which will lean on each other anyway
constexpr std::uint32_t kMostFolds = 200;     ///< and of faces that a ball rolls over
constexpr std::uint32_t kMostBounces = 2000;  ///< of a ball on a face
constexpr double kLeastEmbeddingSpeed = 1;    ///< what comes slower does not stick [m/s]
constexpr std::uint32_t kMostElastic =
    600;  ///< where nothing is lost: no bounces that die away, but squeezes

/// Returns true if a body that may stick meets x with its tip, straight enough against the normal n.
bool embedsTip(const RigidBody& b, const Vec3& x, const Vec3& n, double closing, double tau) {
  if (!(closing > kLeastEmbeddingSpeed)) return false;
  const Pose X_WN = b.poseAt(tau);
  return -(X_WN.q * b.embedding->nose).dot(n) >= b.embedding->cosine &&
         b.embedding->nose.dot(X_WN.inverse() * x) >= b.embedding->tip - b.embedding->reach;
}

}  // namespace

/// Chatter is counted in show time, so that it does not depend on frames.
void Impacts::countImpact(RigidBody& b, double tau) const {
  const Nanoseconds span = time_.timeAt(tau) / kSpan;
  if (span != b.impactSpan) {
    b.impactSpan = span;
    b.impacts = 0;
  }
  ++b.impacts;
}

/// The rest of a pile's step with other velocities, under the same forces.
void Impacts::strikeInPile(RigidBody& b, const SolverBody& m, double tau) {
  const Quat q = b.orientation(tau);
  const double left = b.contact.dueAge - b.age(tau), quiet = b.contact.quietTime;
  const Vec3 a = left > 0 && b.path.isParabola() ? Vec3(2 * b.path.c[2]) : Vec3(Vec3::Zero());
  const Vec3 before = b.angularVelocity(tau), L = b.angularMomentum(tau);
  const Vec3 more = q * b.inertia.cwiseProduct(q.conjugate() * (m.omega - before));
  const Vec3 end = b.contact.endL + more;
  Spin spin = Spin::free(q, left > 0 ? Vec3(0.5 * (L + more + end)) : Vec3(L + more), b.inertia);
  if (b.spin.kind == Spin::Kind::Driven) spin = Spin::driven(q, m.omega, b.spin.alpha, b.inertia.x());
  arcs_.setArc(b, tau, Path::parabola(b.position(tau), m.v, a), spin, std::max(left, grid_.islandStep()),
               BodyMode::Contact);
  if (b.mode != BodyMode::Contact) return;
  b.contact.endL = end;
  b.contact.dueAge = left > 0 ? left : grid_.untilPileStep(time_.instantAt(tau));
  b.contact.quietTime = quiet;
  boxes_.sweep(b, tau);
}

/// The body goes on with the velocities of m.
void Impacts::afterImpulse(RigidBody& b, const SolverBody& m, double tau, bool lasting) {
  if (!b.movable()) return;
  releases_.expectPartings(b, tau);
  const Vec3& p = m.p;
  const Quat& q = m.q;
  if (b.contact.inPile) return strikeInPile(b, m, tau);
  const Vec3 L = q * b.inertia.cwiseProduct(q.conjugate() * m.omega);
  const bool leaning = b.mode == BodyMode::Contact || (b.mode == BodyMode::Rest && !b.support.on.id);
  if (lasting || leaning) {
    if (b.mode == BodyMode::Rest) waking_.wake(b, tau);
    if (b.contact.inPile) return strikeInPile(b, m, tau);
    b.contact.endL = L;
    arcs_.setArc(b, tau, Path::parabola(p, m.v, Vec3::Zero()), Spin::free(q, L, b.inertia),
                 grid_.islandStep(), BodyMode::Contact);
    if (b.mode != BodyMode::Contact) return;
    b.contact.quietTime = 0;
    queue_.scheduleTick(tau);
    foresight_.predict(b, tau);
    return;
  }
  if (b.support.on.id && b.mode != BodyMode::Flight) {
    const double away = m.v.dot(b.support.normal);
    if (std::fabs(away) <= 1e-9) {
      const bool rested = b.mode == BodyMode::Rest;
      arcs_.startOnFace(b, tau, {p, m.v, m.omega, q}, false, false);
      if (rested && b.mode != BodyMode::Rest) waking_.wakeOnto({true, b.id}, tau);
      foresight_.predict(b, tau);
      return;
    }
  }
  waking_.wakeOnto({true, b.id}, tau);
  if (b.mode == BodyMode::Flight && b.path.isParabola() &&
      !b.flight) {  // what pulls at it is the same as before
    arcs_.setArc(b, tau, Path::parabola(p, m.v, 2 * b.path.c[2]), Spin::free(q, L, b.inertia),
                 std::numeric_limits<double>::infinity(), BodyMode::Flight);
  } else {
    arcs_.startFlight(b, tau, p, m.v, q, L);
  }
  if (b.movable()) foresight_.predict(b, tau);
}

/// It stays as it is when its tip, which comes at `v`, has gone in, until what it sticks in goes or moves. It
/// stops within milliseconds: that time is left out.
void Impacts::embedTip(RigidBody& b, ContactSide in, const Vec3& v, double tau) {
  waking_.wakeOnto({true, b.id}, tau);
  b.support.on = {};
  b.contact.touching = {in};
  memory_.setTouching(ContactMemory::keyOf(in, {true, b.id}), true);
  arcs_.setArc(b, tau, Path::still(b.position(tau) + b.embedding->depth * v.normalized()),
               Spin::still(b.orientation(tau)), std::numeric_limits<double>::infinity(), BodyMode::Stuck);
}

/// A touch of body `a` with another side, and what an impact there needs.
struct Impacts::Collision {
  const Touch& touch;  ///< its normal points to `a`
  ContactSide pa, pb;
  double tau;  ///< [s]
  RigidBody& a;
  RigidBody* b;  ///< the other side: exactly one of these two
  Collider* c;
  SolverBody ma, mb;  ///< receive the impulse
  Vec3 n, x;          ///< normal and point
  double closing;     ///< speed along the normal [m/s]
  ContactMemory::Key key;
  Vec3 outwards;  ///< the normal, as the key orders the two
  bool awaited;   ///< the release of the pair is awaited

  bool movable() const { return a.movable() || (b && b->movable()); }
  bool embeds() const { return a.embedding && c && !c->motion.moving && embedsTip(a, x, n, closing, tau); }
};

Impacts::Collision Impacts::collisionOf(const Touch& touch, ContactSide pa, ContactSide pb,
                                        double tau) const {
  RigidBody& a = *objects_.body(pa.id);
  RigidBody* b = pb.isBody ? objects_.body(pb.id) : nullptr;
  Collider* c = pb.isBody ? nullptr : objects_.collider(pb.id);
  const SolverBody ma = solverBodyOf(a, tau), mb = b ? solverBodyOf(*b, tau) : solverBodyOf(*c, tau);
  const Vec3 n = touch.gap.normal;
  // What presses a ball at its middle does not turn it, not even by rounding.
  const Vec3 x = a.centred ? Vec3(ma.p - (a.radius() + touch.gap.distance) * n) : touch.gap.point;
  const double closing = -(ma.velocityAt(x) - mb.velocityAt(x)).dot(n);
  const ContactMemory::Key key = ContactMemory::keyOf(pa, pb);
  const Vec3 outwards = key.second == pa.id ? n : Vec3(-n);
  const bool awaited = std::isfinite((key.second == pa.id ? a : *b).releaseDistance);
  return {touch, pa, pb, tau, a, b, c, ma, mb, n, x, closing, key, outwards, awaited};
}

void Impacts::onTouch(const Touch& touch, ContactSide pa, ContactSide pb, double tau) {
  if (!pa.isBody) {
    std::swap(pa, pb);
    Touch t = touch;
    t.gap.normal = -t.gap.normal;
    onTouch(t, pa, pb, tau);
    return;
  }
  Collision at = collisionOf(touch, pa, pb, tau);
  ++counters_.impacts;
  countImpact(at.a, tau);
  if (at.b) countImpact(*at.b, tau);
  if (at.awaited) releases_.releaseBefore(at.key, tau);
  if (!at.movable())
    touchImmovable(at);
  else if (at.embeds())
    embed(at);
  else
    bounce(at);
}

ContactMemory::Waiting* Impacts::record(const Collision& at, const Vec3& x, double impulse) {
  return memory_.impact(at.key, time_.timeAt(at.tau), x, at.outwards, at.closing, impulse, time_.frame(),
                        at.awaited);
}

/// Neither side moves by an impulse.
void Impacts::touchImmovable(const Collision& at) {
  ContactMemory::Waiting* waiting = record(at, at.x, 0);
  memory_.setTouching(at.key, true);
  if (waiting) releases_.foreseeRelease(*waiting, at.tau, at.touch.gap.triangle);
  foresight_.predictAgain(*objects_.side(at.pa), *objects_.side(at.pb), at.tau);
}

/// The tip of `a` goes into the other side.
void Impacts::embed(Collision& at) {
  const Vec3 v = at.ma.velocityAt(at.x);
  const double impulse = collide(at.ma, at.mb, at.x, at.n, 0, 0).dot(at.n);
  ContactMemory::Waiting* waiting = record(at, at.x, impulse);
  embedTip(at.a, at.pb, v, at.tau);
  if (waiting) releases_.foreseeRelease(*waiting, at.tau, at.touch.gap.triangle);
}

/// Returns what accelerates the body while nothing carries it [m/s2].
Vec3 Impacts::pullOn(const RigidBody& body, double tau) const {
  if (body.mode == BodyMode::Flight && body.path.isParabola()) return Vec3(2 * body.path.c[2]);
  return body.mode == BodyMode::Flight || body.mode == BodyMode::Slide || body.mode == BodyMode::Roll
             ? Vec3(fields_.accelerationAt(body, body.position(tau), body.velocity(tau), tau))
             : Vec3(Vec3::Zero());
}

/// Decides whether this impact is the last one: the next bounce would be too low, or there were too many.
Impacts::Rebound Impacts::reboundOf(const Collision& at, double restitution) {
  const RigidBody &a = at.a, *b = at.b;
  const double press = -at.n.dot(pullOn(a, at.tau) - (b ? pullOn(*b, at.tau) : Vec3(Vec3::Zero())));
  const double speed = restitution * std::max(at.closing, 0.0);
  // A ball that rolls into the next face of its mesh goes on there, unless it rocks in a fold.
  const bool rolls = (a.mode == BodyMode::Slide || a.mode == BodyMode::Roll) && a.support.on.id &&
                     a.support.on == at.pb && a.impacts <= kMostFolds;
  const bool onFace = at.c && (a.mode == BodyMode::Flight || rolls) && carries(a, *at.c, at.touch.gap);
  const double last = std::max(onFace ? kLastBounce : kLastRattle, search_.tolerance());
  std::uint32_t most = restitution < 1 ? kMostImpacts : kMostElastic;
  if (restitution < 0.6)
    most = b && foresight_.ballsAround(a, at.tau) + 1 >= kPileOfBalls ? kMostInThick : kMostRattles;
  const bool tired = a.impacts > (onFace ? kMostBounces : most) || (b && b->impacts > most);
  if (tired) ++counters_.dampedBounces;
  const bool ends = tired || (press > 0 && speed * speed <= 2 * press * last);
  return {ends ? 0 : restitution, onFace, ends};
}

/// Applies the impulse, and lets both sides go on.
void Impacts::bounce(Collision& at) {
  const PairSurface pair = combine(at.a.surface, objects_.surfaceOf(at.pb));
  const Rebound rebound = reboundOf(at, pair.restitution);
  std::optional<PatchImpact> patch;
  std::vector<PatchSide> others;
  if (!at.a.isBall() && !(at.b && at.b->isBall())) {
    if (at.c) others = surfaces_.struckBeside(at.a, *at.c, at.tau, rebound.ends);
    patch = collidePatch(Side::of(at.a), *objects_.side(at.pb), at.tau, at.touch.gap, at.ma, at.mb,
                         rebound.restitution, pair.friction, others);
  }
  const Vec3 impulse =
      patch ? patch->impulse : collide(at.ma, at.mb, at.x, at.n, rebound.restitution, pair.friction);
  ContactMemory::Waiting* waiting = record(at, patch ? patch->middle : at.x, impulse.dot(at.n));
  if (rebound.onFace && rebound.ends && landOnFace(at)) return;
  if (rebound.ends) memory_.setTouching(at.key, true);
  afterImpulse(at.a, at.ma, at.tau, rebound.ends);
  if (at.b) afterImpulse(*at.b, at.mb, at.tau, rebound.ends);
  if (waiting) releases_.foreseeRelease(*waiting, at.tau, at.touch.gap.triangle);
  if (patch) recordBeside(at, others, rebound.ends);
}

/// Starts a ball on the face that it has met. Returns false if the face does not carry it.
bool Impacts::landOnFace(const Collision& at) {
  Support face;
  if (!supportFor(at.a, *at.c, at.touch.gap, face) || face.ends(at.ma.p, at.ma.v)) return false;
  const double distance = at.touch.gap.distance;
  BallStart s{at.ma.p, at.ma.v, at.ma.omega, at.ma.q};
  s.v -= at.n * at.n.dot(s.v);
  if (std::fabs(distance) < std::max(kExact, search_.tolerance())) s.p -= distance * at.n;
  at.a.support = face;
  arcs_.startOnFace(at.a, at.tau, s, false, false);
  foresight_.predict(at.a, at.tau);
  return true;
}

/// Records the impacts on surfaces that `a` has struck together with the first one.
void Impacts::recordBeside(const Collision& at, const std::vector<PatchSide>& others, bool lasting) {
  for (const PatchSide& part : others) {
    if (!(part.closing > 0)) continue;
    const ContactMemory::Key other = ContactMemory::keyOf(part.side.key, at.pa);
    if (at.awaited) releases_.releaseBefore(other, at.tau);
    ContactMemory::Waiting* waiting =
        memory_.impact(other, time_.timeAt(at.tau), part.middle, at.n, part.closing, part.impulse.dot(at.n),
                       time_.frame(), at.awaited);
    if (lasting) memory_.setTouching(other, true);
    if (waiting) releases_.foreseeRelease(*waiting, at.tau, -1);
  }
}

}  // namespace stadion
