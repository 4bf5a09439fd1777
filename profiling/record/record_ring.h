#pragma once
/// Passes records from the thread that makes them to the thread that collects them, without a lock.
///
/// Whenever all records have been collected, it starts again at its first place: a ring with few records
/// stays in the cache. Memory beyond the furthest record so far is not touched: most rings never use it.
///
/// Threads  claim() and push() on the maker's; next() and take() on the collector's; lost() on any.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

namespace stadion {

template <class Record>
class RecordRing {
public:
  static_assert(std::is_trivially_destructible_v<Record> &&
                alignof(Record) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);

  explicit RecordRing(std::size_t capacity)
      : capacity_(capacity), memory_(std::make_unique_for_overwrite<std::byte[]>(capacity * sizeof(Record))) {
    while (made_ < std::min(capacity_, kReady)) make();
  }

  /// Returns the place of the next record, until it is pushed. Returns null, and counts a loss, if the ring
  /// is full.
  Record* claim() {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    const std::size_t tail = tail_.load(std::memory_order_acquire);
    // The collector reads it only after a push, and until then the ring is empty.
    if (head == tail) first_.store(head, std::memory_order_relaxed);
    if (head - tail < capacity_) {
      if (placeOf(head) == made_) make();
      return at(head);
    }
    lost_.fetch_add(1, std::memory_order_relaxed);
    return nullptr;
  }
  void push() { head_.store(head_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

  /// Returns the oldest record, until it is taken; null if there is none.
  const Record* next() const {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    return tail == head_.load(std::memory_order_acquire) ? nullptr : at(tail);
  }
  /// Takes the oldest record, if there is one.
  bool take(Record& out) {
    const Record* oldest = next();
    if (!oldest) return false;
    out = *oldest;
    tail_.store(tail_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
    return true;
  }
  /// Returns the number of records for which there was no room.
  std::uint64_t lost() const { return lost_.load(std::memory_order_relaxed); }

private:
  static constexpr std::size_t kReady = 1024;  ///< records that cause no page fault

  std::size_t placeOf(std::size_t number) const {
    return (number - first_.load(std::memory_order_relaxed)) % capacity_;
  }
  Record* at(std::size_t number) { return reinterpret_cast<Record*>(memory_.get()) + placeOf(number); }
  const Record* at(std::size_t number) const { return const_cast<RecordRing*>(this)->at(number); }

  /// Places are constructed one after the other.
  void make() {
    std::construct_at(reinterpret_cast<Record*>(memory_.get()) + made_);
    ++made_;
  }

  std::size_t capacity_, made_ = 0;
  std::unique_ptr<std::byte[]> memory_;
  std::atomic<std::size_t> first_ = 0;  ///< the number of the record at the first place
  std::atomic<std::size_t> head_ = 0, tail_ = 0;
  std::atomic<std::uint64_t> lost_ = 0;
};

}  // namespace stadion
