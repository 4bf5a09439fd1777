#include "dynamics/ball_flight.h"
#include "dynamics/world_core.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kFineEnough = 1e-11;  ///< of times at which pairs part [s]

/// When between `lo` and `hi` the gap of two sides, which is wider at `hi`, grew beyond `far`. Newton's
/// method, kept between what is known.
double whenApart(const Side& a, const Side& b, double far, double lo, double hi) {
  bool nearAtLo = false;
  double tau = hi, before = hi, rateBefore = 0;
  for (int i = 0; i < 60 && hi - lo > kFineEnough; ++i) {
    const Kinematics ka = a.at(tau), kb = b.at(tau);
    const Gap g = gapBetween(a, ka, b, kb);
    const double over = g.distance - far;
    (over > 0 ? hi : lo) = tau;
    nearAtLo = nearAtLo || !(over > 0);
    const Vec3 x = g.point + g.distance * g.normal;
    const double rate = g.normal.dot(ka.velocityAt(x) - kb.velocityAt(g.point)), step = over / rate;
    // What the next step would be is about the square of this one times half the curvature.
    const double bend = i > 0 && tau != before ? std::fabs((rate - rateBefore) / (tau - before)) : 1e9;
    before = tau, rateBefore = rate;
    double next = tau - step;
    if (std::fabs(step) < kFineEnough || step * step * bend < kFineEnough * std::fabs(rate)) return next;
    if (!(next > lo && next < hi)) {
      if (!nearAtLo && gapBetween(a, b, lo).distance > far) return lo;
      nearAtLo = true, next = 0.5 * (lo + hi);
    }
    tau = next;
  }
  return hi;
}

}  // namespace

/// Pairs whose impact was told are released when their surfaces are far enough apart, not in the impact's own
/// frame.
void World::Core::reportReleases() {
  std::vector<std::pair<ContactMemory::Key, Nanoseconds>> due;
  for (ContactMemory::Waiting& w : memory.waiting()) {
    if (w.frame == frame) continue;
    const bool asForeseen = w.versionA && *w.versionA + *w.versionB == w.versions;
    if (asForeseen && t1 < w.look) continue;
    const Side a = *side(w.pair.first), b = *side({true, w.pair.second});
    const double far = b.body->releaseDistance;
    if (asForeseen && w.sure && nobodyNearer(w, a, b)) {
      due.emplace_back(w.pair, std::max(w.look, t0));
      continue;
    }
    const Gap gap = gapBetween(b, a, now, {far + 1e-3, 0.7 * far, w.triangle});
    if (gap.distance > far) {
      due.emplace_back(w.pair, timeAt(whenApart(b, a, far, frameFrom, now)));
    } else {
      w.triangle = gap.triangle;
      awaitRelease(w, a, b, far - gap.distance, now);
    }
  }
  std::ranges::sort(due);
  for (const auto& [key, time] : due) memory.release(key, time);
}

/// The body has got as far off the face that was below it as it must be: whether no other part of the same
/// thing is nearer.
bool World::Core::nobodyNearer(const ContactMemory::Waiting& w, const Side& a, const Side& b) const {
  if (!std::holds_alternative<MeshShape>(*a.shape)) return true;
  const double tau = tauOf(w.look), far = b.body->releaseDistance;
  // It has been so near until half a nanosecond ago.
  const double limit = far - 2e-9 * (1 + b.body->velocity(tau).norm());
  return gapBetween(b, a, tau, {limit, limit, w.triangle}).distance > limit;
}

/// At tau the two are to part by `distance` more: notes when to look for that.
void World::Core::awaitRelease(ContactMemory::Waiting& w, const Side& a, const Side& b, double distance,
                               double tau) const {
  w.versionA = a.body ? &a.body->version : &a.collider->version, w.versionB = &b.body->version;
  w.versions = *w.versionA + *w.versionB;
  w.sure = false;
  BallFlight::Stay stay;
  if (const auto flight = a.still() ? flightOf(b, tau) : std::nullopt) {
    const double far = b.body->releaseDistance;
    if (const auto* plane = std::get_if<PlaneShape>(a.shape); plane && !plane->bounded())
      stay = flight->stayNear(a.collider->planePoint, a.collider->planeNormal, far);
    if (const auto* box = std::get_if<BoxShape>(a.shape))
      stay = flight->seenFrom(a.at(tau).pose).stayNear(*box, far);
    if (const auto* mesh = std::get_if<MeshShape>(a.shape); mesh && w.triangle >= 0)
      stay = flight->seenFrom(a.at(tau).pose).stayNear(mesh->tree, w.triangle, far);
    w.triangle = stay.triangle, w.sure = stay.sure;
  }
  constexpr double kForever = 1e6;  // [s]
  w.look = timeAt(tau) + (w.sure ? fromSeconds(std::min(stay.seconds, kForever))
                                 : std::max(fromSeconds(stay.seconds), soonest(a, b, distance, tau)));
}

/// An impact at tau has been dealt with: the pair need not be looked at before it can part.
void World::Core::foreseeRelease(ContactMemory::Waiting& w, double tau, std::int32_t triangle) const {
  const Side a = *side(w.pair.first), b = *side({true, w.pair.second});
  w.triangle = triangle;
  awaitRelease(w, a, b, b.body->releaseDistance, tau);
}

/// After tau the two cannot part by `distance` more sooner than this, as long as their arcs last [ns].
Nanoseconds World::Core::soonest(const Side& a, const Side& b, double distance, double tau) const {
  if ((a.collider && a.collider->motion.moving) || (a.body && a.body->mode == BodyMode::Held) ||
      b.body->mode == BodyMode::Held)
    return 0;
  constexpr double most = 0.5;  // [s]
  double speed = 0, acceleration = 0;
  for (const Side* s : {&a, &b}) {
    if (!s->body) continue;
    speed += s->body->velocity(tau).norm() + s->boundOver(tau, tau + most).spin * s->body->reach;
    acceleration += s->body->path.accelerationBound();
  }
  const double root = std::sqrt(speed * speed + 2 * acceleration * distance);
  return fromSeconds(most * (speed + root) <= 2 * distance ? most : 2 * distance / (speed + root));
}

}  // namespace stadion
