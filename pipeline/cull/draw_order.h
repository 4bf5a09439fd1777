#pragma once
/// Sorts what is drawn by what it is, so that its order does not depend on where records lie: opaque things
/// by mesh, level and the views that see them, then near to far; transparent ones by owner, then by mesh, so
/// that surfaces at the same depth keep their order wherever the visitor is. Ties are ordered by owner, then
/// by place.
///
/// Numbers are sorted, byte by byte from the lowest (radix sort; bytes that are the same in all are passed
/// over), and each thing is moved once.
///
/// Threads  one at a time; keeps its memory.

#include "engine/published/records.h"
#include "pipeline/draw_list/draw_list.h"

#include <array>
#include <vector>

namespace stadion {

/// A record that a wall draws, and as what.
struct DrawnRecord {
  const InstanceRecord* record = nullptr;
  MeshId mesh = kNoMesh;    ///< the record's
  float distance = 0;       ///< see DrawItem
  std::uint32_t level = 0;  ///< likewise
  std::uint32_t views = 0;  ///< likewise
};

class DrawOrder {
public:
  void sortOpaque(std::vector<DrawnRecord>& things);
  void sortTransparent(std::vector<DrawnRecord>& things);

private:
  /// `high` first, then `low`; no distance is negative.
  struct Key {
    std::uint64_t high;
    std::uint32_t low;
    std::uint32_t thing;

    bool operator<(const Key& o) const { return high < o.high || (high == o.high && low < o.low); }
    std::size_t byte(std::size_t k) const { return (k < 4 ? low >> (8 * k) : high >> (8 * (k - 4))) & 255; }
  };
  static constexpr std::size_t kBytes = 12;

  void arrange(std::vector<DrawnRecord>& things);
  void sortKeys();
  void sortAlike(const std::vector<DrawnRecord>& things);

  std::vector<Key> keys_, spare_;
  std::vector<DrawnRecord> moved_;
  std::array<std::array<std::uint32_t, 256>, kBytes> counts_;
};

}  // namespace stadion
