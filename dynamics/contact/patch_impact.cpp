#include "dynamics/contact/patch_impact.h"

#include "dynamics/collision/manifold.h"
#include "dynamics/contact/contact_area.h"
#include "dynamics/contact/contact_solver.h"
#include "dynamics/shapes/convex_core.h"

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
                                        Mobile& ma, Mobile& mb, double restitution, double friction,
                                        std::vector<PatchSide>& beside) {
  const auto closing = [&](const Gap& g) {
    return g.normal.dot(mb.velocityAt(g.point) - ma.velocityAt(g.point));
  };
  const double speed = closing(first);
  if (!(speed > 0) || strikesWithAPoint(a, ma, first.normal) || strikesWithAPoint(b, mb, first.normal))
    return {};
  std::vector<ManifoldPoint> points;
  std::vector<SolverContact> contacts;
  std::vector<PatchSide*> whose;  // null: b's
  std::vector<Gap> gaps;
  const auto gather = [&](const Side& side, PatchSide* part, double bounce, double grip) {
    manifold(a, side, tau, std::max(first.distance, 0.0) + kTogether, points);
    for (const ManifoldPoint& p : points) {
      const double comes = closing(p.gap);
      if (p.gap.normal.dot(first.normal) < kSameSide || !(p.gap.distance < kSoon * comes)) continue;
      SolverContact c;
      c.b = 1;
      c.placeAt(p.gap.point, p.gap.normal, ma.p, mb.p);
      c.friction = grip, c.floor = bounce * comes;
      contacts.push_back(c), whose.push_back(part), gaps.push_back(p.gap);
      if (part) part->closing = std::max(part->closing, comes);
    }
  };
  gather(b, nullptr, restitution, friction);
  for (PatchSide& part : beside) part.closing = 0, gather(part.side, &part, part.restitution, part.friction);
  if (contacts.size() < 2) return {};
  std::vector<FlatContact> flats;  // own the areas
  const auto flatten = [&](const Side& side, PatchSide* part, double grip) {
    const auto begin = static_cast<std::size_t>(std::ranges::find(whose, part) - whose.begin());
    const auto count = static_cast<std::size_t>(std::ranges::count(whose, part));
    if (!(grip > 0) || count < 3) return;
    for (FlatContact& flat : flatContacts(a, {&side, 1}, tau, std::span(gaps).subspan(begin, count))) {
      SolverContact c;
      c.b = 1, c.friction = grip, c.area = flat.area.get();
      c.placeAt(flat.plane.origin, flat.plane.n, ma.p, mb.p);
      for (const std::uint32_t k : flat.points)
        contacts[begin + k].patch = static_cast<std::int32_t>(contacts.size());
      contacts.push_back(c), whose.push_back(part), flats.push_back(std::move(flat));
    }
  };
  flatten(b, nullptr, friction);
  for (PatchSide& part : beside) flatten(part.side, &part, part.friction);
  std::vector<Mobile> mobiles{ma, mb};
  if (!solveContacts(mobiles, contacts)) return {};
  struct Sum {
    Vec3 impulse = Vec3::Zero(), arm = Vec3::Zero();
    double pushed = 0;
  };
  double work = 0, pushed = 0;
  const std::vector<Mobile> before{ma, mb};
  const auto sumOf = [&](const PatchSide* part) {
    Sum sum;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (whose[i] != part) continue;
      const SolverContact& c = contacts[i];
      work += 0.5 * c.impulse.dot(c.velocity(before) + c.velocity(mobiles));
      if (c.area) {
        sum.impulse += c.push.rightCols<2>() * c.impulse.tail<2>();
        continue;
      }
      sum.impulse += c.push * c.impulse;
      sum.arm += c.impulse[0] * c.pushA, sum.pushed += c.impulse[0];
    }
    pushed += sum.pushed;
    return sum;
  };
  const Sum own = sumOf(nullptr);
  for (PatchSide& part : beside) {
    const Sum sum = sumOf(&part);
    part.impulse = sum.impulse;
    part.middle = sum.pushed > 0 ? Vec3(ma.p + sum.arm / sum.pushed) : first.point;
  }
  if (work > 0 || !(pushed > 0)) return {};
  const PatchImpact result{own.impulse, own.pushed > 0 ? Vec3(ma.p + own.arm / own.pushed) : first.point};
  ma = mobiles[0], mb = mobiles[1];
  return result;
}

}  // namespace stadion
