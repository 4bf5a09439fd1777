#pragma once
/// The memory of pairs: which sides touch, and which reported impact awaits its release.

#include "dynamics/body/body.h"

#include <map>
#include <set>
#include <utility>
#include <vector>

namespace stadion {

struct RigidBody;

/// Closing speeds up to this are contact, not impact [m/s].
constexpr double kImpactSpeed = 0.05;

class ContactMemory {
public:
  using Key = std::pair<ContactSide, BodyId>;
  static Key keyOf(ContactSide a,
                   ContactSide b);  ///< at least one side is a body; the body with the greater id comes last

  /// Forgets the last frame's events and tells what has been owed since.
  void beginFrame();
  struct Waiting;
  /// A separated pair fires if it closes fast enough: it waits for its release then, if that is asked for.
  Waiting* impact(const Key& pair, Nanoseconds time, const Vec3& point, const Vec3& normal, double speed,
                  double impulse, std::uint64_t frame, bool awaited);
  /// The pair is in lasting contact (or no longer).
  void setTouching(const Key& pair, bool touching);
  bool touching(const Key& pair) const;
  void release(const Key& pair, Nanoseconds time);
  /// The same, but the report comes in the next frame.
  void releaseLater(const Key& pair, Nanoseconds time);
  /// Returns the pair if its release has yet to be reported, else null.
  Waiting* waitingOf(const Key& pair);
  void forget(ContactSide gone);

  /// A pair whose impact has been told and whose release has not.
  struct Waiting {
    Key pair;
    std::uint64_t frame = 0;  ///< frame of the last reported impact
    // For the sake of speed only:
    Nanoseconds look = 0;        ///< time before which the pair cannot part unless an arc changes ...
    std::uint32_t versions = 0;  ///< ... from these, in sum
    const std::uint32_t *versionA = nullptr, *versionB = nullptr;  ///< the present versions of both sides
    std::int32_t triangle = -1;                                    ///< triangle of a mesh that was near
    bool sure = false;     ///< at `look` the pair is as far apart as it must be from the side that was near
    bool byWay = false;    ///< `look` follows from `slack` and how fast the pair can go
    Nanoseconds seen = 0;  ///< up to then it has not parted ...
    double slack = 0;      ///< ... and after that it must go so far to do so [m]

    /// Returns how far the pair must at least go after `time` to part [m]. Expects that no arc has changed
    /// between the last look and `time`.
    double slackAt(Nanoseconds time) const;

    template <class Self, class Fields>
    static void fields(Self& w, Fields& f) {
      f("pair", w.pair), f("frame", w.frame), f("look", w.look), f("versions", w.versions);
      f("triangle", w.triangle), f("sure", w.sure), f("seen", w.seen), f("slack", w.slack),
          f("by way", w.byWay);
    }
  };
  /// Equal for equal memories, up to chance; costs nothing.
  std::uint64_t digest() const { return digest_; }
  /// In no order. What decides when to look may be changed.
  std::vector<Waiting>& waiting() { return waiting_; }
  /// f(key) for all pairs with this key. f must not change them.
  template <class F>
  void eachWith(ContactSide p, F f) const {
    for (auto m = memory_.lower_bound({p, 0}); m != memory_.end() && m->first.first == p; ++m)
      if (!m->second.idle()) f(m->first);
    if (!p.isBody) return;
    for (auto o = others_.lower_bound({p.id, {}}); o != others_.end() && o->first == p.id; ++o)
      if (const Key key{o->second, p.id}; !memory_.find(key)->second.idle()) f(key);
  }
  std::vector<ContactEvent>& events() { return events_; }
  const std::vector<ContactEvent>& events() const { return events_; }

  /// Saves or restores all but the events. Of those that wait, what is said of versions is
  /// asked for again: `versionOf(key)` points at it.
  template <class Fields, class VersionOf>
  void state(Fields& f, const VersionOf& versionOf) {
    f("pairs", memory_), f("idle", idle_), f("digest", digest_);
    f("waiting", waiting_), f("owed", owed_);
    for (Waiting& w : waiting_) {
      bool foreseen = w.versionA != nullptr;
      f("foreseen", foreseen);
      if (!f.restores() || !foreseen) continue;
      w.versionA = versionOf(w.pair.first);
      w.versionB = versionOf({true, w.pair.second});
      if (!w.versionA || !w.versionB) return f.fail();
    }
    if (!f.restores()) return;
    events_.clear();
    others_.clear();
    for (const auto& [pair, m] : memory_) {
      others_.emplace(pair.second, pair.first);
      if (m.waiting != kNowhere && (m.waiting >= waiting_.size() || waiting_[m.waiting].pair != pair))
        return f.fail();
    }
  }

private:
  static constexpr std::uint32_t kNowhere = 0xffffffff;
  struct Memory {
    bool touching = false;             ///< in lasting contact, or touched since load
    std::uint32_t waiting = kNowhere;  ///< where in waiting_: its release is due
    Nanoseconds impact = 0;            ///< when [ns]
    std::uint64_t share = 0;           ///< part of this pair in the digest
    bool idle() const { return !touching && waiting == kNowhere; }

    template <class Self, class Fields>
    static void fields(Self& m, Fields& f) {
      f("touching", m.touching), f("waiting", m.waiting), f("impact", m.impact), f("share", m.share);
    }
  };
  /// Returns the part of a pair in the digest.
  static std::uint64_t share(const Key& pair, const Memory& m);
  /// change(memory) of a pair, known or not. One with nothing to remember stays for a while: it may soon
  /// touch again.
  template <class F>
  void update(const Key& pair, F change);
  void leave(Memory& m);
  void erase(const Key& pair);
  void forgetIdle();

  std::map<Key, Memory> memory_;
  std::size_t idle_ = 0;      ///< number of pairs in memory_ that remember nothing
  std::uint64_t digest_ = 0;  ///< a sum over the others
  std::vector<Waiting> waiting_;
  std::set<std::pair<BodyId, ContactSide>> others_;  ///< the pairs of memory_, by body
  std::vector<ContactEvent> events_;
  struct Owed {
    Key pair;
    Nanoseconds time = 0;

    template <class Self, class Fields>
    static void fields(Self& o, Fields& f) {
      f("pair", o.pair), f("time", o.time);
    }
  };
  static std::uint64_t share(const Owed& owed);
  std::vector<Owed> owed_;  ///< releases in the frame of their impact
};

/// The memory notes what the body touches from now on, `near`, and what it no longer does.
void rememberTouching(ContactMemory& memory, RigidBody& b, const std::vector<ContactSide>& near);

}  // namespace stadion
