#pragma once
/// Allocates stretches of a growing segment: first fit; free neighbours are merged.
///
/// Threads  plain data; the owner locks.

#include <cstddef>
#include <map>

namespace stadion {

class Extents {
public:
  /// Takes `bytes` and returns their offset. The segment must reach to end().
  std::size_t take(std::size_t bytes);
  /// Frees a whole stretch that take() returned.
  void giveBack(std::size_t offset, std::size_t bytes);

  std::size_t end() const { return end_; }  ///< end of all stretches that were ever in use

private:
  std::map<std::size_t, std::size_t> free_;  ///< offset to bytes
  std::size_t end_ = 0;
};

}  // namespace stadion
