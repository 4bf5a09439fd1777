#include "dynamics/contact_events.h"

namespace stadion {

ContactMemory::Key ContactMemory::keyOf(Party a, Party b) {
  if (a.isBody && (!b.isBody || b.id < a.id)) std::swap(a, b);
  return {a, b.id};
}

void ContactMemory::impact(const Key& pair, Nanoseconds time, const Vec3& point, const Vec3& normal,
                           double speed, double impulse, std::uint64_t frame) {
  if (!(speed > kImpactSpeed)) return;
  Memory& m = at(pair);
  if (m.touching) return;
  m.fired = true, m.impact = time, m.frame = frame;
  events_.push_back(
      {ContactEvent::Kind::Impact, time, pair.first, pair.second, point, normal, speed, impulse});
}

void ContactMemory::setTouching(const Key& pair, bool touching) {
  const auto at = memory_.find(pair);
  if (at == memory_.end()) {
    if (touching) this->at(pair).touching = true;
    return;
  }
  at->second.touching = touching;
  if (!touching && !at->second.fired) erase(pair);
}

bool ContactMemory::touching(const Key& pair) const {
  const auto at = memory_.find(pair);
  return at != memory_.end() && at->second.touching;
}

void ContactMemory::release(const Key& pair, Nanoseconds time) {
  const auto at = memory_.find(pair);
  if (at == memory_.end() || !at->second.fired) return;
  at->second.fired = false;
  events_.push_back(
      {ContactEvent::Kind::Release, time, pair.first, pair.second, Vec3::Zero(), Vec3::Zero(), 0, 0});
  if (!at->second.touching) erase(pair);
}

void ContactMemory::forget(Party gone) {
  for (auto m = memory_.lower_bound({gone, 0}); m != memory_.end() && m->first.first == gone;) {
    others_.erase({m->first.second, gone});
    m = memory_.erase(m);
  }
  if (!gone.isBody) return;
  for (auto o = others_.lower_bound({gone.id, {}}); o != others_.end() && o->first == gone.id;) {
    memory_.erase({o->second, gone.id});
    o = others_.erase(o);
  }
}

ContactMemory::Memory& ContactMemory::at(const Key& pair) {
  const auto [at, isNew] = memory_.try_emplace(pair);
  if (isNew) others_.emplace(pair.second, pair.first);
  return at->second;
}

void ContactMemory::erase(const Key& pair) {
  memory_.erase(pair);
  others_.erase({pair.second, pair.first});
}

}  // namespace stadion
