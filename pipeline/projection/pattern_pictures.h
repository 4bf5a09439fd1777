#pragma once
/// The test pattern of each wall, in the size of its picture, for a show that is running.
///
/// In a live show a thread of its own makes the pictures when they are first wanted, and the walls keep showing the show
/// until they are there. Where every frame counts, the caller waits for them instead.
///
/// Ownership  copies the walls.
/// Threads    copyTo() on the Draw threads, one for each wall.
/// Errors     a hall whose pattern cannot be made has none: copyTo() returns false.

#include "pipeline/projection/hall_patterns.h"

#include <atomic>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <thread>
#include <utility>
#include <vector>

namespace stadion {

class PatternPictures {
public:
  PatternPictures(const WallFile& walls, bool stereo) : walls_(walls), stereo_(stereo) {}
  ~PatternPictures();
  PatternPictures(const PatternPictures&) = delete;
  PatternPictures& operator=(const PatternPictures&) = delete;

  /// Replaces `pictures` by those of the wall's pattern, for pictures of that size. Returns false if there are none
  /// yet; if `waits`, it makes them first.
  bool copyTo(std::vector<Picture>& pictures, std::size_t wall, std::uint32_t width, std::uint32_t height,
              bool waits);

private:
  struct Place {
    std::size_t wall;
    std::uint32_t width, height;
    auto operator<=>(const Place&) const = default;
  };

  std::vector<Picture> make(const Place& place);
  void work();

  const WallFile walls_;
  const bool stereo_;
  std::mutex mutex_;
  std::condition_variable asked_;
  std::set<Place> wanted_;
  std::map<Place, std::vector<Picture>> made_;
  bool ending_ = false;
  std::thread thread_;  ///< begins when a picture is first wanted

  std::mutex making_;  ///< guards the members below
  std::unique_ptr<HallPatterns> patterns_;
  bool failed_ = false;
};

}  // namespace stadion
