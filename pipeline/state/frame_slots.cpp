#include "pipeline/state/frame_slots.h"

#include <algorithm>

namespace stadion {

FrameSlots::FrameSlots(std::size_t walls, Delivery delivery, std::chrono::milliseconds deadline)
    : cursor_(walls, 0), delivery_(delivery), deadline_(deadline) {}

std::optional<std::size_t> FrameSlots::writable() {
  std::optional<std::size_t> oldest;
  for (std::size_t i = 0; i < kSlots; ++i) {
    if (slots_[i].state == State::Free) return i;
    const bool mayReplace = delivery_ == Delivery::Latest && slots_[i].state == State::Published;
    if (mayReplace && (!oldest || slots_[i].written < slots_[*oldest].written)) oldest = i;
  }
  if (oldest || delivery_ == Delivery::Every) return oldest;
  // All slots are leased. A lease that is past its deadline belongs to a reader that hangs.
  for (std::size_t i = 0; i < kSlots; ++i)
    if (slots_[i].state == State::Leased && std::chrono::steady_clock::now() - slots_[i].since > deadline_)
      return i;
  return std::nullopt;
}

bool FrameSlots::mayBegin(std::uint64_t begun) const {
  return mostInFlight_ == 0 || begun < framesShown_ + mostInFlight_ + (oldestIsNearlyDrawn() ? 1 : 0);
}

/// Returns true if few enough walls still draw the oldest frame.
bool FrameSlots::oldestIsNearlyDrawn() const {
  return wallsDrawn_ > 0 && wallsDrawn_ + wallsLeft_ >= cursor_.size();
}

std::optional<std::size_t> FrameSlots::beginWrite() {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (stopped_) return std::nullopt;
    const bool may = delivery_ == Delivery::Latest || mayBegin(writes_);
    if (const auto slot = may ? writable() : std::nullopt) {
      slots_[*slot].state = State::Writing;
      return slot;
    }
    changed_.wait_for(lock, deadline_);
  }
}

void FrameSlots::endWrite(std::size_t slot, const FrameTicket& ticket) {
  const std::lock_guard lock(mutex_);
  slots_[slot].state = State::Published;
  slots_[slot].ticket = ticket;
  slots_[slot].written = writes_++;
  changed_.notify_all();
}

std::optional<std::size_t> FrameSlots::choose() const {
  std::optional<std::size_t> chosen;
  for (std::size_t i = 0; i < kSlots; ++i) {
    if (slots_[i].state != State::Published) continue;
    const bool better =
        !chosen || (delivery_ == Delivery::Every ? slots_[i].written < slots_[*chosen].written
                                                 : slots_[i].written > slots_[*chosen].written);
    if (better) chosen = i;
  }
  return chosen;
}

std::optional<Lease> FrameSlots::lease(std::size_t wall) {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (stopped_) return std::nullopt;
    const auto at = std::find_if(selections_.begin(), selections_.end(),
                                 [&](const Selection& s) { return s.serial == cursor_[wall]; });
    if (at != selections_.end()) {
      const Lease lease{at->slot, at->ticket, at->serial};
      ++cursor_[wall];
      if (--at->unread == 0) selections_.erase(at);
      return lease;
    }
    const auto next = choose();
    const bool may = delivery_ == Delivery::Every || mayBegin(nextSerial_);
    if (const auto slot = may ? next : std::nullopt) {
      Slot& s = slots_[*slot];
      s.state = State::Leased;
      s.readers = cursor_.size();
      s.serial = nextSerial_++;
      s.since = std::chrono::steady_clock::now();
      selections_.push_back({s.serial, *slot, s.ticket, cursor_.size()});
      // Frames older than the chosen one will not be shown any more.
      for (Slot& other : slots_)
        if (other.state == State::Published && other.written < s.written) other.state = State::Free;
      changed_.notify_all();
      continue;
    }
    if (finished_ && !next) return std::nullopt;
    changed_.wait(lock);
  }
}

bool FrameSlots::release(const Lease& lease) {
  const std::lock_guard lock(mutex_);
  Slot& s = slots_[lease.slot];
  if (s.state != State::Leased || s.serial != lease.serial) return false;
  if (--s.readers > 0) return true;  // no thread waits for that
  s.state = State::Free;
  changed_.notify_all();
  return true;
}

void FrameSlots::limitInFlight(std::size_t frames, std::size_t wallsLeft) {
  const std::lock_guard lock(mutex_);
  if (mostInFlight_ == frames && wallsLeft_ == wallsLeft) return;  // the case in nearly every frame
  mostInFlight_ = frames;
  wallsLeft_ = wallsLeft;
  changed_.notify_all();
}

void FrameSlots::noteDrawn() {
  const std::lock_guard lock(mutex_);
  const bool was = oldestIsNearlyDrawn();
  ++wallsDrawn_;
  if (mostInFlight_ > 0 && oldestIsNearlyDrawn() != was) changed_.notify_all();
}

void FrameSlots::noteShown() {
  const std::lock_guard lock(mutex_);
  ++framesShown_;
  wallsDrawn_ = 0;
  changed_.notify_all();
}

void FrameSlots::finish() {
  const std::lock_guard lock(mutex_);
  finished_ = true;
  changed_.notify_all();
}

void FrameSlots::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  changed_.notify_all();
}

}  // namespace stadion
