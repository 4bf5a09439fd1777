#include "dynamics/patch_impact.h"

#include "dynamics/contact_solver.h"
#include "dynamics/convex_core.h"
#include "dynamics/manifold.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr double kTogether = 1e-5;  ///< way that the last point of an impact has still to go [m]
constexpr double kSoon = 1e-4;      ///< and time [s]
constexpr double kSameSide = 0.99;  ///< cosine between the normals of its points

bool strikesWithAPoint(const Side& s, const Mobile& m, const Vec3& n) {
  ConvexCore core;
  const Pose turned{Vec3::Zero(), s.body ? Quat(m.q * s.body->X_CN.q) : m.q};
  return isConvex(*s.shape) && coreOf(*s.shape, turned, core) && pointed(core, n, kTogether);
}

}  // namespace

std::optional<PatchImpact> collidePatch(const Side& a, const Side& b, double tau, const Gap& first,
                                        Mobile& ma, Mobile& mb, double restitution, double friction) {
  const auto closing = [&](const Gap& g) {
    return g.normal.dot(mb.velocityAt(g.point) - ma.velocityAt(g.point));
  };
  const double speed = closing(first);
  if (!(speed > 0) || strikesWithAPoint(a, ma, first.normal) || strikesWithAPoint(b, mb, first.normal))
    return {};
  std::vector<ManifoldPoint> points;
  manifold(a, b, tau, std::max(first.distance, 0.0) + kTogether, points);
  std::vector<SolverContact> contacts;
  for (const ManifoldPoint& p : points) {
    const double comes = closing(p.gap);
    if (p.gap.normal.dot(first.normal) < kSameSide || !(p.gap.distance < kSoon * comes)) continue;
    SolverContact c;
    c.b = 1;
    c.placeAt(p.gap.point, p.gap.normal, ma.p, mb.p);
    c.friction = friction, c.floor = restitution * comes;
    contacts.push_back(c);
  }
  if (contacts.size() < 2) return {};
  std::vector<Mobile> mobiles{ma, mb};
  if (!solveContacts(mobiles, contacts)) return {};
  PatchImpact sum;
  double work = 0, pushed = 0;
  const std::vector<Mobile> before{ma, mb};
  for (const SolverContact& c : contacts) {
    work += 0.5 * c.impulse.dot(c.velocity(before) + c.velocity(mobiles));
    sum.impulse += c.push * c.impulse;
    sum.middle += c.impulse[0] * c.pushA, pushed += c.impulse[0];
  }
  if (work > 0 || !(pushed > 0)) return {};
  sum.middle = ma.p + sum.middle / pushed;
  ma = mobiles[0], mb = mobiles[1];
  return sum;
}

}  // namespace stadion
