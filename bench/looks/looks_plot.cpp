#include "bench/looks/looks_plot.h"

#include "bench/walls/svg_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stadion::bench {
namespace {

constexpr double kWidth = 900, kHeight = 560;
constexpr double kLeft = 80, kRight = 680, kTop = 50, kBottom = 490;
constexpr double kLeastError = 1e-3;  ///< lesser ones are drawn there
constexpr const char* kGrid = "stroke='#ddd'";

std::string seriesName(const LooksRow& row) {
  return row.scene + ", " + row.wall;
}

const char* colourOf(std::size_t series) {
  static constexpr const char* kColours[] = {"#c00000", "#1f77b4", "#17becf", "#2ca02c", "#8c564b",
                                             "#9467bd", "#ff7f0e", "#7f7f7f", "#bcbd22", "#e377c2"};
  return kColours[series % std::size(kColours)];
}

std::string gridOf(const LogAxis& cost, const LogAxis& error) {
  std::string svg;
  for (int d = cost.first; d <= cost.last; ++d) {
    const double x = cost.at(std::pow(10, d));
    svg += svgLine(x, kTop, x, kBottom, kGrid) +
           svgText(x, kBottom + 18, "middle", fmt::format("{:g}", std::pow(10, d)));
  }
  for (int d = error.first; d <= error.last; ++d) {
    const double y = error.at(std::pow(10, d));
    svg += svgLine(kLeft, y, kRight, y, kGrid) +
           svgText(kLeft - 8, y + 4, "end", fmt::format("{:g}", std::pow(10, d)));
  }
  svg += svgText((kLeft + kRight) / 2, kBottom + 42, "middle", "processor time a view [ms]");
  return svg + svgText(kLeft, kTop - 10, "start", "mean difference from 64 samples a pixel [of 255]");
}

std::string dotOf(const LooksRow& row, const LogAxis& cost, const LogAxis& error, const char* colour) {
  const double x = cost.at(row.ms), y = error.at(std::max(row.mean, kLeastError));
  return fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='4' fill='{}'/>\n", x, y, colour) +
         svgText(x + 6, y - 5, "start", row.rung);
}

}  // namespace

std::string looksPlot(const std::vector<LooksRow>& rows) {
  std::vector<double> costs, errors;
  std::vector<std::string> series;
  for (const LooksRow& row : rows) {
    if (!(row.ms > 0)) continue;
    costs.push_back(row.ms);
    errors.push_back(std::max(row.mean, kLeastError));
    if (std::ranges::find(series, seriesName(row)) == series.end()) series.push_back(seriesName(row));
  }
  const LogAxis cost = logAxis(costs, kLeft, kRight), error = logAxis(errors, kBottom, kTop);
  std::string svg = svgText(kLeft, 22, "start", "Rungs of the ladder of pictures: error against cost");
  svg += gridOf(cost, error);
  for (std::size_t s = 0; s < series.size(); ++s) {
    const double legend = kTop + 20 * static_cast<double>(s);
    svg += svgBox(kRight + 24, legend - 9, 10, 10, colourOf(s)) +
           svgText(kRight + 40, legend, "start", series[s]);
  }
  for (const LooksRow& row : rows) {
    const auto s = std::ranges::find(series, seriesName(row));
    if (row.ms > 0) svg += dotOf(row, cost, error, colourOf(static_cast<std::size_t>(s - series.begin())));
  }
  return svgPicture(kWidth, kHeight, svg);
}

}  // namespace stadion::bench
