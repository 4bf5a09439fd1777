#pragma once
/// Which stretches of a growing segment are in use: first fit, neighbours that are free become one.
///
/// Threads  plain data; whoever owns it locks.

#include <cstddef>
#include <map>

namespace stadion {

class Extents {
public:
  /// Where `bytes` are free from now on taken. The segment must reach to end().
  std::size_t take(std::size_t bytes);
  /// Gives back what was taken there, all of it.
  void giveBack(std::size_t offset, std::size_t bytes);

  std::size_t end() const { return end_; }  ///< behind everything that has ever been in use

private:
  std::map<std::size_t, std::size_t> free_;  ///< offset to bytes
  std::size_t end_ = 0;
};

}  // namespace stadion
