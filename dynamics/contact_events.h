#pragma once
/// The memory of pairs: who touches whom, which impact has been told and awaits its release.

#include "dynamics/world.h"

#include <map>
#include <set>
#include <utility>

namespace stadion {

/// Closing speeds up to this are contact, not impact [m/s].
constexpr double kImpactSpeed = 0.05;

class ContactMemory {
public:
  using Key = std::pair<Party, BodyId>;
  static Key keyOf(Party a,
                   Party b);  ///< at least one side is a body; the body with the greater id comes last

  void beginFrame() { events_.clear(); }
  /// A separated pair fires if it closes fast enough: true then.
  bool impact(const Key& pair, Nanoseconds time, const Vec3& point, const Vec3& normal, double speed,
              double impulse, std::uint64_t frame);
  /// The pair is in lasting contact (or no longer).
  void setTouching(const Key& pair, bool touching);
  bool touching(const Key& pair) const;
  void release(const Key& pair, Nanoseconds time);
  void forget(Party gone);

  struct Memory {
    bool touching = false;    ///< in lasting contact, or touched since load
    bool fired = false;       ///< an impact was told and its release is due
    Nanoseconds impact = 0;   ///< when [ns]
    std::uint64_t frame = 0;  ///< of the last reported impact
    Nanoseconds look = 0;     ///< before that it cannot be released unless an arc changes ...
    std::uint32_t versionA = 0, versionB = 0;  ///< ... from these
    std::int32_t triangle = -1;                ///< of a mesh, that was near at the last look
  };
  /// Equal for equal memories, up to chance; costs nothing.
  std::uint64_t digest() const { return digest_; }
  /// Those whose impact has been told and whose release has not. Of them only what is kept for the sake of
  /// speed may be changed.
  const std::map<Key, Memory*>& fired() const { return fired_; }
  /// f(key) for all pairs with this party. f must not change them.
  template <class F>
  void eachWith(Party p, F f) const {
    for (auto m = memory_.lower_bound({p, 0}); m != memory_.end() && m->first.first == p; ++m) f(m->first);
    if (!p.isBody) return;
    for (auto o = others_.lower_bound({p.id, {}}); o != others_.end() && o->first == p.id; ++o)
      f(Key{o->second, p.id});
  }
  std::vector<ContactEvent>& events() { return events_; }
  const std::vector<ContactEvent>& events() const { return events_; }

private:
  /// change(memory) of a pair, known or not; forgotten if nothing is left to remember.
  template <class F>
  void update(const Key& pair, F change);
  void erase(const Key& pair);

  std::map<Key, Memory> memory_;
  std::uint64_t digest_ = 0;  ///< a sum over the pairs
  std::map<Key, Memory*> fired_;
  std::set<std::pair<BodyId, Party>> others_;  ///< the same pairs by their body
  std::vector<ContactEvent> events_;
};

}  // namespace stadion
