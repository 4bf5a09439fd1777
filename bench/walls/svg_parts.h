#pragma once
/// Pieces of the plots of `stadion bench walls`.
///
/// Units    pixels.
/// Threads  plain functions.

#include <string>
#include <string_view>
#include <vector>

namespace stadion::bench {

/// A whole picture on white.
std::string svgPicture(double width, double height, const std::string& content);
/// `anchor`: start, middle or end. XML's special characters are escaped.
std::string svgText(double x, double y, const char* anchor, std::string_view what, const char* more = "");
std::string svgLine(double x1, double y1, double x2, double y2, const char* style);
std::string svgBox(double x, double y, double width, double height, const char* colour);

/// A logarithmic axis that ends at powers of ten.
struct LogAxis {
  int first = 0, last = 1;  ///< decades
  double from = 0, to = 1;  ///< [px]
  double at(double value) const;
};
LogAxis logAxis(const std::vector<double>& values, double from, double to);

}  // namespace stadion::bench
