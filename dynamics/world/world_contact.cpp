#include "dynamics/contact/contact_order.h"
#include "dynamics/world/world_core.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kUsualPull = 9.81;  ///< that others in contact feel at least [m/s2]

/// Groups bodies that touch, by the smallest index (union-find).
struct Groups {
  std::vector<std::size_t> parent;
  explicit Groups(std::size_t n) : parent(n) {
    for (std::size_t i = 0; i < n; ++i) parent[i] = i;
  }
  std::size_t of(std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = of(a), b = of(b);
    parent[std::max(a, b)] = std::min(a, b);
  }
};

constexpr std::uint32_t kNowhere = 0xffffffff;

}  // namespace

void World::Core::enterContact(RigidBody& b, double tau) {
  if (b.mode == BodyMode::Contact || !b.movable()) return;
  const Vec3 L = b.spin.angularMomentum(b.spinAge(tau));
  // Among a crowd it moves with the crowd: between its steps nobody else gives way.
  const bool rests = b.mode == BodyMode::Rest;
  const bool crowded = rests && (b.heaped || std::ranges::any_of(b.touching, [&](Party p) {
                                   return p.isBody && objects_.body(p.id) && objects_.body(p.id)->crowd;
                                 }));
  b.support.on = {};
  setArc(b, tau, Path::parabola(b.position(tau), b.velocity(tau), Vec3::Zero()),
         Spin::free(b.orientation(tau), L, b.inertia), grid_.islandStep(), BodyMode::Contact);
  b.endL = L;
  b.quiet = 0;
  if (!rests) b.presses.clear();
  if (crowded && b.mode == BodyMode::Contact) b.crowd = true, b.dueAge = untilCrowdStep(tau);
  queue_.scheduleTick(tau);
}

/// What acts on the body changes: its step ends here and a new one begins, from what it does now.
void World::Core::cutStep(RigidBody& b, double tau) {
  if (b.mode != BodyMode::Contact) return;
  const Vec3 L = b.momentum(tau);
  setArc(b, tau, Path::parabola(b.position(tau), b.velocity(tau), Vec3::Zero()),
         Spin::free(b.orientation(tau), L, b.inertia), grid_.islandStep(), BodyMode::Contact);
  b.endL = L;
  b.quiet = 0;
  queue_.scheduleTick(tau);
}

/// What was foreseen for longer than a step is looked at anew.
void World::Core::hurry(RigidBody& b, double tau) {
  if (b.mode != BodyMode::Contact || b.crowd || b.dueAge <= grid_.islandStep() ||
      b.age(tau) + grid_.islandStep() >= b.dueAge)
    return;
  b.dueAge = 0;
  queue_.scheduleTick(tau);
}

/// Sleepers that lean on a waking one wake with it.
void World::Core::wake(RigidBody& b, double tau) {
  if (b.mode != BodyMode::Rest) return;
  if (b.support.on.id) {
    restart(b, tau);
    if (b.mode == BodyMode::Rest) return;
  } else {
    enterContact(b, tau);
  }
  wakeOnto({true, b.id}, tau);
}

/// Who leans on what moved falls, or leans anew; those who lean on them, in turn.
void World::Core::wakeOnto(Party moved, double tau) {
  if (!supports_.bears(moved)) return;
  std::vector<Party> waking{moved};
  std::vector<BodyId> onIt;
  for (std::size_t i = 0; i < waking.size(); ++i) {
    const Party gone = waking[i];
    onIt.clear();
    supports_.leanersOf(gone, onIt);
    for (const BodyId id : onIt) {
      RigidBody* other = objects_.body(id);
      if (!other || !leansOn(*other, gone)) {
        supports_.drop(gone, id);
        continue;
      }
      const bool onFace =
          other->mode == BodyMode::Rest || other->mode == BodyMode::Slide || other->mode == BodyMode::Roll;
      if (onFace && other->support.on.id && other->support.on == gone) {
        waking.push_back({true, id});
        startFlight(*other, tau, other->position(tau), other->velocity(tau), other->orientation(tau),
                    other->spin.angularMomentum(other->spinAge(tau)));
        predict(*other, tau);
      } else if (other->mode == BodyMode::Stuck) {
        waking.push_back({true, id});
        startFlight(*other, tau, other->position(tau), Vec3::Zero(), other->orientation(tau), Vec3::Zero());
        predict(*other, tau);
      } else if (other->mode == BodyMode::Contact) {
        hurry(*other, tau);
      } else if (other->mode == BodyMode::Rest) {
        // In a heap those who lean on it wake when it moves; elsewhere nobody would wake them.
        if (!other->heaped) waking.push_back({true, id});
        enterContact(*other, tau);
      }
    }
  }
}

/// The next tick is when the first body in contact is due.
void World::Core::scheduleDue(double tau) {
  double first = 1e300;
  for (const RigidBody* b : active_)
    if (b->mode == BodyMode::Contact && b->enabled) first = std::min(first, b->dueAge - b->age0);
  if (first < 1e299) queue_.scheduleTick(std::max(first, tau));
}

/// A ball that has been put deep into a mesh leaves by one way: the shortest that nothing else that it
/// touches bars. `first`: where its points begin.
void World::Core::chooseWayOut(const RigidBody& b, std::size_t first, std::vector<Found>& found) const {
  if (!b.isBall()) return;
  const auto inside = [&](const Found& f) {
    return f.gap.distance <= -kDeepBall * b.radius() && !f.b.isBody &&
           std::holds_alternative<MeshShape>(*objects_.side(f.b)->shape);
  };
  for (std::size_t i = first; i < found.size(); ++i) {
    if (!inside(found[i])) continue;
    const Party on = found[i].b;
    const auto barred = [&](const Found& way) {
      return std::any_of(
          found.begin() + static_cast<std::ptrdiff_t>(first), found.end(), [&](const Found& f) {
            return f.b != on && f.gap.distance < kTouching && f.gap.normal.dot(way.gap.normal) < -0.1;
          });
    };
    std::size_t best = i;
    for (std::size_t k = i; k < found.size() && found[k].b == on; ++k)
      if (!barred(found[k])) {
        best = k;
        break;
      }
    const Found way = found[best];
    std::erase_if(found, [&](const Found& f) { return f.a == way.a && f.b == on; });
    found.push_back(way);
    return;
  }
}

void World::Core::findContacts(RigidBody& b, double tau, std::vector<Found>& found,
                               std::vector<RigidBody*>& set) {
  const Side self = Side::of(b);
  const Kinematics k = b.at(tau);
  const double h = grid_.islandStep();
  const double pull = std::max(kUsualPull, fields_.accelerationAt(b, k.p, k.v, tau).norm());
  const double margin = kTouching + 1.5 * h * (k.v.norm() + k.omega.norm() * b.reach + pull * h);
  Aabb box;
  box.include(k.pose * b.bound.centre);
  box.lo.array() -= b.bound.radius + margin, box.hi.array() += b.bound.radius + margin;
  const std::size_t first = found.size();
  std::vector<ManifoldPoint> points;
  const auto against = [&](const Side& other, const Side& form) {
    manifold(self, form, tau, margin, points);
    for (const ManifoldPoint& p : points) {
      Found f;
      f.a = self.party, f.b = other.party;
      f.surface = combine(b.surface, objects_.surfaceOf(other.party));
      f.gap = p.gap, f.carrier = p.carrier, f.rounding = p.rounding;
      f.key = pairKey(f.a, f.b, p.key);
      f.contact.friction = f.surface.friction;
      found.push_back(f);
    }
  };
  forgetWaysOut(b, tau);
  for (const WayOut& w : b.waysOut) {
    const Shape plane = *barrier(self, Side::of(*objects_.collider(w.of)), tau, w);
    Collider form;
    form.shape = &plane;
    against(Side::of(*objects_.collider(w.of)), Side::of(form));
  }
  boxes_.eachCollider(box, [&](const Collider& c) {
    const Side other = Side::of(c);
    if (objects_.mayTouch(self, other) && !comesOutOf(b, c.id)) against(other, other);
  });
  eachBodyNear(box, tau, [&](RigidBody& o) {
    if (&o == &b || !o.enabled) return;
    const Side other = Side::of(o);
    if (!objects_.mayTouch(self, other)) return;
    const double reach = b.bound.radius + o.bound.radius + margin;
    if ((o.at(tau).pose * o.bound.centre - k.pose * b.bound.centre).squaredNorm() > reach * reach) return;
    if (o.mode == BodyMode::Contact && !o.crowd) {
      if (o.slot == kNowhere) o.slot = 0, set.push_back(&o);  // it is not due, but it comes along
      if (o.id < b.id) return;                                // the pair is found from there
    } else if (!o.crowd && !standsStill(o.mode) && o.mode != BodyMode::Held) {
      return;  // a flier: its touch is an event
    }
    against(other, other);
  });
  chooseWayOut(b, first, found);
  dropHidden(b, tau, first, found);
  joinFlush(b, first, found);
}

/// Sleepers touched by something that moves wake; true if there were any, who then take part.
bool World::Core::wakeTouched(const std::vector<Found>& found, double tau) {
  for (const Found& f : found) {
    if (!f.b.isBody) continue;
    RigidBody& o = *objects_.body(f.b.id);
    const RigidBody& mover = *objects_.body(f.a.id);
    if (o.mode != BodyMode::Rest || f.gap.distance > kTouching) continue;
    if (mover.quiet != 0 && !(mover.at(tau).velocityAt(f.gap.point).norm() > 5e-3)) continue;
    if (o.support.on.id) {
      enterContact(o, tau);
      wakeOnto({true, o.id}, tau);
    } else {
      wake(o, tau);
    }
    if (o.mode == BodyMode::Contact) return true;
  }
  return false;
}

/// The memory of pairs learns whom the body touches, and no longer.
void World::Core::remember(RigidBody& b, const std::vector<Party>& near) {
  const auto in = [](const std::vector<Party>& list, Party p) {
    return std::find(list.begin(), list.end(), p) != list.end();
  };
  for (const Party p : near)
    if (!in(b.leaning, p)) memory_.setTouching(ContactMemory::keyOf(p, {true, b.id}), true);
  for (const Party p : b.leaning)
    if (!in(near, p)) memory_.setTouching(ContactMemory::keyOf(p, {true, b.id}), false);
  b.leaning = near;
}

/// How many balls move around this one within its own size: they will lean on each other before long.
std::size_t World::Core::thickness(const RigidBody& b, double tau) {
  if (!b.isBall()) return 0;
  std::size_t many = 0;
  const Vec3 middle = b.position(tau);
  const double reach = 2 * b.bound.radius;
  Aabb box;
  box.include(middle);
  box.lo.array() -= reach, box.hi.array() += reach;
  eachBodyNear(box, tau, [&](const RigidBody& o) {
    if (&o == &b || !o.enabled || !o.isBall()) return;
    if (o.mode != BodyMode::Flight && o.mode != BodyMode::Contact) return;
    const double far = reach + o.bound.radius;
    if ((o.position(tau) - middle).squaredNorm() < far * far) ++many;
  });
  return many;
}

/// Whether bodies are solved for together with little work: towers, and what stands side by side on one
/// thing.
bool World::Core::isSlender(const std::vector<RigidBody*>& island, const std::vector<Found>& found) {
  constexpr double kSlender = 4e5;  // multiplications
  if (island.size() > kMostInLine || std::ranges::any_of(island, &RigidBody::isBall)) return false;
  std::vector<LeaningPair> pairs;
  const auto placeOf = [&](Party p) {
    const auto at = p.isBody ? std::ranges::lower_bound(island, p.id, {}, &RigidBody::id) : island.end();
    return static_cast<std::uint32_t>(at != island.end() && (*at)->id != p.id
                                          ? island.size()
                                          : static_cast<std::size_t>(at - island.begin()));
  };
  for (std::size_t i = 0; i < found.size(); ++i)
    if (i == 0 || found[i].a != found[i - 1].a || found[i].b != found[i - 1].b)
      pairs.push_back({placeOf(found[i].a), placeOf(found[i].b)});
  return workOfLine(island.size(), pairs) < kSlender;
}

/// Whether an island is better off as a crowd: it is large, not solved exactly, or its balls are in the thick
/// of it.
bool World::Core::isCrowd(const std::vector<RigidBody*>& island, double tau) {
  const bool balls = std::ranges::all_of(island, [](const RigidBody* b) { return b->isBall(); });
  // Thin meshes would sink through each other in a crowd's longer steps.
  const bool restless = std::ranges::any_of(island, &RigidBody::restless) &&
                        std::ranges::none_of(island, [](const RigidBody* b) {
                          return std::holds_alternative<MeshShape>(*b->shape);
                        });
  if (island.size() >= (balls ? kCrowdOfBalls : restless ? kRestless : kCrowd)) return true;
  return balls && std::ranges::any_of(
                      island, [&](const RigidBody* b) { return thickness(*b, tau) + 1 >= kCrowdOfBalls; });
}

void World::Core::tick(double tau) {
  ++counters.contactSteps;
  queue_.beginTick();
  const double h = grid_.untilIslandStep(time_.instantAt(tau));
  advanceCrowd(tau);
  std::vector<RigidBody*> set;
  std::vector<Found> found;
  for (int pass = 0; pass < 50; ++pass) {
    set.clear(), found.clear(), beside.clear();
    for (RigidBody* b : active_) {
      b->slot = kNowhere;
      if (b->mode == BodyMode::Contact && b->enabled && !b->crowd && b->dueAge <= b->age(tau) + kDue)
        b->slot = 0, set.push_back(b);
    }
    std::ranges::sort(set, {}, &RigidBody::id);
    for (std::size_t i = 0; i < set.size(); ++i) findContacts(*set[i], tau, found, set);
    if (!wakeTouched(found, tau)) break;
  }
  counters.contacts += found.size();
  std::ranges::sort(set, {}, &RigidBody::id);
  std::ranges::sort(beside);
  std::ranges::stable_sort(found, {}, [](const Found& f) { return std::pair(f.a, f.b); });
  for (std::size_t i = 0; i < set.size(); ++i) set[i]->slot = static_cast<std::uint32_t>(i);
  Groups groups(set.size());
  const auto comesAlong = [&](Party p) {
    return p.isBody && objects_.body(p.id)->mode == BodyMode::Contact && !objects_.body(p.id)->crowd;
  };
  for (const Found& f : found)
    if (comesAlong(f.b)) groups.join(objects_.body(f.a.id)->slot, objects_.body(f.b.id)->slot);
  std::vector<Island> islands;
  std::vector<std::uint32_t> islandOf(set.size());
  for (std::size_t i = 0; i < set.size(); ++i) {
    const std::size_t root = groups.of(i);
    if (root == i) islandOf[i] = static_cast<std::uint32_t>(islands.size()), islands.emplace_back();
    islandOf[i] = islandOf[root];
    islands[islandOf[i]].set.push_back(set[i]);
  }
  for (Found& f : found) islands[islandOf[objects_.body(f.a.id)->slot]].found.push_back(std::move(f));
  bool crowds = false;
  for (Island& island : islands) {
    if (isCrowd(island.set, tau) && !isSlender(island.set, island.found)) {
      for (RigidBody* b : island.set) {
        b->crowd = true, b->dueAge = 0;
        b->drift.setZero(), b->twist.setZero();
      }
      crowds = true;
    } else {
      advanceIsland(island, tau, h);
    }
  }
  for (RigidBody* b : set)
    if (!b->crowd) predict(*b, tau);
  if (crowds) advanceCrowd(tau);
  scheduleDue(tau);
}

}  // namespace stadion
