#pragma once
/// The events of one window, by time: commands, touches, ends of arcs and ticks of the contact solver.
///
/// Times     tau is seconds since the start of the window (world_time.h).
/// Order     by tau, then in the order of posting.
/// Versions  an event of a body or collider carries the version of its motion. If that has changed, the event
///           is void; the world checks this when the event is due.

#include "dynamics/collision/touch.h"

#include <cstdint>
#include <queue>
#include <vector>

namespace stadion {

class EventQueue {
public:
  struct Event {
    enum class Kind : std::uint8_t { Command, Touch, Horizon, Tick };
    friend constexpr Kind lastOf(Kind) { return Kind::Tick; }
    double tau = 0;           ///< [s]
    std::uint64_t order = 0;  ///< number in the order of posting
    Kind kind = Kind::Touch;
    ContactSide a, b;
    std::uint32_t versionA = 0, versionB = 0;
    std::uint32_t detail = 0;  ///< index of the touch, or number of the tick
    /// Reversed, so that the first event is at the top of the heap.
    bool operator<(const Event& o) const { return tau != o.tau ? tau > o.tau : order > o.order; }
  };

  bool empty() const { return queue_.empty(); }
  const Event& first() const { return queue_.top(); }
  void pop() { queue_.pop(); }
  const Touch& touchOf(const Event& e) const { return touches_[e.detail]; }

  /// Forgets all events and the scheduled tick.
  void clear() {
    queue_ = {};
    touches_.clear();
    tickAt_ = kNone;
  }
  /// A number greater than all before; commands share it with events.
  std::uint64_t takeOrder() { return nextOrder_++; }
  void postCommand(double tau) {
    Event e;
    e.tau = tau;
    e.kind = Event::Kind::Command;
    post(e);
  }
  /// The motion of `p` ends at tau, or turns.
  void postHorizon(double tau, ContactSide p, std::uint32_t version) {
    Event e;
    e.tau = tau;
    e.kind = Event::Kind::Horizon;
    e.a = p;
    e.versionA = version;
    post(e);
  }
  void postTouch(double tau, const Side& a, const Side& b, const Touch& touch) {
    Event e;
    e.tau = tau;
    e.kind = Event::Kind::Touch;
    e.a = a.key;
    e.b = b.key;
    e.versionA = a.version();
    e.versionB = b.version();
    e.detail = static_cast<std::uint32_t>(touches_.size());
    touches_.push_back(touch);
    post(e);
  }
  /// Only the earliest tick counts.
  void scheduleTick(double tau) {
    if (tickAt_ >= 0 && tickAt_ <= tau) return;
    ++tickNumber_;
    tickAt_ = tau;
    Event e;
    e.tau = tau;
    e.kind = Event::Kind::Tick;
    e.detail = tickNumber_;
    post(e);
  }
  /// Returns true if a tick event is the scheduled one.
  bool isScheduled(const Event& tick) const { return tick.detail == tickNumber_ && tickAt_ >= 0; }
  void beginTick() { tickAt_ = kNone; }

  /// Counters, to be saved or restored.
  template <class Fields>
  void stateOfOrder(Fields& f) {
    f("next order", nextOrder_);
  }
  template <class Fields>
  void stateOfTick(Fields& f) {
    f("tick number", tickNumber_), f("tick", tickAt_);
  }
  /// The events, in their order, which does not depend on how the heap keeps them.
  template <class Fields>
  void state(Fields& f) {
    f("touches", touches_);
    std::vector<Event> events;
    for (auto left = queue_; !left.empty(); left.pop()) events.push_back(left.top());
    const std::size_t n = f.count("events", events.size());
    if (f.restores()) {
      events.assign(n, {});
      queue_ = {};
    }
    for (Event& e : events) {
      f("tau", e.tau), f("order", e.order), f("kind", e.kind), f("a", e.a), f("b", e.b);
      f("version a", e.versionA), f("version b", e.versionB), f("detail", e.detail);
      if (e.kind == Event::Kind::Touch && e.detail >= touches_.size()) return f.fail();
      if (f.restores()) queue_.push(e);
    }
  }

private:
  static constexpr double kNone = -1;
  void post(Event e) {
    e.order = nextOrder_++;
    queue_.push(e);
  }

  std::priority_queue<Event> queue_;
  std::vector<Touch> touches_;
  std::uint64_t nextOrder_ = 0;
  std::uint32_t tickNumber_ = 0;
  double tickAt_ = kNone;  ///< tau of the scheduled tick [s]
};

}  // namespace stadion
