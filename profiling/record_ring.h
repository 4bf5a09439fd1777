#pragma once
/// Records on their way from the thread that makes them to the one that collects them, without a lock.
///
/// Whenever all has been collected it begins again at its first place: a ring that few records pass through
/// stays in the cache.
///
/// Threads  claim() and push() on the maker's; next() and take() on the collector's; lost() on any.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace stadion {

template <class Record>
class RecordRing {
public:
  explicit RecordRing(std::size_t capacity) : records_(capacity) {}

  /// The place of the next record, until it is pushed; null, and counted, if nobody has collected.
  Record* claim() {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    const std::size_t tail = tail_.load(std::memory_order_acquire);
    // The collector looks at it only after a push, and until then there is nothing to look at.
    if (head == tail) first_.store(head, std::memory_order_relaxed);
    if (head - tail < records_.size()) return at(head);
    lost_.fetch_add(1, std::memory_order_relaxed);
    return nullptr;
  }
  void push() { head_.store(head_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

  /// The oldest, until it is taken; null if there is none.
  const Record* next() const {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    return tail == head_.load(std::memory_order_acquire) ? nullptr : at(tail);
  }
  /// Takes it, if there is one.
  bool take(Record& out) {
    const Record* oldest = next();
    if (!oldest) return false;
    out = *oldest;
    tail_.store(tail_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
    return true;
  }
  /// Records for which there was no room.
  std::uint64_t lost() const { return lost_.load(std::memory_order_relaxed); }

private:
  Record* at(std::size_t number) {
    return &records_[(number - first_.load(std::memory_order_relaxed)) % records_.size()];
  }
  const Record* at(std::size_t number) const { return const_cast<RecordRing*>(this)->at(number); }

  std::vector<Record> records_;
  std::atomic<std::size_t> first_ = 0;  ///< the number of the record that lies at the first place
  std::atomic<std::size_t> head_ = 0, tail_ = 0;
  std::atomic<std::uint64_t> lost_ = 0;
};

}  // namespace stadion
