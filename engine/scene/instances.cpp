#include "engine/scene/instances.h"

#include "engine/core/state_fields.h"
#include "engine/scene/degradation.h"

#include <algorithm>
#include <optional>
#include <set>

namespace stadion {

InstanceId Instances::add(PlacementId placement, MeshId mesh, bool drawn, NodeRef owner) {
  InstanceId id;
  if (free_.empty()) {
    id = static_cast<InstanceId>(all_.size());
    all_.emplace_back();
  } else {
    id = free_.back();
    free_.pop_back();
  }
  Instance& i = all_[id];
  i.placement = placement;
  i.owner = owner;
  i.figure = i.paint = 0;
  i.seeThrough = i.vanished = i.ownReach = false;
  i.drawn = drawn;
  i.live = true;
  if (first_.size() <= placement) first_.resize(placement + std::size_t{1}, kNone);
  i.next = std::exchange(first_[placement], id);
  setMesh(id, mesh);
  return id;
}

void Instances::remove(InstanceId id) {
  Instance& i = all_[id];
  InstanceId* at = &first_[i.placement];
  while (*at != id) at = &all_[*at].next;
  *at = i.next;
  i.live = false;
  reaches_.erase(id);
  mark(id);
  free_.push_back(id);
}

void Instances::setMesh(InstanceId id, MeshId mesh) {
  all_[id].mesh = mesh;
  findForm(all_[id]);
  mark(id);
}

void Instances::setFigure(InstanceId id, std::uint16_t figure) {
  all_[id].figure = figure & kMostFigures;
  mark(id);
}

void Instances::setPaint(InstanceId id, std::uint16_t number, double opacity) {
  all_[id].paint = number & kMostPaints;
  all_[id].seeThrough = number != 0 && static_cast<float>(opacity) < PaintRecord::kOpaque;
  all_[id].vanished = number != 0 && opacity == 0;
  mark(id);
}

void Instances::setReach(InstanceId id, const std::optional<Sphere>& reach) {
  all_[id].ownReach = reach.has_value();
  if (reach)
    reaches_[id] = *reach;
  else
    reaches_.erase(id);
  mark(id);
}

void Instances::findForm(Instance& i) const {
  i.form = i.mesh == kNoMesh ? nullptr : meshes_.find(i.mesh);
  i.transparent = i.form && i.form->transparent();
  i.leveled = i.form && !i.form->levels.empty();
}

// This frame is not published yet: the last one that may show the mesh came before it.
void Instances::releaseMesh(MeshId mesh) {
  if (mesh != kNoMesh) meshes_.release(mesh, time_.frame);
}

void Instances::mark(InstanceId id) {
  if (all_[id].changed) return;
  all_[id].changed = true;
  changed_.push_back(id);
}

void Instances::markAt(PlacementId placement) {
  if (placement >= first_.size()) return;
  for (InstanceId id = first_[placement]; id != kNone; id = all_[id].next) mark(id);
}

/// Writes all of a record but the place.
inline void Instances::describe(const Instance& i, bool shown, const Degradation& degradation,
                                InstanceRecord& r) {
  r.mesh = i.mesh;
  r.owner = i.owner;
  r.flags = (i.drawn && shown && !i.vanished ? InstanceRecord::kShown : 0) |
            (i.transparent || i.seeThrough ? InstanceRecord::kTransparent : 0) |
            i.figure << InstanceRecord::kFigureAt | i.paint << InstanceRecord::kPaintAt;
  r.lodFactor = i.leveled ? static_cast<float>(degradation.of(i.owner).lod) : 0;
}

/// Hands on the records before this one if they make a block.
inline InstanceRecord& Instances::nextRecord(InstanceId id, ChangeSet& changes) {
  if (changes.instances.size() >= ChangeSet::kBlock) handOn(changes);
  ++published_;
  ChangeSet::Instance& change = changes.instances.emplace_back();
  change.id = id;
  return change.record;
}

void Instances::publishAll(PlacementId placement, const Degradation& degradation, ChangeSet& changes) {
  const Affine& X_WN = placements_.world(placement);
  const bool shown = placements_.shown(placement);
  for (InstanceId id = first_[placement]; id != kNone; id = all_[id].next)
    if (!all_[id].changed) publish(all_[id], id, X_WN, shown, degradation, changes);
}

void Instances::publishFleet(std::span<const PlacementId> ids, std::span<const MemberPlace> places,
                             const Degradation& degradation, ChangeSet& changes) {
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const PlacementId p = ids[k];
    if (p >= first_.size()) continue;  // also kNoPlacement
    for (InstanceId id = first_[p]; id != kNone; id = all_[id].next) {
      const Instance& i = all_[id];
      if (i.changed || !i.form) continue;
      InstanceRecord& r = nextRecord(id, changes);
      placeInstance(r, places[k].rows, places[k].widens, sphereOf(i, id));
      describe(i, true, degradation, r);
    }
  }
}

void Instances::publishMarked(const Degradation& degradation, ChangeSet& changes) {
  for (const InstanceId id : changed_) {
    const Instance& i = all_[id];
    all_[id].changed = false;
    const PlacementId p = i.live ? i.placement : kWorldPlacement;
    publish(i, id, placements_.world(p), placements_.shown(p), degradation, changes);
  }
  changed_.clear();
  handOn(changes);
}

void Instances::publish(const Instance& i, InstanceId id, const Affine& X_WN, bool shown,
                        const Degradation& degradation, ChangeSet& changes) {
  InstanceRecord& r = nextRecord(id, changes);
  if (!i.live || !i.form) {
    r = InstanceRecord{};
    r.radius = -1;
    return;
  }
  if (const std::optional<MemberPlace> member = placements_.inFleet(i.placement))
    placeInstance(r, member->rows, member->widens, sphereOf(i, id));
  else
    placeInstance(r, X_WN, sphereOf(i, id));
  describe(i, shown, degradation, r);
}

void Instances::handOn(ChangeSet& changes) {
  if (!changes.sink || changes.instances.empty()) return;
  changes.sink->take(changes.instances);
  changes.instances.clear();
}

void Instances::state(StateFields& f) {
  if (f.restores()) reaches_.clear();
  f("instances", all_), f("free instances", free_), f("instances at", first_);
}

bool Instances::consistent() const {
  for (const Instance& i : all_)
    if (i.live && (!placements_.has(i.placement) || i.placement >= first_.size())) return false;
  std::vector<char> seen(all_.size(), 0);
  for (InstanceId id : first_)
    for (; id != kNone; id = all_[id].next)
      if (id >= all_.size() || !all_[id].live || std::exchange(seen[id], 1)) return false;
  for (InstanceId id = 0; id < all_.size(); ++id)
    if (all_[id].live != (seen[id] != 0)) return false;
  const auto free = [&](InstanceId id) { return id < all_.size() && !all_[id].live; };
  return std::ranges::all_of(free_, free) && std::set(free_.begin(), free_.end()).size() == free_.size();
}

void Instances::resume() {
  for (InstanceId id = 0; id < all_.size(); ++id) {
    if (!all_[id].live) continue;
    findForm(all_[id]);
    mark(id);
  }
}

bool Instances::complete() const {
  return std::ranges::none_of(all_, [](const Instance& i) { return i.live && i.mesh != kNoMesh && !i.form; });
}

}  // namespace stadion
