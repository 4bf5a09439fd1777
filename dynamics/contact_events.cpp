#include "dynamics/contact_events.h"

#include "engine/state_hash.h"

namespace stadion {
namespace {

/// What a pair adds to the digest.
std::uint64_t share(const ContactMemory::Key& pair, const ContactMemory::Memory& m) {
  StateHash h;
  h.add(pair.first.isBody), h.add(pair.first.id), h.add(pair.second);
  h.add(m.touching), h.add(m.fired), h.add(m.impact);
  return h.value();
}

}  // namespace

ContactMemory::Key ContactMemory::keyOf(Party a, Party b) {
  if (a.isBody && (!b.isBody || b.id < a.id)) std::swap(a, b);
  return {a, b.id};
}

template <class F>
void ContactMemory::update(const Key& pair, F change) {
  const auto [at, isNew] = memory_.try_emplace(pair);
  Memory& m = at->second;
  if (isNew)
    others_.emplace(pair.second, pair.first);
  else
    digest_ -= share(pair, m);
  change(m);
  digest_ += share(pair, m);
  m.fired ? void(fired_.emplace(pair, &m)) : void(fired_.erase(pair));
  if (!m.touching && !m.fired) erase(pair);
}

bool ContactMemory::impact(const Key& pair, Nanoseconds time, const Vec3& point, const Vec3& normal,
                           double speed, double impulse, std::uint64_t frame) {
  if (!(speed > kImpactSpeed) || touching(pair)) return false;
  update(pair, [&](Memory& m) { m.fired = true, m.impact = time, m.frame = frame; });
  events_.push_back(
      {ContactEvent::Kind::Impact, time, pair.first, pair.second, point, normal, speed, impulse});
  return true;
}

void ContactMemory::setTouching(const Key& pair, bool now) {
  if (touching(pair) != now) update(pair, [&](Memory& m) { m.touching = now; });
}

bool ContactMemory::touching(const Key& pair) const {
  const auto at = memory_.find(pair);
  return at != memory_.end() && at->second.touching;
}

void ContactMemory::release(const Key& pair, Nanoseconds time) {
  if (!fired_.contains(pair)) return;
  update(pair, [](Memory& m) { m.fired = false; });
  events_.push_back(
      {ContactEvent::Kind::Release, time, pair.first, pair.second, Vec3::Zero(), Vec3::Zero(), 0, 0});
}

void ContactMemory::forget(Party gone) {
  std::vector<Key> pairs;
  eachWith(gone, [&](const Key& pair) { pairs.push_back(pair); });
  for (const Key& pair : pairs) erase(pair);
}

void ContactMemory::erase(const Key& pair) {
  const auto at = memory_.find(pair);
  digest_ -= share(pair, at->second);
  memory_.erase(at);
  fired_.erase(pair);
  others_.erase({pair.second, pair.first});
}

}  // namespace stadion
