#pragma once
/// Sorts draw lists by what things are, so that their order does not depend on where records lie: opaque ones
/// by mesh, level and the eyes that see them, then near to far; transparent ones far to near. Who is equal in
/// that goes by owner, then by place.
///
/// Numbers are sorted, byte by byte from the lowest (radix sort; bytes that are the same in all are passed
/// over), and each item is moved once.
///
/// Threads  one at a time; keeps its memory.

#include "pipeline/draw/draw_list.h"

#include <array>
#include <vector>

namespace stadion {

class DrawOrder {
public:
  void sort(DrawList& list);

private:
  /// `high` first, then `low`; neither is negative as a float.
  struct Key {
    std::uint64_t high;
    std::uint32_t low;
    std::uint32_t item;

    bool operator<(const Key& o) const { return high < o.high || (high == o.high && low < o.low); }
    std::size_t byte(std::size_t k) const { return (k < 4 ? low >> (8 * k) : high >> (8 * (k - 4))) & 255; }
  };
  static constexpr std::size_t kBytes = 12;

  void arrange(std::vector<DrawItem>& items);
  void sortKeys();
  void sortAlike(const std::vector<DrawItem>& items);

  std::vector<Key> keys_, spare_;
  std::vector<DrawItem> moved_;
  std::array<std::array<std::uint32_t, 256>, kBytes> counts_;
};

}  // namespace stadion
