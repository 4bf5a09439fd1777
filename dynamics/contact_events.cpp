#include "dynamics/contact_events.h"

namespace stadion {

ContactMemory::Key ContactMemory::keyOf(Party a, Party b) {
  if (a.isBody && (!b.isBody || b.id < a.id)) std::swap(a, b);
  return {a, b.id};
}

void ContactMemory::impact(const Key& pair, Nanoseconds time, const Vec3& point, const Vec3& normal,
                           double speed, double impulse, std::uint64_t frame) {
  if (!(speed > kImpactSpeed)) return;
  Memory& m = memory_[pair];
  if (m.touching) return;
  m.fired = true, m.impact = time, m.frame = frame;
  events_.push_back(
      {ContactEvent::Kind::Impact, time, pair.first, pair.second, point, normal, speed, impulse});
}

void ContactMemory::setTouching(const Key& pair, bool touching) {
  const auto at = memory_.find(pair);
  if (at == memory_.end()) {
    if (touching) memory_[pair].touching = true;
    return;
  }
  at->second.touching = touching;
  if (!touching && !at->second.fired) memory_.erase(at);
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
  if (!at->second.touching) memory_.erase(at);
}

void ContactMemory::forget(Party gone) {
  std::erase_if(memory_, [&](const auto& m) {
    return m.first.first == gone || (gone.isBody && m.first.second == gone.id);
  });
}

}  // namespace stadion
