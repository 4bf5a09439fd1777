#include "bench/walls/svg_parts.h"

#include "engine/plain_text/markup_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stadion::bench {

std::string svgPicture(double width, double height, const std::string& content) {
  return fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 {0:.0f} "
      "{1:.0f}' font-family='sans-serif' font-size='12'>\n<rect width='{0:.0f}' height='{1:.0f}' "
      "fill='white'/>\n{2}</svg>\n",
      width, height, content);
}

std::string svgText(double x, double y, const char* anchor, std::string_view what, const char* more) {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}' {}>{}</text>\n", x, y, anchor, more,
                     markupText(what));
}

std::string svgLine(double x1, double y1, double x2, double y2, const char* style) {
  return fmt::format("<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' {}/>\n", x1, y1, x2, y2, style);
}

std::string svgBox(double x, double y, double width, double height, const char* colour) {
  return fmt::format("<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='{}'/>\n", x, y,
                     std::max(0.0, width), height, colour);
}

double LogAxis::at(double value) const {
  return from + (std::log10(value) - first) / (last - first) * (to - from);
}

LogAxis logAxis(const std::vector<double>& values, double from, double to) {
  if (values.empty()) return {0, 1, from, to};
  const auto [least, most] = std::ranges::minmax_element(values);
  const int first = static_cast<int>(std::floor(std::log10(*least)));
  const int last = static_cast<int>(std::ceil(std::log10(*most)));
  return {first, std::max(last, first + 1), from, to};
}

}  // namespace stadion::bench
