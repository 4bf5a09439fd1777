#include "dynamics/world/release_watch.h"

#include "dynamics/collision/ball_flight.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kShortestLook = 0.1 * 1e-9;  ///< between looks at a pair that may part [s]
constexpr double kFineEnough = 1e-11;         ///< of times at which pairs part [s]

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
    before = tau;
    rateBefore = rate;
    double next = tau - step;
    if (std::fabs(step) < kFineEnough || step * step * bend < kFineEnough * std::fabs(rate)) return next;
    if (!(next > lo && next < hi)) {
      if (!nearAtLo && gapBetween(a, b, lo).distance > far) return lo;
      nearAtLo = true;
      next = 0.5 * (lo + hi);
    }
    tau = next;
  }
  return hi;
}

}  // namespace

namespace {

/// How far the two must go at least until they are `far` apart. How deep they overlap does not count: that is
/// known along one direction only.
double wayTo(double far, const Gap& gap) {
  return far - std::max(0.0, gap.distance);
}

double reachOf(const Side& s) {
  return s.body ? s.body->reach : s.bound().centre.norm() + s.bound().radius;
}

/// What turning adds to the speed of a side's points.
double turningSpeed(const MotionBound& bound, double reach) {
  return bound.spin > 0 ? bound.spin * reach : 0;
}

/// Returns true if the side's motion through this frame is known.
bool isNoted(const Side& s) {
  return !s.body || !s.body->trace.arcs.empty() || standsStill(s.body->mode);
}

/// The time from which on a body follows its present arc.
double arcStart(const Side& s) {
  return s.body ? -s.body->age0 : -1e300;
}

/// A side's motion through the frame so far: a body follows its noted path.
class PastSide {
public:
  PastSide(const Side& present, const Instant& start) : side_(present) {
    if (!present.body || present.body->trace.arcs.empty()) return;
    thing_.shape = present.shape;
    thing_.bound = present.bound();
    thing_.motion.arcs = present.body->trace.arcs;
    thing_.motion.moving = true;
    thing_.motion.rebase(start);
    side_.body = nullptr;
    side_.collider = &thing_;
  }
  PastSide(const PastSide&) = delete;
  PastSide& operator=(const PastSide&) = delete;

  /// The time from which on its motion is known.
  double begins() const { return side_.guided() ? side_.motion()->arcs.front().tau : -1e300; }
  /// Where its way goes on otherwise.
  void addTurns(std::vector<double>& turns) const {
    if (side_.guided())
      for (const ArcPiece& p : side_.motion()->arcs) turns.push_back(p.tau);
  }
  /// The side in a part of its way that `tau` lies in.
  const Side& around(double tau) {
    if (side_.collider == &thing_) thing_.motion.part = thing_.motion.partAfter(tau);
    return side_;
  }

private:
  Side side_;
  Collider thing_;
};

/// After tau the two cannot part by `distance` more sooner than this, as long as their arcs last [ns].
Nanoseconds soonest(const Side& a, const Side& b, double distance, double tau) {
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

}  // namespace

/// The first moment in [from, to], in which each side follows one arc, at which they are farther apart than
/// `far`. Nothing: they are not.
std::optional<double> firstBeyond(const Side& a, const Side& b, double far, double from, double to) {
  constexpr int kCareful = 12, kMostMore = 16;  // looks; then no step is shorter than a share of the time
  const MotionBound ba = a.boundOver(from, to), bb = b.boundOver(from, to);
  const double turning = turningSpeed(ba, reachOf(a)) + turningSpeed(bb, reachOf(b)),
               acceleration = ba.acceleration + bb.acceleration;
  double near = from;
  int steps = 0;
  for (double tau = from; tau <= to;) {
    const Kinematics ka = a.at(tau), kb = b.at(tau);
    const double left = wayTo(far, gapBetween(a, ka, b, kb, {far + 1e-3}));
    if (left < 0) return tau == from ? from : whenApart(a, b, far, near, tau);
    if (tau == to) break;
    near = tau;
    const double speed = (ka.v - kb.v).norm() + turning;
    const double root = speed + std::sqrt(speed * speed + 2 * acceleration * left);
    if (!(root > 0)) break;
    const double least = ++steps > kCareful ? (to - from) / kMostMore : kShortestLook;
    tau = std::min(to, tau + std::max(2 * left / root, least));
  }
  return {};
}

/// When the pair has parted by tau, since it has been seen last. Nothing: it has not.
std::optional<Nanoseconds> ReleaseWatch::whenParted(const ContactMemory::Waiting& w, double tau) const {
  const double far = objects_.body(w.pair.second)->releaseDistance;
  if (!isNoted(*objects_.side(w.pair.first)) || !isNoted(*objects_.side({true, w.pair.second}))) return {};
  PastSide a(*objects_.side(w.pair.first), {time_.origin(), 0}),
      b(*objects_.side({true, w.pair.second}), {time_.origin(), 0});
  const double from = std::max({time_.partStart(), time_.tauOf(w.seen), a.begins(), b.begins()});
  if (!(from < tau)) return {};
  std::vector<double> turns{from, tau};
  a.addTurns(turns);
  b.addTurns(turns);
  std::erase_if(turns, [&](double t) { return t < from || t > tau; });
  std::ranges::sort(turns);
  for (std::size_t i = 1; i < turns.size(); ++i) {
    const double middle = 0.5 * (turns[i - 1] + turns[i]);
    if (!(turns[i - 1] < turns[i])) continue;
    if (const auto parted = firstBeyond(b.around(middle), a.around(middle), far, turns[i - 1], turns[i]))
      return time_.timeAt(*parted);
  }
  return {};
}

/// Returns a bound on the way of a side's points since `from`.
double ReleaseWatch::wayLength(const Side& s, double from, double tau) const {
  const double reach = reachOf(s);
  double length = 0;
  const auto add = [&](const MotionBound& b, double seconds) {
    length += (b.speed + turningSpeed(b, reach)) * seconds;
  };
  if (s.collider && !s.collider->motion.moving) return 0;
  if (s.collider && !s.guided()) {
    add(s.boundOver(from, tau), tau - from);
    return length;
  }
  const ArcTrack& way = s.collider ? s.collider->motion.arcs : s.body->trace.arcs;
  if (way.empty()) return standsStill(s.body->mode) ? 0 : 1e300;
  if (s.body && way.front().from.since({time_.origin(), 0}) > from) return 1e300;
  for (std::size_t i = 0; i < way.size(); ++i) {
    ArcPiece part = way[i];
    part.tau = part.from.since({time_.origin(), 0});
    const double start = std::max(from, part.tau),
                 end = i + 1 < way.size() ? std::min(tau, way[i + 1].from.since({time_.origin(), 0})) : tau;
    if (start < end && !part.stands()) add(part.boundOver(start, end), end - start);
  }
  return length;
}

/// It has been put elsewhere: no way leads there that could be too short to part from anything.
void ReleaseWatch::forgetSlack(ContactSide p) {
  memory_.eachWith(p, [&](const ContactMemory::Key& pair) {
    if (ContactMemory::Waiting* w = memory_.waitingOf(pair)) w->slack = 0;
  });
}

/// Until this part of the frame the pair was as foreseen: it has not parted, but it has used up slack.
void ReleaseWatch::passSkippedFrames(ContactMemory::Waiting& w) const {
  if (w.seen >= time_.t0()) return;
  w.slack = w.slackAt(time_.t0());
  w.seen = time_.t0();
}

/// Returns true if the pair has moved too little since the last look to have parted.
bool ReleaseWatch::stillNear(ContactMemory::Waiting& w, double tau) const {
  passSkippedFrames(w);
  const double from = time_.tauOf(w.seen);
  const double length = wayLength(*objects_.side(w.pair.first), from, tau) +
                        wayLength(*objects_.side({true, w.pair.second}), from, tau);
  if (!(length < w.slack)) return false;
  w.slack -= length;
  w.seen = time_.timeAt(tau);
  return true;
}

/// Pairs whose impact was reported are released when their surfaces are far enough apart; if that is in the
/// impact's own frame, the report comes in the next one.
void ReleaseWatch::reportReleases() {
  std::vector<std::pair<ContactMemory::Key, Nanoseconds>> due;
  for (ContactMemory::Waiting& w : memory_.waiting()) {
    const bool asForeseen = w.versionA && *w.versionA + *w.versionB == w.versions;
    if (asForeseen && time_.t1() < w.look) continue;
    const Side a = *objects_.side(w.pair.first), b = *objects_.side({true, w.pair.second});
    if (asForeseen && w.sure && noPartNearer(w, a, b)) {
      due.emplace_back(w.pair, std::max(w.look, time_.t0()));
      continue;
    }
    if (stillNear(w, time_.partEnd())) continue;
    const bool noted = isNoted(a) && isNoted(b);
    if (const auto parted = noted ? whenParted(w, time_.partEnd()) : std::nullopt) {
      due.emplace_back(w.pair, *parted);
      continue;
    }
    const double far = b.body->releaseDistance;
    const Gap gap = gapBetween(b, a, time_.partEnd(), {far + 1e-3, 0.7 * far, w.triangle});
    if (gap.distance > far) {
      const double from = std::max({time_.tauOf(w.seen), arcStart(a), arcStart(b)});
      due.emplace_back(w.pair, time_.timeAt(whenApart(b, a, far, from, time_.partEnd())));
      continue;
    }
    w.triangle = gap.triangle;
    awaitRelease(w, a, b, std::max(0.0, wayTo(far, gap)), time_.partEnd());
  }
  std::ranges::sort(due);
  for (const auto& [key, time] : due) release(key, time);
}

void ReleaseWatch::release(const ContactMemory::Key& pair, Nanoseconds time) {
  const ContactMemory::Waiting* w = memory_.waitingOf(pair);
  if (w && w->frame == time_.frame())
    memory_.releaseLater(pair, time);
  else
    memory_.release(pair, time);
}

/// The pair meets again at tau: it may have parted before.
void ReleaseWatch::releaseBefore(const ContactMemory::Key& pair, double tau) {
  ContactMemory::Waiting* w = memory_.waitingOf(pair);
  if (!w) return;
  const bool asForeseen = w->versionA && *w->versionA + *w->versionB == w->versions;
  if (asForeseen && time_.timeAt(tau) < w->look) return;
  if (asForeseen && w->sure &&
      noPartNearer(*w, *objects_.side(pair.first), *objects_.side({true, pair.second})))
    return release(pair, std::max(w->look, time_.t0()));
  if (stillNear(*w, tau)) return;
  if (const auto parted = whenParted(*w, tau)) release(pair, *parted);
}

/// The body has got as far off the face that was below it as it must be: whether no other part of the same
/// thing is nearer.
bool ReleaseWatch::noPartNearer(const ContactMemory::Waiting& w, const Side& a, const Side& b) const {
  if (!std::holds_alternative<MeshShape>(*a.shape)) return true;
  const double tau = time_.tauOf(w.look), far = b.body->releaseDistance;
  // It has been so near until half a nanosecond ago.
  const double limit = far - 2e-9 * (1 + b.body->velocity(tau).norm());
  return gapBetween(b, a, tau, {limit, limit, w.triangle}).distance > limit;
}

/// At tau the two are to part by `distance` more: notes when to look for that.
void ReleaseWatch::awaitRelease(ContactMemory::Waiting& w, const Side& a, const Side& b, double distance,
                                double tau) const {
  w.versionA = a.body ? &a.body->version : &a.collider->version;
  w.versionB = &b.body->version;
  w.versions = *w.versionA + *w.versionB;
  w.sure = false;
  w.seen = time_.timeAt(tau);
  w.slack = distance;
  w.byWay = false;
  BallFlight::Stay stay;
  if (const auto flight = a.still() ? flightOf(b, tau) : std::nullopt) {
    const double far = b.body->releaseDistance;
    if (const auto* plane = std::get_if<PlaneShape>(a.shape); plane && !plane->bounded())
      stay = flight->stayNear(a.collider->planePoint, a.collider->planeNormal, far);
    if (const auto* box = std::get_if<BoxShape>(a.shape))
      stay = flight->seenFrom(a.at(tau).pose).stayNear(*box, far);
    if (const auto* mesh = std::get_if<MeshShape>(a.shape); mesh && w.triangle >= 0)
      stay = flight->seenFrom(a.at(tau).pose).stayNear(mesh->tree, w.triangle, far);
    w.triangle = stay.triangle;
    w.sure = stay.sure;
  }
  constexpr double kForever = 1e6;  // [s]
  const Nanoseconds stays = fromSeconds(std::min(stay.seconds, kForever)),
                    goes = w.sure ? 0 : soonest(a, b, distance, tau);
  w.byWay = goes >= stays;
  w.look = time_.timeAt(tau) + std::max(stays, goes);
}

/// An impact at tau has been dealt with: the pair need not be looked at before it can part.
void ReleaseWatch::foreseeRelease(ContactMemory::Waiting& w, double tau, std::int32_t triangle) {
  for (const ContactSide p : {w.pair.first, ContactSide{true, w.pair.second}})
    if (RigidBody* b = p.isBody ? objects_.body(p.id) : nullptr)
      traces_.trace(*b, b->trace.traced, true, tau);
  const Side a = *objects_.side(w.pair.first), b = *objects_.side({true, w.pair.second});
  w.triangle = triangle;
  awaitRelease(w, a, b, b.body->releaseDistance, tau);
}

}  // namespace stadion
