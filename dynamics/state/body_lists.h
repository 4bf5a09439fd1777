#pragma once
/// Lists of bodies and colliders that the world works through: those that move, and those whose motion has
/// changed since the last prediction.

#include "dynamics/body/id_table.h"
#include "dynamics/body/rigid_body.h"

#include <algorithm>
#include <vector>

namespace stadion {

/// The bodies that do not rest, and those that have come to rest in this frame.
class ActiveBodies {
public:
  void add(RigidBody& b) {
    if (!b.active) {
      b.active = true;
      list_.push_back(&b);
    }
  }
  void forget(RigidBody& b) { std::erase(list_, &b); }

  std::size_t size() const { return list_.size(); }
  bool empty() const { return list_.empty(); }
  auto begin() const { return list_.begin(); }
  auto end() const { return list_.end(); }

  /// Calls f(body) for each body; those of which `active` is false then leave the list.
  template <class F>
  void update(F f) {
    constexpr std::size_t kAhead = 4;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < list_.size(); ++i) {
      if (i + kAhead < list_.size()) fetchIfMany(*list_[i + kAhead]);
      RigidBody* b = list_[i];
      f(*b);
      if (b->active) list_[kept++] = b;
    }
    list_.resize(kept);
  }
  bool many() const { return list_.size() > kFitInCache; }
  /// Fetches a body that is needed soon, if not all fit into a processor's own cache.
  void fetchIfMany(const RigidMotion& b) const {
    if (!many()) return;
    constexpr std::size_t kLine = 64;
#pragma GCC unroll 64
    for (std::size_t i = 0; i < sizeof b; i += kLine)
      __builtin_prefetch(reinterpret_cast<const char*>(&b) + i);
  }

  template <class Fields, class Find>
  void state(Fields& f, const Find& find) {
    listState("active", list_, f, find);
  }

private:
  static constexpr std::size_t kFitInCache = 256;
  std::vector<RigidBody*> list_;
};

/// Bodies with new arcs and colliders with new motions, along which the world has not looked ahead yet.
class ChangedMotions {
public:
  void mark(RigidBody& b) {
    if (!b.marked) {
      b.marked = true;
      bodies_.push_back(&b);
    }
  }
  /// Marks a collider that has appeared, moved or jumped.
  void mark(ColliderId id) { colliders_.push_back(id); }
  void forget(RigidBody& b) { std::erase(bodies_, &b); }

  const std::vector<RigidBody*>& bodies() const { return bodies_; }
  /// Colliders whose motion has changed. Colliders of the last frame stay until the world knows that they
  /// stand.
  const std::vector<ColliderId>& colliders() const { return colliders_; }
  void sortBodies() {
    if (!std::ranges::is_sorted(bodies_, {}, &RigidBody::id)) std::ranges::sort(bodies_, {}, &RigidBody::id);
  }
  void sortColliders() {
    std::ranges::sort(colliders_);
    colliders_.erase(std::unique(colliders_.begin(), colliders_.end()), colliders_.end());
  }
  void clearBodies() {
    for (RigidBody* b : bodies_) b->marked = false;
    bodies_.clear();
  }
  template <class F>
  void dropColliders(F isDone) {
    std::erase_if(colliders_, isDone);
  }

  /// Returns true if a new arc is predicted at once, as while events run; else it is marked for later.
  bool immediate() const { return immediate_; }
  void setImmediate(bool on) { immediate_ = on; }

  template <class Fields>
  void stateOfMode(Fields& f) {
    f("foresee", immediate_);
  }
  template <class Fields>
  void stateOfColliders(Fields& f) {
    f("told", colliders_);
  }
  template <class Fields, class Find>
  void stateOfBodies(Fields& f, const Find& find) {
    listState("marked", bodies_, f, find);
  }

private:
  std::vector<RigidBody*> bodies_;
  std::vector<ColliderId> colliders_;
  bool immediate_ = false;
};

}  // namespace stadion
