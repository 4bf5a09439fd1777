#include "dynamics/world/flush_surfaces.h"

#include "dynamics/collision/manifold.h"
#include "dynamics/world/ball_support.h"
#include "dynamics/world/penetration_recoveries.h"

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

/// Whatever the body touches at tau is in here, or nearer than kTouching.
Aabb boxAround(const RigidBody& b, double tau) {
  const double reach = b.bound.radius + kTouching;
  Aabb box;
  box.include(b.poseAt(tau) * b.bound.centre);
  box.lo.array() -= reach;
  box.hi.array() += reach;
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
void FlushSurfaces::eachColliderAt(const RigidBody& b, double tau, F f) const {
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
std::vector<Bearing> FlushSurfaces::bearingsOf(const RigidBody& b, double tau, const Collider& but) const {
  std::vector<Bearing> bearings;
  ContactSide face;
  if (b.mode == BodyMode::Slide || b.mode == BodyMode::Roll) face = b.support.on;
  const Side self = Side::of(b);
  std::vector<ManifoldPoint> points;
  eachColliderAt(b, tau, [&](const Collider& c) {
    const Side other = Side::of(c);
    const Pose X = c.motion.at(tau).pose;
    if (face.id && other.key == face) {
      Gap gap;
      gap.distance = 0;
      gap.face = true;
      gap.triangle = b.support.triangle;
      gap.point = b.support.point;
      gap.normal = b.support.normal;
      bearings.push_back({other.key, c.shape, X, gap});
      return;
    }
    if (&c == &but && !(std::holds_alternative<MeshShape>(*c.shape) &&
                        memory_.touching(ContactMemory::keyOf(other.key, self.key))))
      return;
    manifold(self, other, tau, kTouching, points);
    for (const ManifoldPoint& p : points) bearings.push_back({other.key, c.shape, X, p.gap});
  });
  return bearings;
}

/// Returns true if the body meets there only what a surface that it already touches hides. A touch at a slit
/// gets the normal of the surface.
bool FlushSurfaces::isHiddenTouch(const Side& a, const Side& b, Touch& touch) const {
  const Side &body = a.body ? a : b, &piece = a.body ? b : a;
  if (!body.body || !piece.collider || !body.body->movable()) return false;
  const Bearing own{piece.key, piece.shape, piece.at(touch.tau).pose, fromBody(touch, a.body != nullptr)};
  const std::vector<Bearing> bearings = bearingsOf(*body.body, touch.tau, *piece.collider);
  const auto normal = normalOverSlit(own, bearings);
  for (const Bearing& on : bearings) {
    const bool inSurface = !normal && isInSurface(own, on);
    const bool hides = normal ? (on.gap.point - own.gap.point).norm() <= kFlush : isHidden(own, on, bearings);
    if (!hides && !inSurface) continue;
    if (const auto slope = normal ? std::nullopt : normalOfRise(own, on)) {
      touch.gap.normal = a.body ? *slope : Vec3(-*slope);
      return false;
    }
    if (!hides) continue;
    // Where each hides the other, as at a slit, the one counts that carries the body already.
    if (carriesAlready(*body.body, on.of)) return true;
    if (!normal && !isHidden(on, own, bearings) && isSquareToPiece(on)) return true;
  }
  if (normal) touch.gap.normal = a.body ? *normal : Vec3(-*normal);
  return false;
}

/// Returns true if the body is in contact with the piece, or rolls or slides on it.
bool FlushSurfaces::carriesAlready(const RigidBody& b, ContactSide piece) const {
  return b.support.on == piece || memory_.touching(ContactMemory::keyOf(piece, {true, b.id}));
}

/// The first touch in [from, to] that is more than a seam.
std::optional<Touch> FlushSurfaces::firstRealTouch(const Side& a, const Side& b, double from, double to) {
  std::optional<Touch> touch = search_.first(a, b, from, to);
  double skip = 0;
  while (touch && isHiddenTouch(a, b, *touch)) {
    const Kinematics ka = a.at(touch->tau), kb = b.at(touch->tau);
    const double speed = (ka.velocityAt(touch->gap.point) - kb.velocityAt(touch->gap.point)).norm();
    skip = std::max(2 * skip, kSkip / std::max(speed, 1e-3));
    const double next = touch->tau + skip;
    if (!(next <= to)) return {};
    touch = search_.first(a, b, next, to);
  }
  return touch;
}

/// Still colliders that the body may strike in the same moment as `but`.
std::vector<PatchSide> FlushSurfaces::struckBeside(const RigidBody& b, const Collider& but, double tau,
                                                   bool ends) const {
  std::vector<PatchSide> struck;
  if (but.motion.moving) return struck;
  eachColliderAt(b, tau, [&](const Collider& c) {
    if (&c == &but || c.motion.moving) return;
    const PairSurface pair = combine(b.surface, c.surface);
    struck.push_back({Side::of(c), ends ? 0 : pair.restitution, pair.friction});
  });
  std::ranges::sort(struck, {}, [](const PatchSide& p) { return p.side.key; });
  return struck;
}

/// Looks for a face of another collider that goes on where the ball's face ends: true if it rolls on there,
/// `lift` higher than before.
bool FlushSurfaces::crossSeam(RigidBody& b, double tau, double& lift) {
  const Vec3 n = b.support.normal, v = b.velocity(tau), p = b.position(tau);
  const double r = b.radius(), speed = v.norm();
  if (!(speed > 0)) return false;
  Aabb box;
  box.include(p - r * n);
  box.lo.array() -= 2 * kFlush;
  box.hi.array() += 2 * kFlush;
  const ContactSide self{true, b.id}, before = b.support.on;
  for (const double ahead : {kSkip, kFlush}) {
    const Vec3 x = p + ahead / speed * v;
    ColliderId next = 0;
    Support face;
    double height = 0;
    boxes_.eachCollider(box, [&](const Collider& c) {
      if (c.id == before.id || (next && c.id > next) || !objects_.mayTouch(Side::of(b), Side::of(c))) return;
      const Gap gap = ballGap(x, r, *c.shape, c.motion.end, {kFlush});
      if (!(std::fabs(gap.distance) <= kFlush) || !(gap.normal.dot(n) > kOnePlane)) return;
      if (supportFor(b, c, gap, face)) {
        next = c.id;
        height = gap.distance;
      }
    });
    if (!next) continue;
    b.support = face;
    lift = -height;
    memory_.setTouching(ContactMemory::keyOf(before, self), false);
    return true;
  }
  return false;
}

/// How long flat faces of one plane and one friction carry a point that glides at u under a along them, at
/// most about `most`; negative if nothing carries it now. `way` learns the colliders that it comes to.
double FlushSurfaces::timeCarried(const RigidBody& b, ColliderId start, const Gap& gap, double friction,
                                  const Vec3& u, const Vec3& a, double most,
                                  std::vector<ContactSide>& way) const {
  const Vec3& n = gap.normal;
  const double speed = u.norm(), gain = a.norm();
  const Vec3 e = speed > 0 && !(speed < 1e-9 && gain > 0) ? Vec3(u / speed) : Vec3(a / gain);
  const double u0 = e.dot(u), a0 = e.dot(a);
  const Collider* on = objects_.collider(start);
  std::optional<FlatFace> face = flatFace(*on, n);
  if (!face) return -1;
  const Side self = Side::of(b);
  double gone = 0;
  for (int i = 0; i < kMostPieces; ++i) {
    const double next = gone + 2 * kSkip;
    if (!face->holds(gap.point + next * e)) {
      const Collider* beyond = nullptr;
      for (const double ahead : {2 * kSkip, kFlush}) {
        const Vec3 x = gap.point + (gone + ahead) * e;
        Aabb box;
        box.include(x);
        box.lo.array() -= kSkip;
        box.hi.array() += kSkip;
        boxes_.eachCollider(box, [&](const Collider& c) {
          if ((beyond && c.id > beyond->id) || !objects_.mayTouch(self, Side::of(c))) return;
          const auto other = flatFace(c, n);
          if (!other || !other->holds(x) || std::fabs(n.dot(other->X.p - gap.point)) > kSamePlane ||
              std::fabs(n.dot(other->X.q * Vec3::UnitZ())) < kSquareOn ||
              combine(b.surface, c.surface).friction != friction)
            return;
          beyond = &c;
          face = other;
        });
        if (beyond) break;
      }
      if (!beyond) return gone > 0 ? timeTo(gone, u0, a0) : -1;
      if (std::ranges::find(way, ContactSide{false, beyond->id}) == way.end())
        way.push_back({false, beyond->id});
    }
    gone = std::max(next, face->room(gap.point, e));
    if (!(timeTo(gone, u0, a0) < most)) return most;
  }
  return timeTo(gone, u0, a0);
}

}  // namespace stadion
