#include "dynamics/world_core.h"

#include <cmath>

namespace stadion {
namespace {

constexpr double kFineEnough = 1e-11;  ///< of times at which pairs part [s]

/// When between `lo` and `hi` the gap of two sides grew beyond `far`; at `hi` it is g. Newton's method, kept
/// between what is known.
double whenApart(const Side& a, const Side& b, Gap g, double far, double lo, double hi) {
  bool nearAtLo = false;
  double tau = hi;
  for (int i = 0; i < 60 && hi - lo > kFineEnough; ++i) {
    if (i > 0 || g.distance > 1e200) g = gapBetween(a, b, tau);
    const double over = g.distance - far;
    (over > 0 ? hi : lo) = tau;
    nearAtLo = nearAtLo || !(over > 0);
    const Vec3 x = g.point + g.distance * g.normal;
    const double rate = g.normal.dot(a.at(tau).velocityAt(x) - b.at(tau).velocityAt(g.point));
    double next = tau - over / rate;
    if (std::fabs(next - tau) < kFineEnough) return next;
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
  for (const auto& [key, known] : memory.fired()) {
    ContactMemory::Memory& m = *known;
    if (m.frame == frame) continue;
    const Party other = key.first, self{true, key.second};
    if (t1 < m.look && m.versionA == versionOf(other) && m.versionB == versionOf(self)) continue;
    const auto a = side(other), b = side(self);
    if (!a || !b) {
      due.emplace_back(key, t1);
      continue;
    }
    const double far = b->body->releaseDistance;
    const Gap gap = gapBetween(*b, *a, now, {far + 1e-3, 0.7 * far, m.triangle});
    if (gap.distance > far) {
      due.emplace_back(key, timeAt(whenApart(*b, *a, gap, far, frameFrom, now)));
    } else {
      m.triangle = gap.triangle;
      awaitRelease(m, *a, *b, far - gap.distance, now);
    }
  }
  for (const auto& [key, time] : due) memory.release(key, time);
}

/// At tau the two are to part by `distance` more: notes when to look for that.
void World::Core::awaitRelease(ContactMemory::Memory& m, const Side& a, const Side& b, double distance,
                               double tau) const {
  m.look = timeAt(tau) + soonest(a, b, distance, tau);
  m.versionA = versionOf(a.party), m.versionB = versionOf(b.party);
}

/// An impact at tau has been dealt with: the pair, if it was told, need not be looked at before it can part.
void World::Core::foreseeRelease(const ContactMemory::Key& key, double tau) {
  const auto at = memory.fired().find(key);
  if (at == memory.fired().end()) return;
  const Side a = *side(key.first), b = *side({true, key.second});
  awaitRelease(*at->second, a, b, b.body->releaseDistance, tau);
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
