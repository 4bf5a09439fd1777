#include "engine/scene/placements.h"

#include "engine/core/state_fields.h"

#include <algorithm>
#include <cassert>

namespace stadion {

Placements::Placements() {
  Entry world;
  world.live = true;
  entries_.push_back(world);
  for (auto* matrices : {&X_PN_, &X_WN_, &X_WH_}) matrices->push_back(Affine::Identity());
}

PlacementId Placements::add(PlacementId parent, const Affine& X_PN) {
  PlacementId id;
  if (free_.empty()) {
    id = static_cast<PlacementId>(entries_.size());
    entries_.emplace_back();
    for (auto* matrices : {&X_PN_, &X_WN_, &X_WH_}) matrices->push_back(Affine::Identity());
  } else {
    id = free_.back();
    free_.pop_back();
    const bool listed = entries_[id].changed;
    entries_[id] = Entry{};
    entries_[id].changed = listed;
  }
  detach(parent);
  Entry& e = entries_[id];
  X_PN_[id] = X_PN;
  e.parent = parent;
  e.live = true;
  Entry& p = entries_[parent];
  e.nextSibling = p.firstChild;
  if (p.firstChild != kNoPlacement) entries_[p.firstChild].previousSibling = id;
  p.firstChild = id;
  markBelow(id, true);
  return id;
}

void Placements::remove(PlacementId id) {
  Entry& e = entries_[id];
  assert(e.live && e.firstChild == kNoPlacement);
  if (e.fleet != kNoFleet) fleets_[e.fleet].members[e.member] = kNoPlacement;
  if (e.detached)
    for (Fleet& fleet : fleets_)
      std::erase_if(fleet.detached, [id](const auto& s) { return s.second == id; });
  if (e.previousSibling != kNoPlacement)
    entries_[e.previousSibling].nextSibling = e.nextSibling;
  else
    entries_[e.parent].firstChild = e.nextSibling;
  if (e.nextSibling != kNoPlacement) entries_[e.nextSibling].previousSibling = e.previousSibling;
  e.live = false;
  free_.push_back(id);
}

void Placements::markBelow(PlacementId top, bool moved) {
  // Depth first without recursion: a script may nest as deep as it likes.
  PlacementId id = top;
  for (;;) {
    Entry& e = entries_[id];
    e.stale |= moved;
    if (moved && e.watched) movedWatched_.push_back(id);
    mark(id, e);
    if (e.firstChild != kNoPlacement) {
      id = e.firstChild;
      continue;
    }
    while (id != top && entries_[id].nextSibling == kNoPlacement) id = entries_[id].parent;
    if (id == top) return;
    id = entries_[id].nextSibling;
  }
}

bool Placements::setLocal(PlacementId id, const Affine& X_PN) {
  if (!X_PN.matrix().allFinite()) return false;
  detach(id);
  X_PN_[id] = X_PN;
  entries_[id].heldParts = HeldParts::Nothing;
  markBelow(id, true);
  return true;
}

bool Placements::setWorld(PlacementId id, const Affine& X_WN) {
  if (!X_WN.matrix().allFinite()) return false;
  const PlacementId up = entries_[id].parent;
  if (up == kWorldPlacement) return setLocal(id, X_WN);
  const Affine local = world(up).inverse() * X_WN;
  return setLocal(id, local);
}

bool Placements::holdInWorld(PlacementId id, const Affine& X_WN, HeldParts parts) {
  if (!X_WN.matrix().allFinite()) return false;
  detach(id);
  X_WH_[id] = X_WN;
  entries_[id].heldParts = parts;
  markBelow(id, true);
  return true;
}

void Placements::rejoin(PlacementId id, const Affine& X_WP) {
  const Affine X_PN = X_WP.inverse() * carriedBy(id, X_WP);
  setLocal(id, X_PN);
}

Affine Placements::local(PlacementId id) const {
  updateLocal(id);
  const Entry& e = entries_[id];
  if (e.heldParts == HeldParts::Nothing) return X_PN_[id];
  return e.parent == kWorldPlacement ? world(id) : Affine(world(e.parent).inverse() * world(id));
}

void Placements::setAttached(PlacementId id, bool attached) {
  if (attached) detach(id);
  entries_[id].attached = attached;
}

void Placements::watch(PlacementId id) {
  detach(id);
  entries_[id].watched = anyWatched_ = true;
  for (; id != kNoPlacement && !entries_[id].watchedBelow; id = entries_[id].parent)
    entries_[id].watchedBelow = true;
}

PlacementId Placements::carrier(PlacementId id) const {
  return entries_[id].heldParts == HeldParts::All ? kWorldPlacement : entries_[id].parent;
}

/// Where it is while its parent is at X_WP.
Affine Placements::carriedBy(PlacementId id, const Affine& X_WP) const {
  const Entry& e = entries_[id];
  Affine X = e.parent == kWorldPlacement ? X_PN_[id] : X_WP * X_PN_[id];
  if (e.heldParts == HeldParts::All || e.heldParts == HeldParts::Position)
    X.translation() = X_WH_[id].translation();
  if (e.heldParts == HeldParts::All || e.heldParts == HeldParts::Orientation) X.linear() = X_WH_[id].linear();
  return X;
}

const Affine& Placements::world(PlacementId id) const {
  // The matrix that is already one of World, so that X_WN_ needs no copy of it; else null.
  const auto given = [this](PlacementId at) -> const Affine* {
    const Entry& e = entries_[at];
    if (e.heldParts == HeldParts::All) return &X_WH_[at];
    return standsInWorld(e) ? &X_PN_[at] : nullptr;
  };
  if (const Affine* X_WN = given(id)) {
    updateLocal(id);
    return *X_WN;
  }
  if (!entries_[id].stale) return X_WN_[id];
  chain_.clear();
  for (PlacementId at = id; entries_[at].stale && !given(at); at = entries_[at].parent) chain_.push_back(at);
  for (auto at = chain_.rbegin(); at != chain_.rend(); ++at) {
    Entry& e = entries_[*at];
    const Affine* X_WP = given(e.parent);
    X_WN_[*at] = carriedBy(*at, X_WP ? *X_WP : X_WN_[e.parent]);
    e.stale = false;
  }
  return X_WN_[id];
}

void Placements::setShown(PlacementId id, bool shown, Hider hider) {
  const auto bit = static_cast<std::uint8_t>(hider);
  const std::uint8_t before = entries_[id].hiders;
  const auto now = static_cast<std::uint8_t>(shown ? before & ~bit : before | bit);
  if (before == now) return;
  detach(id);
  entries_[id].hiders = now;
  if ((before == 0) != (now == 0)) markBelow(id, false);
}

bool Placements::shown(PlacementId id) const {
  for (; id != kWorldPlacement; id = entries_[id].parent)
    if (entries_[id].hiders != 0) return false;
  return true;
}

// Fleets.

FleetId Placements::addFleet(const FleetRule& rule, std::span<const PlacementId> members) {
  FleetId id;
  if (freeFleets_.empty()) {
    id = static_cast<FleetId>(fleets_.size());
    fleets_.emplace_back();
  } else {
    id = freeFleets_.back();
    freeFleets_.pop_back();
  }
  fleets_[id].rule = &rule;
  fleets_[id].members.assign(members.size(), kNoPlacement);
  for (std::uint32_t k = 0; k < members.size(); ++k)
    if (members[k] != kNoPlacement) join(members[k], id, k);
  return id;
}

void Placements::join(PlacementId id, FleetId fleet, std::uint32_t member) {
  detach(id);  // a member of two fleets is detached from both
  Entry& e = entries_[id];
  const bool plain = standsInWorld(e) && e.firstChild == kNoPlacement && e.hiders == 0 && !e.watched &&
                     !e.attached && !e.detached;
  if (!plain) {
    e.detached = true;
    fleets_[fleet].detached.emplace_back(member, id);
    return;
  }
  fleets_[fleet].members[member] = id;
  e.fleet = fleet;
  e.member = member;
  e.move = 0;
}

void Placements::removeFleet(FleetId id) {
  for (const PlacementId member : fleets_[id].members)
    if (member != kNoPlacement) leaveFleet(member);
  fleets_[id] = Fleet{};
  freeFleets_.push_back(id);
}

/// Writes its local matrix, if its fleet has moved since.
void Placements::updateLocal(PlacementId id) const {
  Entry& e = entries_[id];
  if (e.fleet == kNoFleet) return;
  const Fleet& fleet = fleets_[e.fleet];
  if (!fleet.rule) return;  // restored, and its node has not resumed yet
  if (std::exchange(e.move, fleet.moves) != fleet.moves) X_PN_[id] = memberOf(fleet, e.member).affine();
}

MemberPlace Placements::memberOf(const Fleet& fleet, std::uint32_t member) const {
  MemberPlace place;
  fleet.rule->putMembers(member, {&place, 1});
  return place;
}

std::optional<MemberPlace> Placements::inFleet(PlacementId id) const {
  const Entry& e = entries_[id];
  if (e.fleet == kNoFleet || !fleets_[e.fleet].rule || fleets_[e.fleet].moves == 0) return {};
  return memberOf(fleets_[e.fleet], e.member);
}

/// The placement stays where it is. It is marked even if the fleet stands still. From now on its published
/// records follow from its matrix alone, as for a restored placement.
void Placements::leaveFleet(PlacementId id) {
  updateLocal(id);
  Entry& e = entries_[id];
  Fleet& fleet = fleets_[std::exchange(e.fleet, kNoFleet)];
  fleet.members[e.member] = kNoPlacement;
  mark(id, e);
}

/// Takes the placement out of its fleet's list. The fleet still moves it, by itself.
void Placements::detach(PlacementId id) {
  Entry& e = entries_[id];
  if (e.fleet == kNoFleet) return;
  fleets_[e.fleet].detached.emplace_back(e.member, id);
  leaveFleet(id);
  e.detached = true;
}

void Placements::moveFleet(FleetId id) {
  Fleet& fleet = fleets_[id];
  ++fleet.moves;
  fleet.moved = true;
  placeDetached(fleet);
}

void Placements::placeDetached(const Fleet& fleet) {
  for (const auto& [number, id] : fleet.detached) {
    Entry& e = entries_[id];
    if (e.attached) continue;
    X_PN_[id] = memberOf(fleet, number).affine();
    e.heldParts = HeldParts::Nothing;
    if (e.firstChild != kNoPlacement || e.watched) {
      markBelow(id, true);
      continue;
    }
    e.stale = true;
    mark(id, e);
  }
}

const std::vector<PlacementId>& Placements::takeMovedWatched() {
  movedTold_.clear();
  movedTold_.swap(movedWatched_);
  return movedTold_;
}

const std::vector<PlacementId>& Placements::takeChanged() {
  changedTold_.clear();
  changedTold_.swap(changed_);
  std::erase_if(changedTold_, [&](PlacementId id) {
    const Entry& e = entries_[id];
    entries_[id].changed = false;
    return !e.live || (e.fleet != kNoFleet && fleets_[e.fleet].moved);
  });
  return changedTold_;
}

// The state. What follows from it by the same computation, matrices in World, is not written down.

void Placements::state(StateFields& f) {
  f("placements", entries_);
  if (f.restores()) {
    for (auto* matrices : {&X_PN_, &X_WN_, &X_WH_}) matrices->assign(entries_.size(), Affine::Identity());
    if (!standsTogether()) return f.fail();
  }
  for (PlacementId id = 0; id < entries_.size(); ++id) {
    Entry& e = entries_[id];
    if (f.restores()) {
      e.stale = id != kWorldPlacement;
      e.changed = false;
    }
    if (!e.live) continue;
    f("local", X_PN_[id]);
    if (e.heldParts != HeldParts::Nothing) f("held at", X_WH_[id]);
    if (f.restores() && !(X_PN_[id].matrix().allFinite() && X_WH_[id].matrix().allFinite())) f.fail();
  }
  f("free", free_), f("moved", movedWatched_), f("watched", anyWatched_);
  f("fleets", fleets_), f("free fleets", freeFleets_);
  if (!f.restores()) return;
  changed_.clear();
  if (!freeListsFit() || !fleetsFit()) f.fail();
}

/// Returns true if each free placement and each free fleet is free, and listed once.
bool Placements::freeListsFit() const {
  const auto twice = [](auto list) {
    std::ranges::sort(list);
    return std::ranges::adjacent_find(list) != list.end();
  };
  const auto isKnown = [&](PlacementId id) { return id < entries_.size(); };
  const auto isFree = [&](PlacementId id) { return isKnown(id) && !entries_[id].live; };
  const auto isEmpty = [&](FleetId id) {
    return id < fleets_.size() && fleets_[id].members.empty() && fleets_[id].detached.empty();
  };
  return std::ranges::all_of(free_, isFree) && !twice(free_) && std::ranges::all_of(movedWatched_, isKnown) &&
         std::ranges::all_of(freeFleets_, isEmpty) && !twice(freeFleets_);
}

/// Returns true if each member of a fleet is a live placement that names this fleet and number, and the
/// reverse.
bool Placements::fleetsFit() const {
  const auto isThere = [&](PlacementId id) { return id < entries_.size() && entries_[id].live; };
  for (FleetId id = 0; id < fleets_.size(); ++id) {
    const Fleet& fleet = fleets_[id];
    for (std::uint32_t k = 0; k < fleet.members.size(); ++k)
      if (const PlacementId member = fleet.members[k]; member != kNoPlacement)
        if (!isThere(member) || entries_[member].fleet != id || entries_[member].member != k) return false;
    for (const auto& [number, member] : fleet.detached)
      if (!isThere(member) || number >= fleet.members.size()) return false;
  }
  for (PlacementId id = 0; id < entries_.size(); ++id) {
    const Entry& e = entries_[id];
    if (!e.live || e.fleet == kNoFleet) continue;
    const bool known = e.fleet < fleets_.size() && e.member < fleets_[e.fleet].members.size();
    if (!known || fleets_[e.fleet].members[e.member] != id) return false;
  }
  return true;
}

/// Returns true if every live placement is below World, once.
bool Placements::standsTogether() const {
  if (entries_.empty()) return false;
  const Entry& world = entries_[kWorldPlacement];
  if (world.parent != kNoPlacement || world.nextSibling != kNoPlacement ||
      world.previousSibling != kNoPlacement || world.heldParts != HeldParts::Nothing ||
      world.fleet != kNoFleet)
    return false;
  std::vector<char> seen(entries_.size(), 0);
  std::vector<PlacementId> open{kWorldPlacement};
  seen[kWorldPlacement] = 1;
  while (!open.empty()) {
    const PlacementId up = open.back();
    open.pop_back();
    PlacementId before = kNoPlacement;
    for (PlacementId id = entries_[up].firstChild; id != kNoPlacement; id = entries_[id].nextSibling) {
      if (id >= entries_.size() || std::exchange(seen[id], 1)) return false;
      const Entry& e = entries_[id];
      if (!e.live || e.parent != up || e.previousSibling != before) return false;
      before = id;
      open.push_back(id);
    }
  }
  for (PlacementId id = 0; id < entries_.size(); ++id)
    if (entries_[id].live != (seen[id] != 0)) return false;
  return true;
}

bool Placements::resumeFleet(FleetId fleet, const FleetRule& rule, std::size_t members) {
  if (fleet >= fleets_.size() || fleets_[fleet].members.size() != members) return false;
  fleets_[fleet].rule = &rule;
  return true;
}

}  // namespace stadion
