#include "pipeline/state/extents.h"

#include <algorithm>

namespace stadion {

std::size_t Extents::take(std::size_t bytes) {
  const auto at =
      std::find_if(free_.begin(), free_.end(), [bytes](const auto& f) { return f.second >= bytes; });
  if (at == free_.end()) {
    const std::size_t offset = end_;
    end_ += bytes;
    return offset;
  }
  const auto [offset, size] = *at;
  free_.erase(at);
  if (size > bytes) free_[offset + bytes] = size - bytes;
  return offset;
}

void Extents::giveBack(std::size_t offset, std::size_t bytes) {
  const auto after = free_.lower_bound(offset);
  if (after != free_.end() && after->first == offset + bytes) {
    bytes += after->second;
    free_.erase(after);
  }
  if (auto before = free_.lower_bound(offset); before != free_.begin()) {
    --before;
    if (before->first + before->second == offset) {
      before->second += bytes;
      return;
    }
  }
  free_[offset] = bytes;
}

}  // namespace stadion
