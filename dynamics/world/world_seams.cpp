#include "dynamics/collision/touch_seams.h"
#include "dynamics/world/world_core.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kOnePlane =
    1 - 1e-8;  ///< cosine between the normals of faces that a ball rolls over as over one
constexpr double kSamePlane = 1e-7;      ///< points that differ less in height lie in one plane [m]
constexpr double kSquareOn = 1 - 1e-12;  ///< cosine between normals that are one
constexpr double kSlack = 1e-9;          ///< a face reaches so far beyond its border [m]
constexpr int kMostPieces = 1000;        ///< that one glide goes over
constexpr double kSkip = 1e-6;  ///< way after which a hidden touch is looked at again; then twice as far [m]

/// A flat rectangular face of a collider that does not move.
struct FlatFace {
  Pose X;     ///< z is the face's normal, or against it
  Vec2 half;  ///< along x and y of X

  bool holds(const Vec3& x) const {
    const Vec3 l = X.inverse() * x;
    return std::fabs(l.x()) <= half.x() + kSlack && std::fabs(l.y()) <= half.y() + kSlack;
  }
  /// How far a point at x may go along e until it leaves the face.
  double room(const Vec3& x, const Vec3& e) const {
    const Vec3 l = X.inverse() * x, d = X.q.conjugate() * e;
    double most = 1e300;
    for (int i = 0; i < 2; ++i)
      if (std::fabs(d[i]) > 1e-12)
        most = std::min(most, (half[i] - (d[i] > 0 ? l[i] : -l[i])) / std::fabs(d[i]));
    return most;
  }
};

std::optional<FlatFace> flatFace(const Collider& c, const Vec3& n) {
  if (c.motion.moving) return {};
  const Pose& X = c.motion.end;
  if (const auto* plane = std::get_if<PlaneShape>(c.shape)) return FlatFace{X * plane->pose, plane->half};
  const auto* box = std::get_if<BoxShape>(c.shape);
  if (!box) return {};
  const Pose F = X * box->pose;
  int up = 0;
  (F.q.conjugate() * n).cwiseAbs().maxCoeff(&up);
  const double side = n.dot(F.q * Vec3::Unit(up)) < 0 ? -1 : 1;
  const double half = std::sqrt(0.5);  // a quarter turn takes z to x or y
  const Quat turn = up == 0 ? Quat(half, 0, half, 0) : up == 1 ? Quat(half, -half, 0, 0) : Quat::Identity();
  FlatFace face{{F.p + side * box->half[up] * (F.q * Vec3::Unit(up)), F.q * turn}, {}};
  // A quarter turn puts x and y on two of the box's axes.
  const Vec3 sides = (turn.conjugate() * box->half).cwiseAbs();
  face.half = sides.head<2>();
  return face;
}

/// When u t + a t^2 / 2 reaches d; infinity if it does not.
double timeTo(double d, double u, double a) {
  const double square = u * u + 2 * a * d;
  if (square < 0) return 1e300;
  const double q = u + std::sqrt(square);
  return q > 0 ? 2 * d / q : 1e300;
}

/// Which of these points in a plane are corners of their convex hull; of points at one place one.
std::vector<char> hullCorners(const std::vector<Vec2>& p) {
  constexpr double kOnLine = 1e-7;  // [m]
  std::vector<std::size_t> order(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) order[i] = i;
  std::ranges::sort(order, [&](std::size_t i, std::size_t k) {
    return p[i].x() != p[k].x() ? p[i].x() < p[k].x() : p[i].y() != p[k].y() ? p[i].y() < p[k].y() : i < k;
  });
  const auto turns = [&](std::size_t a, std::size_t b,
                         std::size_t c) {  // b is farther than rounding left of a to c
    const Vec2 along = p[c] - p[a], to = p[b] - p[a];
    const double cross = along.x() * to.y() - along.y() * to.x();
    return -cross > kOnLine * along.norm();
  };
  std::vector<std::size_t> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t begin = hull.size();
    for (const std::size_t i : order) {
      if (hull.size() > begin && (p[hull.back()] - p[i]).norm() < kOnLine) continue;
      while (hull.size() > begin + 1 && !turns(hull[hull.size() - 2], hull.back(), i)) hull.pop_back();
      hull.push_back(i);
    }
    if (hull.size() > begin + 1) hull.pop_back();
    std::ranges::reverse(order);
  }
  std::vector<char> corner(p.size(), 0);
  for (const std::size_t i : hull) corner[i] = 1;
  return corner;
}

template <class T>
void eraseMarked(std::vector<T>& list, std::size_t first, const std::vector<char>& marked) {
  std::size_t kept = first;
  for (std::size_t i = first; i < list.size(); ++i) {
    if (marked[i]) continue;
    if (kept != i) list[kept] = std::move(list[i]);
    ++kept;
  }
  list.resize(kept);
}

/// Whatever the body touches at tau is in here, or nearer than kTouching.
Aabb boxAround(const RigidBody& b, double tau) {
  const double reach = b.bound.radius + kTouching;
  Aabb box;
  box.include(b.poseAt(tau) * b.bound.centre);
  box.lo.array() -= reach, box.hi.array() += reach;
  return box;
}

Gap fromBody(const Touch& touch, bool bodyFirst) {
  Gap g = touch.gap;
  if (!bodyFirst) g.normal = -g.normal;
  return g;
}

}  // namespace

/// Calls f(collider) with those that the body may touch at tau.
template <class F>
void World::Core::eachColliderAt(const RigidBody& b, double tau, F f) const {
  const Side self = Side::of(b);
  const Aabb box = boxAround(b, tau);
  boxes_.eachCollider(box, [&](const Collider& c) {
    const auto* plane = std::get_if<PlaneShape>(c.shape);
    const bool above = plane && !plane->bounded() && !c.motion.moving &&  // its box holds everything
                       c.planeNormal.dot(box.centre() - c.planePoint) > b.bound.radius + kTouching;
    if (!above && objects_.mayTouch(self, Side::of(c)) && !comesOutOf(b, c.id)) f(c);
  });
}

/// The surfaces of colliders that the body touches at tau, but for `but` unless that is a mesh.
std::vector<Bearing> World::Core::bearingsOf(const RigidBody& b, double tau, const Collider& but) const {
  std::vector<Bearing> bearings;
  Party face;
  if (b.mode == BodyMode::Slide || b.mode == BodyMode::Roll) face = b.support.on;
  const Side self = Side::of(b);
  std::vector<ManifoldPoint> points;
  eachColliderAt(b, tau, [&](const Collider& c) {
    const Side other = Side::of(c);
    const Pose X = c.motion.at(tau).pose;
    if (face.id && other.party == face) {
      Gap gap;
      gap.distance = 0, gap.face = true, gap.triangle = b.support.triangle;
      gap.point = b.support.point, gap.normal = b.support.normal;
      bearings.push_back({other.party, c.shape, X, gap});
      return;
    }
    if (&c == &but && !(std::holds_alternative<MeshShape>(*c.shape) &&
                        memory_.touching(ContactMemory::keyOf(other.party, self.party))))
      return;
    manifold(self, other, tau, kTouching, points);
    for (const ManifoldPoint& p : points) bearings.push_back({other.party, c.shape, X, p.gap});
  });
  return bearings;
}

std::span<const World::Core::Beside> World::Core::besideOf(BodyId id) const {
  return {std::ranges::lower_bound(beside, id, {}, &Beside::body),
          std::ranges::upper_bound(beside, id, {}, &Beside::body)};
}

/// Whether the body meets there only what a surface that it already touches hides.
bool World::Core::isHiddenTouch(const Side& a, const Side& b, const Touch& touch) const {
  const Side &body = a.body ? a : b, &piece = a.body ? b : a;
  if (!body.body || !piece.collider || !body.body->movable()) return false;
  const Gap gap = fromBody(touch, a.body != nullptr);
  const Pose X = piece.at(touch.tau).pose;
  return std::ranges::any_of(bearingsOf(*body.body, touch.tau, *piece.collider),
                             [&](const Bearing& on) { return isHidden(gap, *piece.shape, X, on); });
}

/// The first touch in [from, to] that is more than a seam.
std::optional<Touch> World::Core::firstRealTouch(const Side& a, const Side& b, double from, double to) {
  std::optional<Touch> touch = firstTouch(a, b, from, to, counters.distances);
  double skip = 0;
  while (touch && isHiddenTouch(a, b, *touch)) {
    const Kinematics ka = a.at(touch->tau), kb = b.at(touch->tau);
    const double speed = (ka.velocityAt(touch->gap.point) - kb.velocityAt(touch->gap.point)).norm();
    skip = std::max(2 * skip, kSkip / std::max(speed, 1e-3));
    const double next = touch->tau + skip;
    if (!(next <= to)) return {};
    touch = firstTouch(a, b, next, to, counters.distances);
  }
  return touch;
}

/// Still colliders that the body may strike in the same moment as `but`.
std::vector<PatchSide> World::Core::struckBeside(const RigidBody& b, const Collider& but, double tau,
                                                 bool ends) const {
  std::vector<PatchSide> struck;
  if (but.motion.moving) return struck;
  eachColliderAt(b, tau, [&](const Collider& c) {
    if (&c == &but || c.motion.moving) return;
    const PairSurface pair = combine(b.surface, c.surface);
    struck.push_back({Side::of(c), ends ? 0 : pair.restitution, pair.friction});
  });
  std::ranges::sort(struck, {}, [](const PatchSide& p) { return p.side.party; });
  return struck;
}

/// Looks for a face of another collider that goes on where the ball's face ends: true if it rolls on there,
/// `lift` higher than before.
bool World::Core::crossSeam(RigidBody& b, double tau, double& lift) {
  const Vec3 n = b.support.normal, v = b.velocity(tau), p = b.position(tau);
  const double r = b.radius(), speed = v.norm();
  if (!(speed > 0)) return false;
  Aabb box;
  box.include(p - r * n);
  box.lo.array() -= 2 * kFlush, box.hi.array() += 2 * kFlush;
  const Party self{true, b.id}, before = b.support.on;
  for (const double ahead : {kSkip, kFlush}) {
    const Vec3 x = p + ahead / speed * v;
    ColliderId next = 0;
    Support face;
    double height = 0;
    boxes_.eachCollider(box, [&](const Collider& c) {
      if (c.id == before.id || (next && c.id > next) || !objects_.mayTouch(Side::of(b), Side::of(c))) return;
      const Gap gap = ballGap(x, r, *c.shape, c.motion.end, {kFlush});
      if (!(std::fabs(gap.distance) <= kFlush) || !(gap.normal.dot(n) > kOnePlane)) return;
      if (supportFor(b, c, gap, face)) next = c.id, height = gap.distance;
    });
    if (!next) continue;
    b.support = face;
    lift = -height;
    memory_.setTouching(ContactMemory::keyOf(before, self), false);
    return true;
  }
  return false;
}

/// Takes what is hidden out of a body's contacts, which begin at `first`.
void World::Core::dropHidden(const RigidBody& b, double tau, std::size_t first, std::vector<Found>& found) {
  bool several = false;
  for (std::size_t i = first; i < found.size() && !several; ++i)
    several = found[i].b != found[first].b || found[i].gap.normal != found[first].gap.normal;
  if (!several) return;
  // In an order that does not depend on the broad phase's.
  std::ranges::stable_sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(), {}, &Found::b);
  std::vector<Bearing> points;
  std::vector<std::size_t> whose;
  for (std::size_t i = first; i < found.size(); ++i) {
    const Found& f = found[i];
    if (f.b.isBody) continue;
    const Collider& c = *objects_.collider(f.b.id);
    points.push_back({f.b, c.shape, c.motion.at(tau).pose, f.gap}), whose.push_back(i);
  }
  const std::vector<char> hidden = hiddenAmong(points);
  std::vector<char> gone(found.size(), 0);
  for (std::size_t k = 0; k < hidden.size(); ++k)
    if (hidden[k]) beside.push_back({b.id, found[whose[k]].b, false}), gone[whose[k]] = 1;
  eraseMarked(found, first, gone);
}

/// Points on one plane of flush colliders that feel alike count as those of one of them, and what lies
/// between others of them is left out: they carry the body as one face would.
void World::Core::joinFlush(const RigidBody& b, std::size_t first, std::vector<Found>& found) {
  const auto still = [&](const Found& f) { return !f.b.isBody && !objects_.collider(f.b.id)->motion.moving; };
  const auto alike = [&](const Found& f, const Found& o) {
    return f.gap.normal.dot(o.gap.normal) > kSquareOn &&
           std::fabs(f.gap.normal.dot(f.gap.point - o.gap.point)) < kSamePlane &&
           std::fabs(f.gap.distance - o.gap.distance) < kSamePlane &&
           f.surface.friction == o.surface.friction && f.surface.restitution == o.surface.restitution &&
           f.surface.rolling == o.surface.rolling && f.carrier == o.carrier &&
           f.rounding.radius == o.rounding.radius;
  };
  std::vector<char> gone(found.size(), 0), seen(found.size(), 0);
  std::vector<std::size_t> group;
  std::vector<Vec2> places;
  bool any = false;
  for (std::size_t i = first; i < found.size(); ++i) {
    if (seen[i] || !still(found[i])) continue;
    group.assign(1, i);
    bool several = false;
    for (std::size_t k = i + 1; k < found.size(); ++k)
      if (!seen[k] && still(found[k]) && alike(found[i], found[k])) {
        group.push_back(k);
        several = several || found[k].b != found[i].b;
      }
    if (!several) continue;
    const Mat3 basis = basisAround(found[i].gap.normal);
    places.clear();
    for (const std::size_t k : group)
      seen[k] = 1,
      places.push_back((basis.transpose() * (found[k].gap.point - found[i].gap.point)).tail<2>());
    const std::vector<char> corner = hullCorners(places);
    Party name;
    std::size_t kept = 0;
    for (std::size_t g = 0; g < group.size(); ++g)
      if (corner[g]) name = kept++ == 0 ? found[group[g]].b : std::min(name, found[group[g]].b);
    for (std::size_t g = 0; g < group.size(); ++g) {
      Found& f = found[group[g]];
      if (f.b != name) beside.push_back({b.id, f.b, f.gap.distance < kTouching});
      if (corner[g])
        f.b = name;
      else
        gone[group[g]] = 1, any = true;
    }
  }
  if (any) eraseMarked(found, first, gone);
}

/// How long flat faces of one plane and one friction carry a point that glides at u under a along them, at
/// most about `most`; negative if nothing carries it now. `way` learns the colliders that it comes to.
double World::Core::timeCarried(const RigidBody& b, const Found& f, const Vec3& u, const Vec3& a, double most,
                                std::vector<Party>& way) const {
  const Vec3& n = f.gap.normal;
  const double speed = u.norm(), gain = a.norm();
  const Vec3 e = speed > 0 && !(speed < 1e-9 && gain > 0) ? Vec3(u / speed) : Vec3(a / gain);
  const double u0 = e.dot(u), a0 = e.dot(a);
  const Collider* on = objects_.collider(f.b.id);
  std::optional<FlatFace> face = flatFace(*on, n);
  if (!face) return -1;
  const Side self = Side::of(b);
  double gone = 0;
  for (int i = 0; i < kMostPieces; ++i) {
    const double next = gone + 2 * kSkip;
    if (!face->holds(f.gap.point + next * e)) {
      const Collider* beyond = nullptr;
      for (const double ahead : {2 * kSkip, kFlush}) {
        const Vec3 x = f.gap.point + (gone + ahead) * e;
        Aabb box;
        box.include(x);
        box.lo.array() -= kSkip, box.hi.array() += kSkip;
        boxes_.eachCollider(box, [&](const Collider& c) {
          if ((beyond && c.id > beyond->id) || !objects_.mayTouch(self, Side::of(c))) return;
          const auto other = flatFace(c, n);
          if (!other || !other->holds(x) || std::fabs(n.dot(other->X.p - f.gap.point)) > kSamePlane ||
              std::fabs(n.dot(other->X.q * Vec3::UnitZ())) < kSquareOn ||
              combine(b.surface, c.surface).friction != f.contact.friction)
            return;
          beyond = &c, face = other;
        });
        if (beyond) break;
      }
      if (!beyond) return gone > 0 ? timeTo(gone, u0, a0) : -1;
      if (std::ranges::find(way, Party{false, beyond->id}) == way.end()) way.push_back({false, beyond->id});
    }
    gone = std::max(next, face->room(f.gap.point, e));
    if (!(timeTo(gone, u0, a0) < most)) return most;
  }
  return timeTo(gone, u0, a0);
}

}  // namespace stadion
