#include "bench/flight/trajectory_plot.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stadion::bench {
namespace {

constexpr double kWidth = 1100, kLeft = 60, kRight = 900, kTop = 60, kGap = 70;  ///< [px]
constexpr const char* kColours[] = {"#888888", "#c00000", "#1f77b4", "#2ca02c", "#ff7f0e",
                                    "#9467bd", "#17becf", "#8c564b", "#e377c2"};

/// One view: x to the right, another coordinate upwards.
struct View {
  int up;                    ///< 1 = y, 2 = z
  double low, high, bottom;  ///< [m], [px]
  double scale;              ///< [px/m]
  double px(const Vec3& p) const { return kLeft + scale * p.x(); }
  double py(const Vec3& p) const { return bottom - scale * (p[up] - low); }
};

std::string text(double x, double y, const std::string& anchor, const std::string& what) {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}'>{}</text>\n", x, y, anchor, what);
}

std::string line(double x1, double y1, double x2, double y2, const std::string& style) {
  return fmt::format("<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' {}/>\n", x1, y1, x2, y2, style);
}

std::string gridOf(const View& v, double far, double each, const char* name) {
  std::string svg;
  const double top = v.bottom - v.scale * (v.high - v.low);
  for (double x = 0; x <= far; x += each)
    svg += line(kLeft + v.scale * x, top, kLeft + v.scale * x, v.bottom, "stroke='#e4e4e4'") +
           text(kLeft + v.scale * x, v.bottom + 16, "middle", fmt::format("{:g}", x));
  for (double y = std::ceil(v.low / each) * each + 0.0; y <= v.high; y += each) {
    const double py = v.bottom - v.scale * (y - v.low);
    svg += line(kLeft, py, kLeft + v.scale * far, py, "stroke='#e4e4e4'") +
           text(kLeft - 8, py + 4, "end", fmt::format("{:g}", y + 0.0));
  }
  return svg + text(kLeft, top - 8, "start", name);
}

/// The body every half second, 3 m long so that it can be seen: a rod along its axis, a plate across it.
std::string attitudeOf(const Trajectory& path, const View& v, int axis) {
  std::string svg;
  double next = 0;
  for (const TrajectorySample& s : path) {
    if (s.t < next - 1e-9) continue;
    next = s.t + 0.5;
    const Vec3 k = s.at.q * Vec3::Unit(axis);
    const Vec3 d = 1.5 * (axis == 2 ? Vec3(k.cross(Vec3::Unit(3 - v.up))) : k), a = s.at.p - d,
               b = s.at.p + d;
    svg += line(v.px(a), v.py(a), v.px(b), v.py(b), "stroke='#222' stroke-width='2.5'");
  }
  return svg;
}

std::string drawPath(const Trajectory& path, const View& v, const char* colour, bool exact) {
  std::string points;
  for (const TrajectorySample& s : path) points += fmt::format("{:.1f},{:.1f} ", v.px(s.at.p), v.py(s.at.p));
  return fmt::format("<polyline points='{}' fill='none' stroke='{}' stroke-width='{}'/>\n", points, colour,
                     exact ? 6 : 1.6);
}

View viewOf(const std::vector<DrawnFlight>& flights, int up, double scale, double top) {
  double low = 0, high = 1;
  for (const DrawnFlight& f : flights)
    for (const TrajectorySample& s : f.path) {
      low = std::min(low, s.at.p[up]);
      high = std::max(high, s.at.p[up]);
    }
  if (up == 1) {
    low -= 1;
    high += 1;
  }
  return {up, low, high + 0.5, top + scale * (high + 0.5 - low), scale};
}

}  // namespace

std::string trajectoryPlot(const std::string& title, const std::vector<DrawnFlight>& flights, int axis) {
  double far = 1;
  for (const DrawnFlight& f : flights)
    for (const TrajectorySample& s : f.path) far = std::max(far, s.at.p.x());
  const double each = far > 40 ? 10 : 5;
  far = std::ceil(far / each) * each;
  const double scale = (kRight - kLeft) / far;
  const View side = viewOf(flights, 2, scale, kTop + 20),
             above = viewOf(flights, 1, scale, side.bottom + kGap);
  const double height = above.bottom + 40;
  std::string svg =
      fmt::format("<svg xmlns='http://www.w3.org/2000/svg' width='{0}' height='{1:.0f}' viewBox='0 0 {0} "
                  "{1:.0f}' font-family='sans-serif' font-size='12'>\n<rect width='{0}' height='{1:.0f}' "
                  "fill='white'/>\n",
                  kWidth, height);
  svg += fmt::format("<text x='{}' y='28' font-size='16'>{}</text>\n", kLeft, title);
  svg += gridOf(side, far, each, "from the side [m]") + gridOf(above, far, each, "from above [m]");
  for (std::size_t i = 0; i < flights.size(); ++i) {
    const char* colour = kColours[i % std::size(kColours)];
    for (const View* v : {&side, &above}) {
      svg += drawPath(flights[i].path, *v, colour, i == 0);
      if (i == 0 && axis >= 0) svg += attitudeOf(flights[i].path, *v, axis);
    }
    const double y = kTop + 24 + 20 * static_cast<double>(i);
    const Vec3 end = flights[i].path.back().at.p;
    svg += line(kRight + 20, y - 4, kRight + 45, y - 4,
                fmt::format("stroke='{}' stroke-width='{}'", colour, i ? 2 : 6)) +
           text(kRight + 52, y, "start",
                fmt::format("{} {:.1f} m", flights[i].name, std::hypot(end.x(), end.y())));
  }
  return svg + "</svg>\n";
}

}  // namespace stadion::bench
