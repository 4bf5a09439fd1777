#pragma once
/// When and where two moving shapes first touch, and how far apart they are.
///
/// Method   the gap g of a moving convex pair obeys g(t + s) >= g + g' s - A s^2 / 2. A is a bound on the
///          relative acceleration of its points. The root of the right side is a step that cannot pass a
///          contact; near a contact it converges quadratically. A ball against a still plane has a closed
///          form. Pairs of meshes step by motion bounds on the distance.
/// Times    tau is seconds since the start of the world's present window (dynamics/state/world_time.h).

#include "dynamics/body/rigid_body.h"

namespace stadion {

/// A side of a pair through the present frame.
struct Side {
  ContactSide key;
  const Shape* shape = nullptr;
  const RigidBody* body = nullptr;  ///< exactly one of these two
  const Collider* collider = nullptr;

  static Side of(const RigidBody& b) { return {{true, b.id}, b.shape, &b, nullptr}; }
  static Side of(const Collider& c) { return {{false, c.id}, c.shape, nullptr, &c}; }
  Kinematics at(double tau) const { return body ? body->at(tau) : collider->motion.at(tau); }
  MotionBound boundOver(double from, double to) const {
    return body ? body->boundOver(from, to) : collider->motion.boundOver(from, to);
  }
  std::uint32_t version() const { return body ? body->version : collider->version; }
  const Sphere& bound() const { return body ? body->bound : collider->bound; }
  /// Its motion if something outside of the world prescribes it, else null.
  const GuidedMotion* motion() const {
    if (collider) return &collider->motion;
    return body->mode == BodyMode::Held ? &body->grip.held : nullptr;
  }
  bool guided() const { return motion() && motion()->guided(); }
  bool still() const { return body ? standsStill(body->mode) : !collider->motion.moving; }
};

/// The nearest points of two shapes.
struct Gap {
  double distance = 1e300;      ///< negative when they overlap [m]
  Vec3 point = Vec3::Zero();    ///< on B, in World
  Vec3 normal = Vec3::UnitZ();  ///< from B to A, unit
  bool face = false;            ///< A touches a flat face of B, not an edge or corner
  std::int32_t triangle = -1;   ///< triangle of B's mesh
};

struct Touch {
  double tau = 0;  ///< [s]
  Gap gap;
  bool swapped = false;  ///< gap was measured from the second side
};

/// The distances that must be exact.
struct DistanceLimits {
  double limit = 1e300;        ///< no distance beyond this one [m]
  double enough = 0;           ///< below this distance, any point will do instead of the nearest [m]
  std::int32_t triangle = -1;  ///< triangle of a mesh at which such a point may be
};

/// How far a ball is from a shape at X_WN.
Gap ballGap(const Vec3& centre, double radius, const Shape& shape, const Pose& X_WN,
            DistanceLimits limits = {});

/// Returns the first contact in [from, to] of sides that approach; nothing if they stay apart. Adds the
/// number of computed distances to `distances`.
std::optional<Touch> firstTouch(const Side& a, const Side& b, double from, double to,
                                std::uint64_t& distances);

/// The gap at `tau`, for release events and reports. Its normal points from b to a.
Gap gapBetween(const Side& a, const Side& b, double tau, DistanceLimits limits = {});
/// Returns the gap between sides whose poses at tau are known.
Gap gapBetween(const Side& a, const Kinematics& ka, const Side& b, const Kinematics& kb,
               DistanceLimits limits = {});

/// The box around a side from `from` to `to`.
Aabb sweptBox(const Side& side, double from, double to);

/// Gaps below this count as touching, at distance |p| from the origin.
double touchTolerance(const Vec3& p);

}  // namespace stadion
