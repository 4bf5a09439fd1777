#include "dynamics/world/island_step.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr std::uint32_t kAreaKey = 0x7fffff00;  ///< of the first flat contact of a pair

}  // namespace

void FlatPatch::place(const SolverBody& a, const SolverBody& b, const Mat3& turnA, const Mat3& turnB,
                      const Vec3& pA, const Vec3& pB, Mat3& basis, Vec3& armA, Vec3& armB) const {
  const bool withA = flat.carrier == Carrier::A;
  const Mat3 &own = withA ? turnA : turnB, &other = withA ? turnB : turnA;
  basis.col(0) = other * flat.plane.n;
  const Vec3 along = own * flat.plane.t1;
  basis.col(1) = (along - basis.col(0) * basis.col(0).dot(along)).normalized();
  basis.col(2) = basis.col(0).cross(basis.col(1));
  // Where the sides tilt, what still touches is what is farthest on; friction is in the plane there.
  const Vec3 start = withA ? a.p : b.p, towards = withA ? Vec3(-basis.col(0)) : Vec3(basis.col(0));
  Vec3 arm = own * (flat.plane.origin - start);
  double farthest = -1e300;
  for (const Vec3& x : places) farthest = std::max(farthest, towards.dot(own * (x - start)));
  arm += (farthest - towards.dot(arm)) * towards;
  (withA ? armA : armB) = arm;
  if (withA) {
    armB = pA + armA - pB;
  } else {
    armA = pB + armB - pA;
  }
}

/// The other side of a body's contact, and the flush pieces that feel like it.
std::vector<Side> IslandStep::surfaceUnder(const FoundContact& f) const {
  std::vector<Side> sides;
  const std::optional<Side> own = objects_.side(f.b);
  if (!own) return sides;
  sides.push_back(*own);
  if (f.b.isBody) return sides;
  for (const ContactFinder::Beside& o : finder_.besideOf(f.a.id)) {
    if (std::ranges::find(sides, o.piece, &Side::key) != sides.end()) continue;
    const Collider* c = objects_.collider(o.piece.id);
    if (c && combine(objects_.body(f.a.id)->surface, c->surface).friction == f.surface.friction)
      sides.push_back(Side::of(*c));
  }
  return sides;
}

/// Which points carry flat contacts, and with which friction those begin.
void IslandStep::findFlats(ContactIsland& s, double tau) const {
  std::vector<Gap> gaps;
  for (std::size_t first = 0, end = 0; first < s.found.size(); first = end) {
    const FoundContact& f = s.found[first];
    gaps.clear();
    for (end = first; end < s.found.size() && s.found[end].a == f.a && s.found[end].b == f.b; ++end)
      gaps.push_back(s.found[end].gap);
    if (gaps.size() < 3 || f.surface.friction <= 0) continue;
    const std::optional<Side> a = objects_.side(f.a);
    const std::vector<Side> under = surfaceUnder(f);
    if (!a || under.empty()) continue;
    for (FlatContact& flat : flatContacts(*a, under, tau, gaps)) {
      FlatPatch found;
      SolverContact& c = found.contact;
      c.a = f.contact.a;
      c.b = f.contact.b;
      c.friction = f.surface.friction;
      c.area = flat.area.get();
      const auto index = static_cast<std::int32_t>(s.found.size() + s.flats.size());
      found.key = pairKey(f.a, f.b, kAreaKey + static_cast<std::uint32_t>(flat.points.front()));
      for (const std::uint32_t k : flat.points) {
        found.points.push_back(first + k);
        s.found[first + k].contact.patch = index;
        found.places.push_back(gaps[k].point);
        if (flat.carrier == Carrier::A) found.places.back() += gaps[k].distance * gaps[k].normal;
      }
      found.flat = std::move(flat);
      s.flats.push_back(std::move(found));
    }
  }
}

}  // namespace stadion
