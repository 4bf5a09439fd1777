#include "dynamics/state/contact_events.h"

#include "dynamics/body/rigid_body.h"
#include "engine/core/state_hash.h"

#include <algorithm>

namespace stadion {
std::uint64_t ContactMemory::share(const Key& pair, const Memory& m) {
  if (m.idle()) return 0;
  StateHash h;
  h.add(pair.first.isBody);
  h.add(pair.first.id);
  h.add(pair.second);
  h.add(m.touching);
  h.add(m.waiting != kNowhere);
  h.add(m.impact);
  return h.value();
}

ContactMemory::Key ContactMemory::keyOf(ContactSide a, ContactSide b) {
  if (a.isBody && (!b.isBody || b.id < a.id)) std::swap(a, b);
  return {a, b.id};
}

template <class F>
void ContactMemory::update(const Key& pair, F change) {
  const auto [at, isNew] = memory_.try_emplace(pair);
  Memory& m = at->second;
  if (isNew) others_.emplace(pair.second, pair.first);
  if (!isNew && m.idle()) --idle_;
  change(m);
  digest_ -= m.share;
  digest_ += m.share = share(pair, m);
  if (m.idle() && ++idle_ > 64 + memory_.size() / 2) forgetIdle();
}

/// The farthest that the pair can have gone grows at least evenly towards `look`, since it only gets faster.
double ContactMemory::Waiting::slackAt(Nanoseconds time) const {
  if (time <= seen) return slack;
  if (!byWay || time >= look) return 0;
  return slack * (toSeconds(look - time) / toSeconds(look - seen));
}

ContactMemory::Waiting* ContactMemory::impact(const Key& pair, Nanoseconds time, const Vec3& point,
                                              const Vec3& normal, double speed, double impulse,
                                              std::uint64_t frame, bool awaited) {
  if (!(speed > kImpactSpeed) || touching(pair)) return nullptr;
  events_.push_back(
      {ContactEvent::Kind::Impact, time, pair.first, pair.second, point, normal, speed, impulse});
  if (!awaited) return nullptr;
  Waiting* waiting = nullptr;
  update(pair, [&](Memory& m) {
    if (m.waiting == kNowhere) {
      m.waiting = static_cast<std::uint32_t>(waiting_.size());
      waiting_.push_back({pair});
    }
    waiting = &waiting_[m.waiting];
    m.impact = time;
    waiting->frame = frame;
    waiting->seen = time;
  });
  return waiting;
}

void ContactMemory::setTouching(const Key& pair, bool now) {
  if (touching(pair) != now) update(pair, [&](Memory& m) { m.touching = now; });
}

bool ContactMemory::touching(const Key& pair) const {
  const auto at = memory_.find(pair);
  return at != memory_.end() && at->second.touching;
}

std::uint64_t ContactMemory::share(const Owed& owed) {
  StateHash h;
  h.add(owed.pair.first.isBody);
  h.add(owed.pair.first.id);
  h.add(owed.pair.second);
  h.add(owed.time);
  return h.value();
}

void ContactMemory::beginFrame() {
  events_.clear();
  for (const Owed& o : owed_) {
    digest_ -= share(o);
    events_.push_back(
        {ContactEvent::Kind::Release, o.time, o.pair.first, o.pair.second, Vec3::Zero(), Vec3::Zero(), 0, 0});
  }
  owed_.clear();
}

ContactMemory::Waiting* ContactMemory::waitingOf(const Key& pair) {
  const auto at = memory_.find(pair);
  return at == memory_.end() || at->second.waiting == kNowhere ? nullptr : &waiting_[at->second.waiting];
}

void ContactMemory::releaseLater(const Key& pair, Nanoseconds time) {
  if (!waitingOf(pair)) return;
  update(pair, [&](Memory& m) { leave(m); });
  owed_.push_back({pair, time});
  digest_ += share(owed_.back());
}

void ContactMemory::release(const Key& pair, Nanoseconds time) {
  const auto at = memory_.find(pair);
  if (at == memory_.end() || at->second.waiting == kNowhere) return;
  update(pair, [&](Memory& m) { leave(m); });
  events_.push_back(
      {ContactEvent::Kind::Release, time, pair.first, pair.second, Vec3::Zero(), Vec3::Zero(), 0, 0});
}

/// It waits no longer; the last one takes its place.
void ContactMemory::leave(Memory& m) {
  memory_.find(waiting_.back().pair)->second.waiting = m.waiting;
  waiting_[m.waiting] = waiting_.back();
  waiting_.pop_back();
  m.waiting = kNowhere;
}

void ContactMemory::forget(ContactSide gone) {
  std::vector<Key> pairs;
  eachWith(gone, [&](const Key& pair) { pairs.push_back(pair); });
  for (const Key& pair : pairs) erase(pair);
}

void ContactMemory::erase(const Key& pair) {
  const auto at = memory_.find(pair);
  digest_ -= at->second.share;
  if (at->second.waiting != kNowhere) leave(at->second);
  memory_.erase(at);
  others_.erase({pair.second, pair.first});
}

void ContactMemory::forgetIdle() {
  std::erase_if(memory_, [&](const auto& known) {
    if (!known.second.idle()) return false;
    others_.erase({known.first.second, known.first.first});
    return true;
  });
  idle_ = 0;
}

void rememberTouching(ContactMemory& memory, RigidBody& b, const std::vector<ContactSide>& near) {
  const auto in = [](const std::vector<ContactSide>& list, ContactSide p) {
    return std::find(list.begin(), list.end(), p) != list.end();
  };
  for (const ContactSide p : near)
    if (!in(b.contact.leaning, p)) memory.setTouching(ContactMemory::keyOf(p, {true, b.id}), true);
  for (const ContactSide p : b.contact.leaning)
    if (!in(near, p)) memory.setTouching(ContactMemory::keyOf(p, {true, b.id}), false);
  b.contact.leaning = near;
}

}  // namespace stadion
