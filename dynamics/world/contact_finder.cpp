#include "dynamics/world/contact_finder.h"

#include "dynamics/collision/mesh_manifold.h"
#include "dynamics/collision/touch_seams.h"
#include "dynamics/contact/penetration_recovery.h"
#include "dynamics/world/penetration_recoveries.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kUsualPull = 9.81;  ///< that others in contact feel at least [m/s2]
constexpr double kOneHeight = 1e-7;  ///< points that differ less in height lie in one plane [m]
constexpr double kBeside = 1e-5;  ///< the point of an edge that is nearest to a body is known this well [m]
constexpr double kSunkIn = 1e-3;  ///< what has sunk into a piece by more is not on the sheet before it [m]
constexpr double kOneDirection = 1 - 1e-12;     ///< cosine between normals that are one
constexpr std::uint32_t kNowhere = 0xffffffff;  ///< slot of a body that is in no set yet

/// Turns the places so that they spread along x, where rounding does not order them.
void spreadAlongX(std::vector<Vec2>& p) {
  const Vec2 from = p.front();
  Vec2 far = Vec2::Zero();
  for (const Vec2& x : p)
    if ((x - from).squaredNorm() > far.squaredNorm()) far = x - from;
  if (!(far.squaredNorm() > 0)) return;
  const Vec2 along = far.normalized(), across(-along.y(), along.x());
  for (Vec2& x : p) x = {along.dot(x - from), across.dot(x - from)};
}

/// Which of these points in a plane stand out of their convex hull by more than `onLine` [m]; of points at one
/// place one.
std::vector<char> hullCorners(std::vector<Vec2> p, double onLine) {
  spreadAlongX(p);
  std::vector<std::size_t> order(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) order[i] = i;
  std::ranges::sort(order, [&](std::size_t i, std::size_t k) {
    return p[i].x() != p[k].x() ? p[i].x() < p[k].x() : p[i].y() != p[k].y() ? p[i].y() < p[k].y() : i < k;
  });
  const auto turns = [&](std::size_t a, std::size_t b,
                         std::size_t c) {  // b is farther than rounding left of a to c
    const Vec2 along = p[c] - p[a], to = p[b] - p[a];
    const double cross = along.x() * to.y() - along.y() * to.x();
    return -cross > onLine * along.norm();
  };
  std::vector<std::size_t> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t begin = hull.size();
    for (const std::size_t i : order) {
      if (hull.size() > begin && (p[hull.back()] - p[i]).norm() < onLine) continue;
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

/// Returns true if both lie on one plane, and the pieces there feel alike.
bool areOnOnePlane(const FoundContact& f, const FoundContact& o) {
  return f.gap.normal.dot(o.gap.normal) > kOneDirection &&
         std::fabs(f.gap.normal.dot(f.gap.point - o.gap.point)) < kOneHeight &&
         f.surface.friction == o.surface.friction && f.surface.restitution == o.surface.restitution &&
         f.surface.rolling == o.surface.rolling;
}

/// Returns true if the body has the same form at both.
bool haveOneForm(const FoundContact& f, const FoundContact& o) {
  return f.carrier == o.carrier && f.rounding.radius == o.rounding.radius;
}

/// Fills `places` with where the contacts of the group are in their plane, relative to the first.
void placesOf(const std::vector<std::size_t>& group, const std::vector<FoundContact>& found,
              std::vector<Vec2>& places) {
  const Gap& first = found[group.front()].gap;
  const Mat3 basis = basisAround(first.normal);
  places.clear();
  for (const std::size_t k : group)
    places.push_back((basis.transpose() * (found[k].gap.point - first.point)).tail<2>());
}

/// Returns true if the body's points of the group, at these places, lie in one plane too, which may tilt.
bool isEvenOver(const std::vector<std::size_t>& group, const std::vector<FoundContact>& found,
                const std::vector<Vec2>& places) {
  const auto many = static_cast<double>(group.size());
  Vec2 middle = Vec2::Zero();
  double height = 0;
  for (std::size_t g = 0; g < group.size(); ++g) {
    middle += places[g] / many;
    height += found[group[g]].gap.distance / many;
  }
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  Vec2 tilt = Vec2::Zero();
  for (std::size_t g = 0; g < group.size(); ++g) {
    const Vec2 x = places[g] - middle;
    spread += x * x.transpose();
    tilt += (found[group[g]].gap.distance - height) * x;
  }
  spread += 1e-12 * spread.trace() * Eigen::Matrix2d::Identity();  // they may lie on a line
  tilt = spread.inverse() * tilt;
  for (std::size_t g = 0; g < group.size(); ++g)
    if (!(std::fabs(found[group[g]].gap.distance - height - tilt.dot(places[g] - middle)) < kOneHeight))
      return false;
  return true;
}

/// Returns true if the piece begins at the border beside the corner, and rises on the side away from the sheet.
bool risesFrom(const Collider& piece, double tau, const CornerBeyond& c) {
  const Gap& gap = c.point.gap;
  const auto m = normalOfSlope(*piece.shape, piece.motion.at(tau).pose, c.border, gap.normal, c.inwards);
  return m && m->dot(gap.point + gap.distance * gap.normal - c.border) > -kSunkIn;
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

}  // namespace

std::uint64_t pairKey(ContactSide a, ContactSide b, std::uint32_t feature) {
  std::uint64_t h = 1469598103934665603ULL;
  for (const std::uint64_t x : {std::uint64_t{a.isBody}, std::uint64_t{a.id}, std::uint64_t{b.isBody},
                                std::uint64_t{b.id}, std::uint64_t{feature}})
    h = (h ^ x) * 1099511628211ULL;
  return h;
}

void ContactFinder::sort() {
  std::ranges::sort(beside_);
}

std::span<const ContactFinder::Beside> ContactFinder::besideOf(BodyId id) const {
  return {std::ranges::lower_bound(beside_, id, {}, &Beside::body),
          std::ranges::upper_bound(beside_, id, {}, &Beside::body)};
}

void ContactFinder::addPoint(const RigidBody& b, const Side& other, const ManifoldPoint& p,
                             std::vector<FoundContact>& found) const {
  FoundContact f;
  f.a = Side::of(b).key;
  f.b = other.key;
  f.surface = combine(b.surface, objects_.surfaceOf(other.key));
  f.gap = p.gap;
  f.carrier = p.carrier;
  f.rounding = p.rounding;
  f.key = pairKey(f.a, f.b, p.key);
  f.contact.friction = f.surface.friction;
  found.push_back(f);
}

/// A ball that has been put deep into a mesh leaves by one way: the shortest that nothing else that it
/// touches bars. `first`: where its points begin.
void ContactFinder::chooseRecovery(const RigidBody& b, std::size_t first,
                                   std::vector<FoundContact>& found) const {
  if (!b.isBall()) return;
  const auto inside = [&](const FoundContact& f) {
    return f.gap.distance <= -kDeepBall * b.radius() && !f.b.isBody &&
           std::holds_alternative<MeshShape>(*objects_.side(f.b)->shape);
  };
  for (std::size_t i = first; i < found.size(); ++i) {
    if (!inside(found[i])) continue;
    const ContactSide on = found[i].b;
    const auto barred = [&](const FoundContact& way) {
      return std::any_of(
          found.begin() + static_cast<std::ptrdiff_t>(first), found.end(), [&](const FoundContact& f) {
            return f.b != on && f.gap.distance < kTouching && f.gap.normal.dot(way.gap.normal) < -0.1;
          });
    };
    std::size_t best = i;
    for (std::size_t k = i; k < found.size() && found[k].b == on; ++k)
      if (!barred(found[k])) {
        best = k;
        break;
      }
    const FoundContact way = found[best];
    std::erase_if(found, [&](const FoundContact& f) { return f.a == way.a && f.b == on; });
    found.push_back(way);
    return;
  }
}

void ContactFinder::find(RigidBody& b, double tau, std::vector<FoundContact>& found,
                         std::vector<RigidBody*>& set) {
  const Side self = Side::of(b);
  const Kinematics k = b.at(tau);
  const double h = grid_.islandStep();
  const double pull = std::max(kUsualPull, fields_.accelerationAt(b, k.p, k.v, tau).norm());
  const double margin = kTouching + 1.5 * h * (k.v.norm() + k.omega.norm() * b.reach + pull * h);
  Aabb box;
  box.include(k.pose * b.bound.centre);
  box.lo.array() -= b.bound.radius + margin;
  box.hi.array() += b.bound.radius + margin;
  const std::size_t first = found.size();
  std::vector<ManifoldPoint> points;
  const auto against = [&](const Side& other, const Side& form) {
    manifold(self, form, tau, margin, points);
    for (const ManifoldPoint& p : points) addPoint(b, other, p, found);
  };
  forgetRecoveries(b, objects_, tau);
  for (const PenetrationRecovery& w : b.grip.recoveries) {
    const Shape plane = *barrier(self, Side::of(*objects_.collider(w.of)), tau, w);
    Collider form;
    form.shape = &plane;
    against(Side::of(*objects_.collider(w.of)), Side::of(form));
  }
  boxes_.eachCollider(box, [&](const Collider& c) {
    const Side other = Side::of(c);
    if (objects_.mayTouch(self, other) && !comesOutOf(b, c.id)) against(other, other);
  });
  foresight_.eachBodyNear(box, tau, [&](RigidBody& o) {
    if (&o == &b || !o.enabled) return;
    const Side other = Side::of(o);
    if (!objects_.mayTouch(self, other)) return;
    const double reach = b.bound.radius + o.bound.radius + margin;
    if ((o.at(tau).pose * o.bound.centre - k.pose * b.bound.centre).squaredNorm() > reach * reach) return;
    if (o.mode == BodyMode::Contact && !o.contact.inPile) {
      if (o.contact.slot == kNowhere) {  // it is not due, but it comes along
        o.contact.slot = 0;
        set.push_back(&o);
      }
      if (o.id < b.id) return;  // the pair is found from there
    } else if (!o.contact.inPile && !standsStill(o.mode) && o.mode != BodyMode::Held) {
      return;  // a flier: its touch is an event
    }
    against(other, other);
  });
  chooseRecovery(b, first, found);
  addBeyondBorders(b, tau, margin, first, found);
  dropHidden(b, tau, first, found);
  joinFlush(b, first, found);
}

/// Where a sheet ends and another piece rises, corners that have sunk into that piece a little are beyond the border
/// of the sheet. They stay contacts of the sheet, as on one mesh. Otherwise they would sink into both by turns.
void ContactFinder::addBeyondBorders(const RigidBody& b, double tau, double margin, std::size_t first,
                                     std::vector<FoundContact>& found) const {
  const auto* mesh = std::get_if<MeshShape>(b.shape);
  if (!mesh) return;
  std::vector<ContactSide> pieces;
  for (std::size_t i = first; i < found.size(); ++i)
    if (!found[i].b.isBody && std::ranges::find(pieces, found[i].b) == pieces.end())
      pieces.push_back(found[i].b);
  if (pieces.size() < 2) return;
  std::ranges::sort(pieces);
  const Kinematics k = b.at(tau);
  std::vector<CornerBeyond> corners;
  for (const ContactSide piece : pieces) {
    const Collider& c = *objects_.collider(piece.id);
    TriangleTree sheet;
    const TriangleTree* faces = trianglesOf(*c.shape, sheet);
    if (!faces || faces->closed()) continue;
    corners.clear();
    cornersBeyondBorder(mesh->tree, k.pose, k.p, *faces, c.motion.at(tau).pose, margin, corners);
    for (const CornerBeyond& corner : corners)
      if (std::ranges::any_of(pieces, [&](ContactSide other) {
            return other != piece && risesFrom(*objects_.collider(other.id), tau, corner);
          }))
        addPoint(b, Side::of(c), corner.point, found);
  }
}

/// Takes what is hidden out of a body's contacts, which begin at `first`.
void ContactFinder::dropHidden(const RigidBody& b, double tau, std::size_t first,
                               std::vector<FoundContact>& found) {
  bool several = false;
  for (std::size_t i = first; i < found.size() && !several; ++i)
    several = found[i].b != found[first].b || found[i].gap.normal != found[first].gap.normal;
  if (!several) return;
  // In an order that does not depend on the broad phase's.
  std::ranges::stable_sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(), {},
                           &FoundContact::b);
  std::vector<Bearing> points;
  std::vector<std::size_t> whose;
  for (std::size_t i = first; i < found.size(); ++i) {
    const FoundContact& f = found[i];
    if (f.b.isBody) continue;
    const Collider& c = *objects_.collider(f.b.id);
    points.push_back({f.b, c.shape, c.motion.at(tau).pose, f.gap});
    whose.push_back(i);
  }
  const std::vector<char> hidden = hiddenAmong(points);
  std::vector<char> gone(found.size(), 0);
  for (std::size_t k = 0; k < hidden.size(); ++k)
    if (!hidden[k]) {
      found[whose[k]].gap = points[k].gap;
    } else {
      beside_.push_back({b.id, found[whose[k]].b, false});
      gone[whose[k]] = 1;
    }
  eraseMarked(found, first, gone);
}

/// Points on one plane of flush pieces that feel alike count as those of one of them, and what lies between
/// others of them is left out: they carry the body as one face would.
void ContactFinder::joinFlush(const RigidBody& b, std::size_t first, std::vector<FoundContact>& found) {
  std::vector<char> gone(found.size(), 0), grouped(found.size(), 0);
  std::vector<std::size_t> group;
  std::vector<Vec2> places;
  bool any = false;
  for (std::size_t i = first; i < found.size(); ++i) {
    if (grouped[i] || gone[i] || !isOnStillCollider(found[i])) continue;
    if (!groupOf(i, found, grouped, group)) continue;
    placesOf(group, found, places);
    if (!isEvenOver(group, found, places)) {
      std::erase_if(group, [&](std::size_t k) {
        return std::fabs(found[k].gap.distance - found[i].gap.distance) >= kOneHeight;
      });
      placesOf(group, found, places);
    }
    for (const std::size_t k : group) grouped[k] = 1;
    any = dropBetween(b, first, group, found, gone) || any;
    any = keepCorners(b, group, hullCorners(places, kOneHeight), found, gone) || any;
  }
  if (any) eraseMarked(found, first, gone);
}

bool ContactFinder::isOnStillCollider(const FoundContact& f) const {
  return !f.b.isBody && !objects_.collider(f.b.id)->motion.moving;
}

/// Fills `group` with contact i and the later ones that are like it. False if all are of one piece.
bool ContactFinder::groupOf(std::size_t i, const std::vector<FoundContact>& found,
                            const std::vector<char>& grouped, std::vector<std::size_t>& group) const {
  group.assign(1, i);
  bool several = std::holds_alternative<MeshShape>(*objects_.collider(found[i].b.id)->shape);
  for (std::size_t k = i + 1; k < found.size(); ++k)
    if (!grouped[k] && isOnStillCollider(found[k]) && areOnOnePlane(found[i], found[k]) &&
        haveOneForm(found[i], found[k])) {
      group.push_back(k);
      several = several || found[k].b != found[i].b;
    }
  return several && group.size() > 1;
}

/// Marks points of edges that lie between those of the group as gone: they carry nothing more. False if there
/// is none.
bool ContactFinder::dropBetween(const RigidBody& b, std::size_t first, const std::vector<std::size_t>& group,
                                const std::vector<FoundContact>& found, std::vector<char>& gone) {
  bool any = false;
  std::vector<std::size_t> more = group;
  std::vector<Vec2> places;
  const FoundContact& one = found[group.front()];
  for (std::size_t k = first; k < found.size(); ++k) {
    const FoundContact& f = found[k];
    if (gone[k] || f.gap.face || f.carrier != Carrier::None || haveOneForm(one, f) || !isOnStillCollider(f) ||
        !areOnOnePlane(one, f))
      continue;
    more.resize(group.size());
    more.push_back(k);
    placesOf(more, found, places);
    const auto isThere = [&](const Vec2& x) { return (x - places.back()).norm() < kBeside; };
    if (!isEvenOver(more, found, places) ||
        (hullCorners(places, kBeside).back() && std::none_of(places.begin(), places.end() - 1, isThere)))
      continue;
    beside_.push_back({b.id, f.b, f.gap.distance < kTouching});
    gone[k] = 1;
    any = true;
  }
  return any;
}

/// Renames the contacts at corners to one collider, and marks the others as gone. False if there is none.
bool ContactFinder::keepCorners(const RigidBody& b, const std::vector<std::size_t>& group,
                                const std::vector<char>& corner, std::vector<FoundContact>& found,
                                std::vector<char>& gone) {
  ContactSide name;
  std::size_t kept = 0;
  for (std::size_t g = 0; g < group.size(); ++g)
    if (corner[g]) name = kept++ == 0 ? found[group[g]].b : std::min(name, found[group[g]].b);
  for (std::size_t g = 0; g < group.size(); ++g) {
    FoundContact& f = found[group[g]];
    if (f.b != name) beside_.push_back({b.id, f.b, f.gap.distance < kTouching});
    if (corner[g])
      f.b = name;
    else
      gone[group[g]] = 1;
  }
  return kept < group.size();
}

}  // namespace stadion
