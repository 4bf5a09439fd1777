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
  /// A separated pair fires if it closes fast enough.
  void impact(const Key& pair, Nanoseconds time, const Vec3& point, const Vec3& normal, double speed,
              double impulse, std::uint64_t frame);
  /// The pair is in lasting contact (or no longer).
  void setTouching(const Key& pair, bool touching);
  bool touching(const Key& pair) const;
  void release(const Key& pair, Nanoseconds time);
  void forget(Party gone);

  struct Memory {
    bool touching = false, fired = false;
    Nanoseconds impact = 0;
    std::uint64_t frame = 0;  ///< of the last reported impact
    Nanoseconds look = 0;     ///< before that it cannot be released unless an arc changes ...
    std::uint32_t versionA = 0, versionB = 0;  ///< ... from these [ns]
  };
  const std::map<Key, Memory>& all() const { return memory_; }
  std::map<Key, Memory>& all() { return memory_; }
  std::vector<ContactEvent>& events() { return events_; }
  const std::vector<ContactEvent>& events() const { return events_; }

private:
  Memory& at(const Key& pair);
  void erase(const Key& pair);

  std::map<Key, Memory> memory_;
  std::set<std::pair<BodyId, Party>> others_;  ///< the same pairs by their body
  std::vector<ContactEvent> events_;
};

}  // namespace stadion
