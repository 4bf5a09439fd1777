#pragma once
/// Over which area two solids touch that lie flat on each other.

#include "dynamics/collision/manifold.h"
#include "dynamics/contact/flat_friction.h"

#include <memory>
#include <span>

namespace stadion {

/// A plane of contact: n from b to a, coordinates along t1 and t2 from `origin`.
struct ContactPlane {
  Vec3 origin = Vec3::Zero(), n = Vec3::UnitZ(), t1 = Vec3::UnitX(), t2 = Vec3::UnitY();
  double thick = 0;  ///< faces this near to it count [m]

  Vec2 on(const Vec3& x) const { return {t1.dot(x - origin), t2.dot(x - origin)}; }
  Vec3 at(const Vec2& x) const { return origin + x.x() * t1 + x.y() * t2; }
};

struct FlatContact {
  ContactPlane plane;  ///< plane of the contact; its origin is the middle of the area
  std::shared_ptr<const ContactArea> area;
  Carrier carrier = Carrier::A;       ///< side whose face the contact plane moves with
  std::vector<std::uint32_t> points;  ///< those of the given points that carry the area
};

/// Returns the common area of the faces of a and b, for each plane in which at least three of these points of
/// contact touch. b may be several pieces that make up one surface; none may overlap another. Areas that are
/// too large to compute are left out.
std::vector<FlatContact> flatContacts(const Side& a, std::span<const Side> b, double tau,
                                      std::span<const Gap> points);

}  // namespace stadion
