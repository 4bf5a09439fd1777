#include "dynamics/world/contact_islands.h"

#include "dynamics/contact/contact_order.h"

#include <algorithm>
#include <utility>

namespace stadion {
namespace {

constexpr std::uint32_t kInNoSet = 0xffffffff;
constexpr std::size_t kMostInLine = 64;  ///< towers of more bodies are a pile, too

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
    a = of(a);
    b = of(b);
    parent[std::max(a, b)] = std::min(a, b);
  }
};

/// Returns true if bodies are solved for together with little work: towers, and what stands side by side on
/// one thing.
bool isSlender(const std::vector<RigidBody*>& island, const std::vector<FoundContact>& found) {
  constexpr double kSlender = 4e5;  // multiplications
  if (island.size() > kMostInLine || std::ranges::any_of(island, &RigidBody::isBall)) return false;
  std::vector<LeaningPair> pairs;
  const auto placeOf = [&](ContactSide p) {
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

}  // namespace

/// Sleeping bodies that something moving touches wake. True if there were any; they take part then.
bool ContactIslands::wakeTouched(const std::vector<FoundContact>& found, double tau) {
  for (const FoundContact& f : found) {
    if (!f.b.isBody) continue;
    RigidBody& o = *objects_.body(f.b.id);
    const RigidBody& mover = *objects_.body(f.a.id);
    if (o.mode != BodyMode::Rest || f.gap.distance > kTouching) continue;
    if (mover.contact.quietTime != 0 && !(mover.at(tau).velocityAt(f.gap.point).norm() > 5e-3)) continue;
    if (o.support.on.id) {
      waking_.enterContact(o, tau);
      waking_.wakeOnto({true, o.id}, tau);
    } else {
      waking_.wake(o, tau);
    }
    if (o.mode == BodyMode::Contact) return true;
  }
  return false;
}

void ContactIslands::findAll(double tau, std::vector<RigidBody*>& set, std::vector<FoundContact>& found) {
  for (int pass = 0; pass < 50; ++pass) {
    set.clear();
    found.clear();
    finder_.clear();
    for (RigidBody* b : active_) {
      b->contact.slot = kInNoSet;
      if (b->mode == BodyMode::Contact && b->enabled && !b->contact.inPile &&
          b->contact.dueAge <= b->age(tau) + kSameTime) {
        b->contact.slot = 0;
        set.push_back(b);
      }
    }
    std::ranges::sort(set, {}, &RigidBody::id);
    for (std::size_t i = 0; i < set.size(); ++i) finder_.find(*set[i], tau, found, set);
    if (!wakeTouched(found, tau)) break;
  }
  counters_.contacts += found.size();
  std::ranges::sort(set, {}, &RigidBody::id);
  finder_.sort();
  std::ranges::stable_sort(found, {}, [](const FoundContact& f) { return std::pair(f.a, f.b); });
  for (std::size_t i = 0; i < set.size(); ++i) set[i]->contact.slot = static_cast<std::uint32_t>(i);
}

std::vector<ContactIsland> ContactIslands::group(const std::vector<RigidBody*>& set,
                                                 std::vector<FoundContact>& found) const {
  Groups groups(set.size());
  const auto comesAlong = [&](ContactSide p) {
    const RigidBody* b = p.isBody ? objects_.body(p.id) : nullptr;
    return b && b->mode == BodyMode::Contact && !b->contact.inPile;
  };
  for (const FoundContact& f : found)
    if (comesAlong(f.b))
      groups.join(objects_.body(f.a.id)->contact.slot, objects_.body(f.b.id)->contact.slot);
  std::vector<ContactIsland> islands;
  std::vector<std::uint32_t> islandOf(set.size());
  for (std::size_t i = 0; i < set.size(); ++i) {
    const std::size_t root = groups.of(i);
    if (root == i) {
      islandOf[i] = static_cast<std::uint32_t>(islands.size());
      islands.emplace_back();
    }
    islandOf[i] = islandOf[root];
    islands[islandOf[i]].set.push_back(set[i]);
  }
  for (FoundContact& f : found)
    islands[islandOf[objects_.body(f.a.id)->contact.slot]].found.push_back(std::move(f));
  return islands;
}

void ContactIslands::tick(double tau) {
  ++counters_.contactSteps;
  queue_.beginTick();
  const double h = grid_.untilIslandStep(time_.instantAt(tau));
  piles_.advance(tau);
  std::vector<RigidBody*> set;
  std::vector<FoundContact> found;
  findAll(tau, set, found);
  std::vector<ContactIsland> islands = group(set, found);
  bool piled = false;
  for (ContactIsland& island : islands) {
    if (piles_.isPile(island.set, tau) && !isSlender(island.set, island.found)) {
      for (RigidBody* b : island.set) {
        b->contact.inPile = true;
        b->contact.dueAge = 0;
        b->contact.drift.setZero();
        b->contact.twist.setZero();
      }
      piled = true;
    } else {
      step_.advance(island, tau, h);
    }
  }
  for (RigidBody* b : set)
    if (!b->contact.inPile) foresight_.predict(*b, tau);
  if (piled) piles_.advance(tau);
  waking_.scheduleDue(tau);
}

}  // namespace stadion
