#pragma once
/// The paints of a scene, by number. Equal paints have the same number.
///
/// A painted instance carries a number, and the later stages find the paint here. All paints are published
/// together, in each frame in which one of them has changed.
///
/// Threads  App only.
/// Errors   numbers are the caller's to keep. Beyond kMostPaints at a time add() returns 0: such a model
///          keeps the materials of its file.

#include "engine/published/paint.h"

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace stadion {

struct ChangeSet;
class StateFields;

class PaintTable {
public:
  using Number = std::uint16_t;

  // For nodes.

  /// Counts one more user of a paint. The number depends only on the paints that are in use.
  Number add(const Paint& paint);
  /// Counts one user less. 0 counts for none.
  void remove(Number number);
  /// Returns true if the number is in use for this paint; nodes ask this when they are restored.
  bool holds(Number number, const Paint& paint) const;

  // For the scene.

  void publish(ChangeSet& changes);
  void state(StateFields& f);
  /// After state() has restored: publishes all. False: the restored paints cannot be.
  bool resume();

private:
  struct Entry {
    Paint paint;
    std::uint64_t users = 0;

    template <class Self, class Fields>
    static void fields(Self& e, Fields& f) {
      f("paint", e.paint), f("users", e.users);
    }
  };
  using Key = std::array<double, 7>;
  static Key keyOf(const Paint& paint);

  std::vector<Entry> all_;            ///< by number - 1
  std::map<Key, Number> numbers_;     ///< of paints in use
  std::set<Number> free_;             ///< numbers in all_ that are not in use
  std::vector<PaintRecord> records_;  ///< by number - 1
  bool changed_ = false;
};

}  // namespace stadion
