#pragma once
/// The three slots of scene state between App and Cull, without threads: the slot to write, and the slot to
/// read next (pipeline/state/frame_slots.h).

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace stadion::plan {

/// A frame on its way.
struct Ticket {
  std::uint64_t frame = 0;
  double began = 0;
};

class Slots {
public:
  Slots(std::size_t readers, bool newest) : readers_(readers), newest_(newest) {}

  bool canWrite() const { return writable() < slots_.size(); }
  std::size_t beginWrite() {
    const std::size_t slot = writable();
    slots_[slot].state = State::Writing;
    return slot;
  }
  void endWrite(std::size_t slot, const Ticket& ticket) {
    slots_[slot] = {State::Published, ticket, writes_++, 0};
  }
  void finish() { finished_ = true; }

  /// Returns true if the `serial`th frame to show exists, or never will.
  bool canRead(std::size_t serial) const {
    return serial < chosen_.size() || finished_ || next() < slots_.size();
  }
  struct Lease {
    std::size_t slot = 0;
    Ticket ticket;
  };
  std::optional<Lease> lease(std::size_t serial) {
    if (serial < chosen_.size()) return chosen_[serial];
    const std::size_t slot = next();
    if (slot == slots_.size()) return std::nullopt;
    slots_[slot].state = State::Leased;
    slots_[slot].unread = readers_;
    for (Slot& other : slots_)
      if (other.state == State::Published && other.written < slots_[slot].written) other.state = State::Free;
    chosen_.push_back({slot, slots_[slot].ticket});
    return chosen_.back();
  }
  void release(std::size_t slot) {
    if (--slots_[slot].unread == 0) slots_[slot].state = State::Free;
  }

private:
  enum class State { Free, Writing, Published, Leased };
  struct Slot {
    State state = State::Free;
    Ticket ticket;
    std::uint64_t written = 0;
    std::size_t unread = 0;
  };

  /// Returns a free slot, else the oldest one that no reader has begun; the end if there is none.
  std::size_t writable() const {
    std::size_t oldest = slots_.size();
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      if (slots_[i].state == State::Free) return i;
      const bool older = oldest == slots_.size() || slots_[i].written < slots_[oldest].written;
      if (newest_ && slots_[i].state == State::Published && older) oldest = i;
    }
    return oldest;
  }
  /// Returns the slot to be shown next; the end if there is none.
  std::size_t next() const {
    std::size_t best = slots_.size();
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      if (slots_[i].state != State::Published) continue;
      const bool newer = best < slots_.size() && slots_[i].written > slots_[best].written;
      if (best == slots_.size() || newer == newest_) best = i;
    }
    return best;
  }

  std::size_t readers_;
  bool newest_;
  std::array<Slot, 3> slots_;
  std::vector<Lease> chosen_;
  std::uint64_t writes_ = 0;
  bool finished_ = false;
};

}  // namespace stadion::plan
