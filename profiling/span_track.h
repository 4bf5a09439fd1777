#pragma once
/// What one thread did: its spans, on their way from it to whoever collects them.
///
/// Threads  began() and ended() on the thread itself, take() on the collector's; they meet without a lock.

#include "engine/frame_probe.h"

#include <array>
#include <atomic>
#include <chrono>
#include <vector>

namespace stadion {

using ProfileClock = std::chrono::steady_clock;

/// A span that is over. Within a thread spans end in the order of their ends: parts before what holds them.
struct SpanRecord {
  ProfileClock::time_point began, ended;
  std::uint64_t frame = kNoFrame;
  std::uint32_t wall = kNoWall;
  NodeRef node;
  Span what = Span::App;
  std::uint8_t depth = 0;  ///< 0 = in no other
  std::uint32_t own = 0;   ///< [ns] of it in no part

  double ms() const { return std::chrono::duration<double, std::milli>(ended - began).count(); }
};

class SpanTrack {
public:
  static constexpr std::size_t kCapacity = 1 << 16;
  static constexpr std::size_t kDeepest = 12;

  SpanTrack() : ring_(kCapacity) {}

  /// What comes below it inherits the frame and the wall.
  void began(Span what, std::uint64_t frame, std::uint32_t wall, NodeRef node) {
    if (depth_ >= kDeepest) {
      ++depth_;
      return;
    }
    Open& open = open_[depth_++];
    open.what = what, open.frame = frame, open.wall = wall, open.node = node;
    open.within = 0;
    open.began = ProfileClock::now();
  }
  void ended() {
    const ProfileClock::time_point now = ProfileClock::now();
    if (depth_ == 0 || --depth_ >= kDeepest) return;
    const Open& open = open_[depth_];
    const auto took = nanoseconds(now - open.began);
    if (depth_ > 0) open_[depth_ - 1].within += took;
    last_[static_cast<std::size_t>(open.what)] = took;
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) == kCapacity) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    ring_[head % kCapacity] = {open.began,
                               now,
                               open.frame,
                               open.wall,
                               open.node,
                               open.what,
                               static_cast<std::uint8_t>(depth_),
                               static_cast<std::uint32_t>(took - std::min(took, open.within))};
    head_.store(head + 1, std::memory_order_release);
  }
  /// The frame and wall of the span that is under way.
  std::uint64_t frame() const { return depth_ > 0 ? open_[std::min(depth_, kDeepest) - 1].frame : kNoFrame; }
  std::uint32_t wall() const { return depth_ > 0 ? open_[std::min(depth_, kDeepest) - 1].wall : kNoWall; }
  /// How long the last span of that kind took [ms].
  double last(Span what) const { return 1e-6 * static_cast<double>(last_[static_cast<std::size_t>(what)]); }

  /// The next record, if there is one.
  bool take(SpanRecord& out) {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) return false;
    out = ring_[tail % kCapacity];
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }
  /// Records for which there was no room, because nobody collected.
  std::uint64_t lost() const { return lost_.load(std::memory_order_relaxed); }

private:
  static std::uint64_t nanoseconds(ProfileClock::duration d) {
    return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(d).count());
  }
  struct Open {
    Span what = Span::App;
    std::uint64_t frame = kNoFrame;
    std::uint32_t wall = kNoWall;
    NodeRef node;
    std::uint64_t within = 0;  ///< [ns] that its parts took
    ProfileClock::time_point began;
  };

  std::array<Open, kDeepest> open_;
  std::size_t depth_ = 0;
  std::array<std::uint64_t, kSpans> last_{};
  std::vector<SpanRecord> ring_;
  std::atomic<std::size_t> head_ = 0, tail_ = 0;
  std::atomic<std::uint64_t> lost_ = 0;
};

}  // namespace stadion
