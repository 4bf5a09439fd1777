#include "dynamics/collision/touch.h"

#include "dynamics/collision/ball_flight.h"
#include "dynamics/collision/ball_touch.h"
#include "dynamics/collision/convex_touch.h"
#include "dynamics/collision/nearest_surface.h"
#include "dynamics/collision/polyhedra.h"
#include "dynamics/maths/first_root.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace stadion {
namespace {

struct Local {
  double distance;
  Vec3 point, normal;  ///< in the shape's frame
  bool face;
  std::int32_t triangle;
};

/// Below this distance [m], the direction between two points is only rounding error.
constexpr double kNoWay = 1e-12;

Local towards(const Vec3& c, const Vec3& q, double r, const Vec3& fallback) {
  const Vec3 d = c - q;
  const double n = d.norm();
  return {n - r, q, n > kNoWay ? Vec3(d / n) : fallback, false, -1};
}

Local localGap(const Vec3& c, double r, const BallShape& s, DistanceLimits) {
  Local l = towards(c, s.centre, r + s.radius, Vec3::UnitZ());
  l.point = s.centre + s.radius * l.normal;
  return l;
}

Local localGap(const Vec3& c, double r, const BoxShape& s, DistanceLimits) {
  const Vec3 p = s.pose.q.conjugate() * (c - s.pose.p), inside = s.half - p.cwiseAbs();
  int axis = 0;
  if (inside.minCoeff(&axis) > -kNoWay) {  // the centre is inside: out through the nearest face
    Vec3 n = Vec3::Zero();
    n[axis] = p[axis] < 0 ? -1 : 1;
    Vec3 q = p;
    q[axis] = n[axis] * s.half[axis];
    return {-inside[axis] - r, s.pose * q, s.pose.q * n, true, -1};
  }
  const Vec3 q = p.cwiseMin(s.half).cwiseMax(-s.half);
  Local l = towards(p, q, r, Vec3::UnitZ());
  l.face = (inside.array() >= 0).count() == 2;
  l.point = s.pose * q;
  l.normal = s.pose.q * l.normal;
  return l;
}

template <class Solid>
Local localGap(const Vec3& c, double r, const Solid& s, DistanceLimits) {
  const NearestSurface n = nearestSurface(s, c);
  return {n.distance - r, n.point, n.normal, n.face, -1};
}

/// How deep below a bounded plane things count as sunk into it [m].
double sheetDepth(const PlaneShape& s) {
  return std::min(1.0, 0.5 * s.half.minCoeff());
}

Local localGap(const Vec3& c, double r, const PlaneShape& s, DistanceLimits) {
  const Vec3 p = s.pose.q.conjugate() * (c - s.pose.p);
  if (!s.bounded()) return {p.z() - r, s.pose * Vec3(p.x(), p.y(), 0), s.normal(), true, -1};
  const Vec3 q(std::clamp(p.x(), -s.half.x(), s.half.x()), std::clamp(p.y(), -s.half.y(), s.half.y()), 0);
  // Over the sheet its upper side counts, also for a ball that has sunk in. A ball below that depth meets its
  // back.
  if (q.x() == p.x() && q.y() == p.y() && p.z() > -sheetDepth(s))
    return {p.z() - r, s.pose * q, s.normal(), true, -1};
  Local l = towards(p, q, r, Vec3::UnitZ());
  l.face = q.x() == p.x() && q.y() == p.y();
  l.point = s.pose * q;
  l.normal = s.pose.q * l.normal;
  return l;
}

/// Against one triangle; `solid`: its back is the inside of a closed mesh.
Local triangleGap(const Vec3& c, double r, const Triangle& t, std::int32_t index, bool solid) {
  const ClosestPoint q = closestPoint(t, c);
  Local l = towards(c, q.point, r, t.normal);
  const double height = t.normal.dot(c - q.point);
  l.triangle = index;
  l.face = q.edge < 0;
  if (solid && height < 0 && q.edge < 0) {
    l.normal = t.normal;
    l.distance = height - r;
  }
  // A merged edge has no normal of its own: the face speaks for it while the ball is in front of it.
  if (q.edge >= 0 && !q.corner && t.merged[static_cast<std::size_t>(q.edge)] &&
      height > 0.999 * (c - q.point).norm()) {
    l.face = true;
    l.normal = t.normal;
  }
  return l;
}

Local localGap(const Vec3& c, double r, const MeshShape& s, DistanceLimits limits) {
  ClosestPoint at;
  const std::int32_t i =
      s.tree.nearest(c, limits.limit + r, at, limits.enough > 0 ? limits.enough + r : 0, limits.triangle);
  if (i < 0) {
    if (limits.limit < 1e300 && s.tree.encloses(c)) return localGap(c, r, s, {});  // deeper than the limit
    return {1e300, c, Vec3::UnitZ(), false, -1};
  }
  const Triangle& t = s.tree.triangles()[static_cast<std::size_t>(i)];
  const bool isBehind = s.tree.closed() && s.tree.outwardsAt(i, at).dot(c - at.point) < 0;
  // Only the nearest point tells inside from outside.
  if (isBehind && limits.enough > 0) return localGap(c, r, s, {limits.limit});
  Local l = triangleGap(c, r, t, i, s.tree.closed());
  if (isBehind) {  // inside: out the near way
    const double depth = (c - at.point).norm();
    l.distance = -depth - r;
    l.normal = depth > kNoWay ? Vec3((at.point - c) / depth) : t.normal;
  }
  return l;
}

Gap inWorld(const Local& l, const Pose& X) {
  return {l.distance, X * l.point, X.q * l.normal, l.face, l.triangle};
}

Vec3 ballCentre(const Side& s, const Kinematics& k) {
  return k.pose * std::get<BallShape>(*s.shape).centre;
}

/// The centre of a ball, and its velocity.
struct Centre {
  Vec3 p, v;
};
Centre centreAt(const Side& s, double tau) {
  if (isFreeBall(s) && s.body) return {s.body->position(tau), s.body->velocity(tau)};
  const Kinematics k = s.at(tau);
  const Vec3 c = ballCentre(s, k);
  return {c, k.velocityAt(c)};
}

/// A still plane under a parabola has a closed form.
std::optional<Touch> planeRoot(const BallFlight& flight, const Collider& plane, double from, double to) {
  const Vec3 &n = plane.planeNormal, &on = plane.planePoint;
  const double u = n.dot(flight.v), b = n.dot(flight.a);
  double h = n.dot(flight.p - on) - flight.radius, t = 0;
  if (h > touchTolerance(on) || u >= 0) {
    h = std::max(h, 0.0);
    const double d = u * u - 2 * b * h;
    if (d < 0 || (u >= 0 && b >= 0)) return {};
    t = u < 0 ? 2 * h / (std::sqrt(d) - u) : (u + std::sqrt(d)) / -b;
    if (from + t > to) return {};
  }
  const Vec3 c = flight.at(t);
  const double height = n.dot(c - on);
  return Touch{from + t, {height - flight.radius, c - height * n, n, true, -1}, false};
}

/// A flat face of a mesh that a ball already rolls on is nothing it can meet; nor is what lies wholly below
/// the plane of that face, as beyond the edges of a hill, until the ball leaves it.
class OwnFace {
public:
  OwnFace(const Side& ball, const Side& mesh, const Pose& X)
      : support_(ball.body && ball.body->support.on == mesh.key && ball.body->support.on.id
                     ? &ball.body->support
                     : nullptr),
        X_(X) {}
  bool operator()(const Triangle& t) const {
    if (!support_) return false;
    const auto height = [&](const Vec3& v) { return support_->normal.dot(X_ * v - support_->point); };
    if ((X_.q * t.normal).dot(support_->normal) > 1 - 1e-7) return std::fabs(height(t.v[0])) < 1e-6;
    constexpr double kNotAbove = 1e-8;  // [m]
    return std::ranges::all_of(t.v, [&](const Vec3& v) { return height(v) < kNotAbove; });
  }

private:
  const Support* support_;
  const Pose& X_;
};

/// Whether the ball's centre is in the mesh.
bool isInside(const BallFlight& flight, const MeshShape& mesh) {
  const double r = flight.radius;
  return mesh.tree.closed() && localGap(flight.p, r, mesh, {r}).distance < -r;
}

/// Whether x lies in the prism over the triangle.
bool isOver(const Triangle& t, const Vec3& x) {
  for (std::size_t i = 0; i < 3; ++i)
    if (t.normal.cross(t.v[(i + 1) % 3] - t.v[i]).dot(x - t.v[i]) < 0) return false;
  return true;
}

/// A ball in free flight against a mesh that stands still: the planes of faces in closed form, then edges and
/// corners that come sooner.
std::optional<Touch> flightOnMesh(const BallFlight& flight, const TriangleTree& tree, const OwnFace& isOwn,
                                  const Pose& X, double from, double to, double tolerance,
                                  std::uint64_t& count) {
  struct Reached {
    std::uint32_t triangle;
    double from, to;
  };
  std::vector<Reached> beside;  // whose planes it reaches, but not in the triangle
  std::int32_t hit = -1;
  double best = to - from;
  const auto seize = [&](std::uint32_t i, double time) { hit = static_cast<std::int32_t>(i), best = time; };
  // True if the ball reaches something else before this time, or at this time.
  const auto late = [&](double time) { return hit >= 0 && time + 1e-12 >= best; };
  tree.eachOnWay(
      0, best, [&](double s, double t) { return flight.around(s, t); },
      [&](std::uint32_t i, double s, double t) {
        const Triangle& face = tree.triangles()[i];
        const double plane = flight.timeToPlane(face, t);
        if (!(plane <= t) || late(plane) || isOwn(face)) return best;
        ++count;
        if (plane <= 0 || !isOver(face, flight.at(plane)))
          beside.push_back({i, std::max(plane, s), t});
        else if (plane >= s)
          seize(i, plane);
        return best;
      });
  const auto gapAt = [&](std::uint32_t i, double t) {
    return triangleGap(flight.at(t), flight.radius, tree.triangles()[i], static_cast<std::int32_t>(i), false);
  };
  const double bound = flight.a.norm();
  for (const Reached& near : beside) {
    if (late(near.from)) continue;
    const auto probe = [&](double time) {
      const Local l = gapAt(near.triangle, time);
      return Probe{l.distance, l.normal.dot(flight.velocityAt(time))};
    };
    const auto time = firstRoot(probe, near.from, std::min(near.to, best), bound, tolerance, count);
    if (time && (hit < 0 || *time < best)) seize(near.triangle, *time);
  }
  if (hit < 0) return {};
  return Touch{from + best, inWorld(gapAt(static_cast<std::uint32_t>(hit), best), X), false};
}

std::optional<Touch> ballOnMesh(const Side& ball, const Side& other, const Kinematics& ko, double from,
                                double to, double bound, std::uint64_t& count) {
  const double r = std::get<BallShape>(*ball.shape).radius;
  const auto& tree = std::get<MeshShape>(*other.shape).tree;
  const Vec3 c0 = ballCentre(ball, ball.at(from));
  const double tolerance = touchTolerance(c0);
  const bool inside = tree.closed() && ballGap(c0, r, *other.shape, ko.pose, {r}).distance < -r;
  const OwnFace isOwn(ball, other, ko.pose);
  // The triangles that the ball can reach, each for itself.
  const Vec3 l0 = ko.pose.inverse() * c0;
  const Vec3 l1 = other.at(to).pose.inverse() * ballCentre(ball, ball.at(to));
  const double sag = bound * (to - from) * (to - from) / 8 + r + 1e-9;
  Aabb box;
  box.include(l0);
  box.include(l1);
  box.lo.array() -= sag;
  box.hi.array() += sag;
  std::vector<std::uint32_t> candidates;
  tree.overlapping(box, candidates);
  std::optional<Touch> best;
  double end = to;
  for (const std::uint32_t i : candidates) {
    const Triangle& t = tree.triangles()[i];
    if (isOwn(t)) continue;
    Gap last;
    const auto probe = [&](double tau) {
      const Kinematics b = ball.at(tau), o = other.at(tau);
      const Vec3 c = ballCentre(ball, b);
      last = inWorld(triangleGap(o.pose.inverse() * c, r, t, static_cast<std::int32_t>(i), inside), o.pose);
      return Probe{last.distance, last.normal.dot(b.velocityAt(c) - o.velocityAt(last.point))};
    };
    const auto tau = firstRoot(probe, from, end, bound, tolerance, count);
    if (!tau || (best && *tau >= best->tau)) continue;
    best = Touch{*tau, last, false};
    end = *tau;
  }
  return best;
}

std::optional<Touch> ballTouch(const Side& ball, const Side& other, double from, double to,
                               std::uint64_t& count) {
  const double r = std::get<BallShape>(*ball.shape).radius;
  if (const auto flight = other.still() ? flightOf(ball, from) : std::nullopt) {
    if (const auto* plane = std::get_if<PlaneShape>(other.shape); plane && !plane->bounded()) {
      ++count;
      return planeRoot(*flight, *other.collider, from, to);
    }
    const Pose X = other.at(from).pose;
    if (const auto* box = std::get_if<BoxShape>(other.shape)) {
      const BallFlight local = flight->seenFrom(X);
      const auto entry = local.timeToBox(*box, to - from);
      if (entry.hit) {
        ++count;
        return Touch{from + entry.time, ballGap(flight->at(entry.time), r, *other.shape, X), false};
      }
      from += entry.time;
      if (!(from <= to)) return {};
    }
    if (const auto* mesh = std::get_if<MeshShape>(other.shape)) {
      const BallFlight local = flight->seenFrom(X);
      if (!isInside(local, *mesh))
        return flightOnMesh(local, mesh->tree, OwnFace(ball, other, X), X, from, to,
                            touchTolerance(flight->p), count);
    }
  }
  const Kinematics ko = other.at(from);
  const Vec3 c0 = centreAt(ball, from).p;
  const double bound = relativeAcceleration(ball, other, from, to, (c0 - ko.p).norm());
  if (std::holds_alternative<MeshShape>(*other.shape))
    return ballOnMesh(ball, other, ko, from, to, bound, count);
  Gap gap;
  const auto probe = [&](double tau) {
    const Centre c = centreAt(ball, tau);
    const Kinematics o = other.at(tau);
    gap = ballGap(c.p, r, *other.shape, o.pose);
    return Probe{gap.distance, gap.normal.dot(c.v - o.velocityAt(gap.point))};
  };
  const auto tau = firstRoot(probe, from, to, bound, touchTolerance(c0), count);
  if (!tau) return {};
  probe(*tau);
  return Touch{*tau, gap, false};
}

/// A mesh's corners against a plane, each on its own path. Those that can be down soonest come first, so that
/// most need not be followed at all; of several that touch at the same time the first of the mesh counts.
std::optional<Touch> cornersOnPlane(const Side& solid, const Side& plane, double from, double to,
                                    std::uint64_t& count) {
  const auto& s = std::get<PlaneShape>(*plane.shape);
  const Kinematics k0 = solid.at(from), p0 = plane.at(from);
  const double bound = relativeAcceleration(solid, plane, from, to, (k0.p - p0.p).norm());
  const double tolerance = touchTolerance(k0.p);
  const std::vector<Vec3>& corners = std::get<MeshShape>(*solid.shape).tree.corners();
  const auto height = [&](const Vec3& corner, const Kinematics& k, const Kinematics& p) {
    const Pose X = p.pose * s.pose;
    const Vec3 x = k.pose * corner, n = X.q * Vec3::UnitZ();
    return Probe{n.dot(x - X.p), n.dot(k.velocityAt(x) - p.velocityAt(x))};
  };
  std::vector<std::pair<double, std::size_t>> soonest;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto time = soonestRoot(height(corners[i], k0, p0), from, bound, tolerance);
    if (time && *time <= to) soonest.emplace_back(*time, i);
  }
  std::ranges::make_heap(soonest, std::greater{});
  std::optional<Touch> best;
  std::size_t first = 0;
  double end = to;
  while (!soonest.empty() && soonest.front().first <= end) {
    std::ranges::pop_heap(soonest, std::greater{});
    const std::size_t i = soonest.back().second;
    soonest.pop_back();
    const Vec3& corner = corners[i];
    const auto probe = [&](double tau) {
      return tau == from ? height(corner, k0, p0) : height(corner, solid.at(tau), plane.at(tau));
    };
    const auto tau = firstRoot(probe, from, end, bound, tolerance, count);
    if (!tau || (best && (*tau > best->tau || (*tau == best->tau && i > first)))) continue;
    const Pose X = plane.at(*tau).pose * s.pose;
    const Vec3 x = solid.at(*tau).pose * corner, l = X.inverse() * x;
    if (s.bounded() && (std::fabs(l.x()) > s.half.x() || std::fabs(l.y()) > s.half.y())) continue;
    best = Touch{*tau, {l.z(), x, X.q * Vec3::UnitZ(), true, -1}, false};
    first = i;
    end = *tau;
  }
  return best;
}

bool isBall(const Side& s) {
  return std::holds_alternative<BallShape>(*s.shape);
}
bool isPlane(const Side& s) {
  return std::holds_alternative<PlaneShape>(*s.shape);
}

bool isMesh(const Side& s) {
  return std::holds_alternative<MeshShape>(*s.shape);
}

/// Whether what the solid sweeps is not all over the plane: its faces may then meet the plane's rim.
bool mayMeetRim(const Side& solid, const Side& plane, double from, double to) {
  const auto& s = std::get<PlaneShape>(*plane.shape);
  if (!s.bounded()) return false;
  if (!plane.still()) return true;
  const Aabb box = sweptBox(solid, from, to);
  const Pose X = (plane.at(from).pose * s.pose).inverse();
  for (int i = 0; i < 8; ++i) {
    const Vec3 l = X * Vec3(i & 1 ? box.hi.x() : box.lo.x(), i & 2 ? box.hi.y() : box.lo.y(),
                            i & 4 ? box.hi.z() : box.lo.z());
    if (std::fabs(l.x()) > s.half.x() || std::fabs(l.y()) > s.half.y()) return true;
  }
  return false;
}

void flip(Gap& g) {
  g.point += g.distance * g.normal;
  g.normal = -g.normal;
}

}  // namespace

double relativeAcceleration(const Side& a, const Side& b, double from, double to, double distance) {
  const MotionBound ba = a.boundOver(from, to), bb = b.boundOver(from, to);
  const double ra = a.body ? a.body->reach : a.bound().centre.norm() + a.bound().radius;
  double arm = 0;
  if (bb.spin > 0 || bb.spinChange > 0) {
    // Points of A stay within this distance of B's centre while it matters.
    const double rb = std::isfinite(b.bound().radius)
                          ? (b.body ? b.body->reach : b.bound().centre.norm() + b.bound().radius)
                          : distance;
    arm = rb + 2 * ra + (ba.speedAt(ra) + bb.speedAt(rb)) * (to - from);
    if (arm > distance + 2 * ra + (ba.speed + bb.speed) * (to - from))
      arm = distance + 2 * ra + (ba.speed + bb.speed) * (to - from);
  }
  const double turning = bb.spin * 2 * (ba.speedAt(ra) + bb.speedAt(arm));
  return ba.accelerationAt(std::holds_alternative<BallShape>(*a.shape)
                               ? (a.body ? a.body->eccentricity() : a.bound().centre.norm())
                               : ra) +
         bb.accelerationAt(arm) + turning;
}

double touchTolerance(const Vec3& p) {
  return std::max(1e-12, 4e-15 * p.cwiseAbs().maxCoeff());
}

Gap ballGap(const Vec3& centre, double radius, const Shape& shape, const Pose& X, DistanceLimits limits) {
  const Vec3 c = X.q.conjugate() * (centre - X.p);
  return std::visit([&](const auto& s) { return inWorld(localGap(c, radius, s, limits), X); }, shape);
}

std::optional<Touch> firstTouch(const Side& a, const Side& b, double from, double to, std::uint64_t& count) {
  if (isBall(a) && isBall(b) && isFreeBall(a) && isFreeBall(b)) return ballsTouch(a, b, from, to, count);
  if (isBall(a)) return ballTouch(a, b, from, to, count);
  const auto flipped = [](std::optional<Touch> t) {
    if (t) {
      flip(t->gap);
      t->swapped = true;
    }
    return t;
  };
  if (isBall(b)) return flipped(ballTouch(b, a, from, to, count));
  if (isPlane(a) && isPlane(b)) return {};
  const bool convexA = isConvex(*a.shape), convexB = isConvex(*b.shape);
  if (isPlane(b) && isMesh(a))
    return mayMeetRim(a, b, from, to) ? meshesTouch(a, b, from, to, count)
                                      : cornersOnPlane(a, b, from, to, count);
  if (isPlane(a) && isMesh(b)) return flipped(firstTouch(b, a, from, to, count));
  if (convexA && convexB) return convexTouch(a, b, from, to, count);
  if (convexA) return isPlane(b) ? planeTouch(a, b, from, to, count) : meshTouch(a, b, from, to, count);
  if (convexB)
    return flipped(isPlane(a) ? planeTouch(b, a, from, to, count) : meshTouch(b, a, from, to, count));
  return meshesTouch(a, b, from, to, count);
}

namespace {

Vec3 pointOf(const Shape& shape) {
  const auto* mesh = std::get_if<MeshShape>(&shape);
  return mesh && !mesh->tree.empty() ? mesh->tree.corners().front() : boundingSphere(shape).centre;
}

/// What lies wholly in a closed mesh, whose surface is this far off, is not apart from it.
void countInside(Gap& gap, const Shape& inner, const Pose& X_WI, const Shape& outer, const Pose& X_WO,
                 double limit) {
  const auto* mesh = std::get_if<MeshShape>(&outer);
  if (!(gap.distance > 0) || !mesh) return;
  const Vec3 x = X_WI * pointOf(inner);
  if (!mesh->tree.encloses(X_WO.inverse() * x)) return;
  if (!(gap.distance < limit)) gap.distance = limit, gap.point = x;
  gap.distance = -gap.distance;
  gap.normal = -gap.normal;
}

}  // namespace

Gap gapBetween(const Side& a, const Side& b, double tau, DistanceLimits limits) {
  if (isBall(a)) {
    if (isBall(b) && isFreeBall(a) && isFreeBall(b)) return ballsGap(a, b, tau);
    return ballGap(centreAt(a, tau).p, std::get<BallShape>(*a.shape).radius, *b.shape, b.at(tau).pose,
                   limits);
  }
  return gapBetween(a, a.at(tau), b, b.at(tau), limits);
}

Gap gapBetween(const Side& a, const Kinematics& ka, const Side& b, const Kinematics& kb,
               DistanceLimits limits) {
  if (isBall(a))
    return ballGap(ballCentre(a, ka), std::get<BallShape>(*a.shape).radius, *b.shape, kb.pose, limits);
  const bool swap = isBall(b) || (isPlane(a) && !isPlane(b)) || (!isConvex(*a.shape) && isConvex(*b.shape));
  if (swap && !isPlane(b)) {
    Gap g = gapBetween(b, kb, a, ka, limits);
    flip(g);
    return g;
  }
  if (isPlane(a)) return {};
  if (!isConvex(*a.shape)) {
    const auto* mesh = std::get_if<MeshShape>(b.shape);
    if (mesh) {
      const auto& own = std::get<MeshShape>(*a.shape);
      Gap gap = limits.limit < 1e300 ? meshesGapWithin(own.tree, ka.pose, mesh->tree, kb.pose, limits.limit)
                                     : meshesGap(own, ka.pose, *mesh, kb.pose);
      countInside(gap, *a.shape, ka.pose, *b.shape, kb.pose, limits.limit);
      countInside(gap, *b.shape, kb.pose, *a.shape, ka.pose, limits.limit);
      return gap;
    }
    Gap best;  // a mesh over a plane, bounded or not
    for (const Vec3& corner : std::get<MeshShape>(*a.shape).tree.corners()) {
      const Vec3 x = ka.pose * corner;
      const Gap g = ballGap(x, 0, *b.shape, kb.pose);
      if (g.distance < best.distance) best = {g.distance, x, g.normal, true, -1};
    }
    return best;
  }
  if (isConvex(*b.shape)) return convexGapBetween(*a.shape, ka.pose, *b.shape, kb.pose);
  if (const auto* plane = std::get_if<PlaneShape>(b.shape))
    return planeGapBetween(*a.shape, ka.pose, *plane, kb.pose);
  Gap gap = meshGapBetween(*a.shape, ka.pose, std::get<MeshShape>(*b.shape), kb.pose, limits.limit);
  countInside(gap, *a.shape, ka.pose, *b.shape, kb.pose, limits.limit);
  return gap;
}

Aabb sweptBox(const Side& side, double from, double to) {
  const Sphere& s = side.bound();
  Aabb box;
  if (!std::isfinite(s.radius)) {
    box.lo.setConstant(-1e300);
    box.hi.setConstant(1e300);
    return box;
  }
  const auto sweep = [&](const Pose& X0, const Pose& X1, const MotionBound& b, double arm, double seconds) {
    const Vec3 c0 = X0 * s.centre, c1 = X1 * s.centre;
    const double sag = b.accelerationAt(arm) * seconds * seconds / 8 + s.radius + 1e-6;
    box.include(Vec3(c0.cwiseMin(c1).array() - sag));
    box.include(Vec3(c0.cwiseMax(c1).array() + sag));
  };
  if (!side.guided()) {
    const Pose X0 = side.at(from).pose;
    const double arm = side.body ? (side.body->X_NC.p - s.centre).norm() : s.centre.norm();
    sweep(X0, side.still() ? X0 : side.at(to).pose, side.boundOver(from, to), arm, to - from);
    return box;
  }
  const GuidedMotion& m = *side.motion();
  for (std::size_t i = m.partAfter(from); i < m.arcs.size() && (i == 0 || m.arcs[i].tau <= to); ++i) {
    const ArcPiece& part = m.arcs[i];
    const double start = std::max(from, part.tau),
                 end = std::max(start, i + 1 < m.arcs.size() ? std::min(to, m.arcs[i + 1].tau) : to);
    sweep(part.at(start).pose, part.at(end).pose, part.boundOver(start, end), s.centre.norm(), end - start);
  }
  return box;
}

}  // namespace stadion
