#include "dynamics/collision/stepped_search.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kShortestBracket = 1e-12;  ///< a step is subdivided down to this [s]
constexpr double kApproaches = 1e-10;       ///< slower than this is no approach [m/s]
constexpr double kSameStep = 1e-9;          ///< of a step: so near to its end is at its end

/// At least the speed of any point of the side relative to World, `far` from the other side's centre.
double fastestPoint(const Side& s, double from, double to, double far) {
  if (s.still()) return 0;
  const MotionBound bound = s.boundOver(from, to);
  if (s.body && s.body->centred) return bound.speed;  // its surface goes where its centre goes
  const double reach = s.body ? s.body->reach : s.bound().centre.norm() + s.bound().radius;
  return bound.speedAt(bound.spin > 0 ? std::min(reach, far) : 0);
}

}  // namespace

/// Whether the two overlap, by the test of the scheme.
bool SteppedSearch::overlap(double tau) const {
  ++tests_;
  const Kinematics ka = a_.at(tau), kb = b_.at(tau);
  const auto* meshA = std::get_if<MeshShape>(a_.shape);
  const auto* meshB = std::get_if<MeshShape>(b_.shape);
  if (meshA && meshB) return MeshHierarchy::cross(*meshA->hierarchy, ka.pose, *meshB->hierarchy, kb.pose);
  const auto reaches = [](const MeshShape& mesh, const Pose& X, const BallShape& ball, const Pose& X_WB) {
    return mesh.hierarchy->reaches(X.inverse() * (X_WB * ball.centre), ball.radius);
  };
  if (const auto* ball = std::get_if<BallShape>(b_.shape); ball && meshA)
    return reaches(*meshA, ka.pose, *ball, kb.pose);
  if (const auto* ball = std::get_if<BallShape>(a_.shape); ball && meshB)
    return reaches(*meshB, kb.pose, *ball, ka.pose);
  return gapBetween(a_, ka, b_, kb, {0}).distance < 0;
}

/// The next time of the grid after tau.
double SteppedSearch::nextStep(double tau) const {
  return grid_ + scheme_.step * (std::floor((tau - grid_) / scheme_.step + kSameStep) + 1);
}

/// At least how far a point of one side moves relative to the other [m].
double SteppedSearch::motion(double from, double to) const {
  const double far = (a_.at(from).p - b_.at(from).p).norm();
  const auto reachOf = [](const Side& s) {
    return std::isfinite(s.bound().radius) ? s.bound().centre.norm() + s.bound().radius : 0;
  };
  const double room = far + reachOf(a_) + reachOf(b_);
  return (to - from) * (fastestPoint(a_, from, to, room) + fastestPoint(b_, from, to, room));
}

/// A touch at tau if the nearest points approach each other there.
std::optional<Touch> SteppedSearch::approaching(double tau) const {
  const Kinematics ka = a_.at(tau), kb = b_.at(tau);
  const Gap gap = gapBetween(a_, ka, b_, kb);
  const Vec3 onA = gap.point + gap.distance * gap.normal;
  if (!(gap.normal.dot(kb.velocityAt(gap.point) - ka.velocityAt(onA)) > kApproaches)) return {};
  return Touch{tau, gap, false};
}

/// They overlap at both times and approach each other at the second: since when.
std::optional<Touch> SteppedSearch::firstApproach(double from, double to) const {
  std::optional<Touch> touch = approaching(to);
  while (touch && motion(from, to) > scheme_.tolerance && to - from > kShortestBracket) {
    const double middle = 0.5 * (from + to);
    if (auto sooner = approaching(middle)) {
      touch = std::move(sooner);
      to = middle;
    } else
      from = middle;
  }
  return touch;
}

/// The last time at which they are known to be apart, to the tolerance, if they approach each other there.
std::optional<Touch> SteppedSearch::backUp(double apart, double overlapping) const {
  std::optional<Touch> touch;
  while (overlapping - apart > kShortestBracket) {
    if (motion(apart, overlapping) <= scheme_.tolerance && (touch = approaching(apart))) break;
    const double middle = 0.5 * (apart + overlapping);
    if (overlap(middle))
      overlapping = middle;
    else
      apart = middle;
  }
  return touch ? touch : approaching(apart);
}

std::optional<Touch> SteppedSearch::first(double from, double to) const {
  bool apart = !overlap(from);
  if (!apart)
    if (auto touch = approaching(from)) return touch;
  while (from < to) {
    const double next = std::min(to, nextStep(from));
    if (!overlap(next)) {
      apart = true;
    } else if (auto touch = apart ? backUp(from, next) : firstApproach(from, next)) {
      return touch;
    } else {
      apart = false;
    }
    from = next;
  }
  return {};
}

}  // namespace stadion
