#pragma once
/// The pattern of a hall while it is adjusted, with marks on what is chosen.
///
/// A change shows at once in the picture that it moves. Neighbours share their light with it, so their pictures are
/// made again, too, one after the other when there is time.
///
/// Threads  one at a time; works on threads of its own.

#include "pipeline/projection/hall_patterns.h"
#include "show/adjust/hall_adjuster.h"

#include <deque>
#include <memory>
#include <vector>

namespace stadion {

class AdjustPictures {
public:
  /// Fails as HallPatterns does.
  static Result<std::unique_ptr<AdjustPictures>> create(const WallFile& hall, HallPattern pattern,
                                                        bool stereo);

  /// Notes that the picture of an entry is another now.
  void change(const WallFile& hall, std::size_t entry);
  /// Makes one of the noted pictures ready, the changed ones first. Returns its entry; nothing: none is left.
  std::optional<std::size_t> refresh(const WallFile& hall);

  /// Returns the pictures of an entry for its eyes; those of a flat wall have this size.
  std::vector<Picture> pictures(const HallAdjuster& adjuster, std::size_t entry, std::uint32_t width,
                                std::uint32_t height);

private:
  AdjustPictures(std::unique_ptr<HallPatterns> patterns, HallPattern pattern, std::size_t entries)
      : patterns_(std::move(patterns)), pattern_(pattern), plain_(entries) {}

  std::unique_ptr<HallPatterns> patterns_;
  HallPattern pattern_;
  std::vector<std::vector<Picture>> plain_;  ///< by entry, without marks; empty: to be made
  std::deque<std::size_t> stale_;            ///< entries
};

}  // namespace stadion
