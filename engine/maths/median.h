#pragma once
/// The median of figures.
///
/// Threads  a plain function.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace stadion {

/// The middle value, or the mean of the two middle ones; 0 if there is none. Values that are not finite are left out.
inline double median(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty()) return 0;
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

}  // namespace stadion
