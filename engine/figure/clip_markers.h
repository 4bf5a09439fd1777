#pragma once
/// The markers of a figure's clips: moments at which something is to happen, such as a foot that lands.
///
/// Threads  constant after construction.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stadion {

class ClipMarkers {
public:
  struct Marker {
    std::uint32_t clip = 0;
    double at = 0;  ///< time of the clip, from 0 to its length [s]
  };

  ClipMarkers() = default;
  /// Markers at one time keep their order.
  explicit ClipMarkers(std::vector<Marker> markers);

  const Marker& operator[](std::size_t number) const { return markers_[number]; }
  std::size_t size() const { return markers_.size(); }
  /// The numbers of a clip's markers in the order in which it passes them.
  std::span<const std::size_t> of(std::uint32_t clip, bool backwards) const;

private:
  std::vector<Marker> markers_;
  std::vector<std::vector<std::size_t>> forwards_, backwards_;  ///< by clip
};

}  // namespace stadion
