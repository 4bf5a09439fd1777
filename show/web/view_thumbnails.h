#pragma once
/// Small pictures of all views, as PNG files in memory.
///
/// A thread of its own asks for one view after the other, makes the pictures small and keeps the newest of each view. It
/// asks only while a page shows the views: up to some seconds after its last request.
///
/// Ownership  borrows the tap.
/// Threads    the functions from any; its thread runs with yieldToShow().

#include "show/web/view_tap.h"

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace stadion {

class ViewThumbnails {
public:
  static constexpr std::uint32_t kWidth = 320;             ///< of a thumbnail, at most [pixels]
  static constexpr std::chrono::milliseconds kEvery{250};  ///< between two views
  static constexpr std::chrono::seconds kLooks{5};         ///< so long after a look it asks for pictures

  explicit ViewThumbnails(ViewTap& tap);
  ~ViewThumbnails();
  ViewThumbnails(const ViewThumbnails&) = delete;
  ViewThumbnails& operator=(const ViewThumbnails&) = delete;

  /// The number of views, by wall.
  void setViews(std::vector<std::size_t> views);
  /// A page shows the views.
  void look();
  /// Returns the newest picture; empty: there is none yet.
  std::string png(std::size_t wall, std::size_t view) const;
  /// Returns a number that grows with each new picture of the view; 0: there is none yet.
  std::uint64_t version(std::size_t wall, std::size_t view) const;

private:
  using Clock = std::chrono::steady_clock;
  using Place = std::pair<std::size_t, std::size_t>;  ///< wall, view
  struct Kept {
    std::string png;
    std::uint64_t version = 0;
  };

  void work();
  std::optional<Place> next();

  ViewTap& tap_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Place> places_;
  std::size_t turn_ = 0;
  std::map<Place, Kept> kept_;
  Clock::time_point looked_{};
  bool ending_ = false;
  std::thread thread_;
};

/// Returns the picture in at most that width, each pixel the mean of those that it covers.
Picture madeSmall(const Picture& picture, std::uint32_t width);

}  // namespace stadion
