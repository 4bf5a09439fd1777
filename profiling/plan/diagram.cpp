#include "profiling/plan/diagram.h"

#include "engine/plain_text/markup_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace stadion::plan {
namespace {

const char* nameOf(Activity what) {
  switch (what) {
  case Activity::App: return "App";
  case Activity::Cull: return "Cull";
  case Activity::Calls: return "Draw";
  case Activity::Raster: return "rasterised";
  case Activity::Swap: return "swap";
  case Activity::ForTurn: return "waits for its turn";
  case Activity::ForPixels: return "waits for its pixels";
  case Activity::ForWalls: return "waits for other walls";
  }
  return "";
}

char markOf(const Bar& bar) {
  switch (bar.what) {
  case Activity::ForTurn: return ':';
  case Activity::ForPixels: return '=';
  case Activity::ForWalls: return '-';
  case Activity::Swap: return '|';
  default: return static_cast<char>('0' + bar.frame % 10);
  }
}

/// Some frames from the middle, where the pipeline is full.
struct Part {
  double begin = 0, end = 1;
};

Part partOf(const Schedule& s, std::size_t frames) {
  if (s.shown.size() < 2) return {0, std::max(s.end, 1e-9)};
  const std::size_t length = std::min(frames, s.shown.size() - 1);
  const std::size_t first = (s.shown.size() - 1 - length) / 2;
  const double begin = s.shown[first].shown, end = s.shown[first + length].shown;
  const double margin = 0.03 * (end - begin);
  return {begin - margin, std::max(end + margin, begin + 1e-9)};
}

bool isIn(const Bar& bar, const Part& part) {
  return bar.end > part.begin && bar.begin < part.end;
}

/// Draws waits below work.
std::vector<const Bar*> painted(const Schedule& s, const Part& part) {
  std::vector<const Bar*> bars;
  for (const Bar& b : s.bars)
    if (isIn(b, part)) bars.push_back(&b);
  std::ranges::stable_sort(bars, {}, [](const Bar* b) { return !isWait(b->what); });
  return bars;
}

std::size_t longestName(const Schedule& s) {
  std::size_t longest = 5;
  for (const std::string& row : s.rows) longest = std::max(longest, row.size());
  return longest;
}

/// 1, 2 or 5 times a power of ten, so that there are about ten of them.
double tickOf(double length) {
  const double raw = length / 10, power = std::pow(10, std::floor(std::log10(raw)));
  for (const double step : {1.0, 2.0, 5.0})
    if (raw <= step * power) return step * power;
  return 10 * power;
}

}  // namespace

std::string diagramText(const Schedule& s, std::size_t frames, std::size_t columns) {
  const Part part = partOf(s, frames);
  const double perColumn = (part.end - part.begin) / static_cast<double>(columns);
  const auto columnOf = [&](double time) {
    const double at = (time - part.begin) / perColumn;
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(columns - 1)));
  };
  std::vector<std::string> lines(s.rows.size(), std::string(columns, ' '));
  for (const Bar* b : painted(s, part)) {
    const std::size_t from = columnOf(b->begin), to = std::max(from + 1, columnOf(b->end));
    for (std::size_t c = from; c < to; ++c) lines[b->row][c] = markOf(*b);
  }
  std::string swaps(columns, ' ');
  for (const ShownFrame& f : s.shown)
    if (f.shown >= part.begin && f.shown < part.end)
      swaps[columnOf(f.shown)] = static_cast<char>('0' + f.frame % 10);

  const std::size_t width = longestName(s);
  std::string text;
  for (std::size_t row = 0; row < s.rows.size(); ++row)
    text += fmt::format("{:<{}} {}\n", s.rows[row], width, lines[row]);
  text += fmt::format("{:<{}} {}\n", "swap", width, swaps);
  return text + fmt::format("{:<{}} {:.2f} ms a column; digits: work at that frame; = waits for its pixels, "
                            ": for its turn, - for other walls\n",
                            "", width, perColumn);
}

std::string diagramSvg(const Schedule& s, std::size_t frames, const std::string& title) {
  constexpr double kLeft = 170, kWidth = 1000, kRow = 26, kTop = 48, kBar = 18;
  static const std::array<const char*, 6> kColours{"#3b6fb6", "#d9822b", "#3a9a5b",
                                                   "#b0477f", "#7a63b8", "#8a7a2f"};
  const Part part = partOf(s, frames);
  const double scale = kWidth / (part.end - part.begin);
  const auto x = [&](double time) { return kLeft + std::clamp((time - part.begin) * scale, 0.0, kWidth); };
  const double bottom = kTop + kRow * static_cast<double>(s.rows.size());

  std::string svg = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" "
                                "height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
                                "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" "
                                "height=\"100%\" fill=\"#ffffff\"/>\n"
                                "<text x=\"{2}\" y=\"22\" font-size=\"14\" fill=\"#222222\">{3}</text>\n",
                                kLeft + kWidth + 20, bottom + 66, 12, markupText(title));
  for (std::size_t row = 0; row < s.rows.size(); ++row) {
    const double y = kTop + kRow * static_cast<double>(row);
    svg += fmt::format("<text x=\"{:.0f}\" y=\"{:.1f}\" text-anchor=\"end\" fill=\"#222222\">{}</text>\n"
                       "<line x1=\"{:.0f}\" y1=\"{:.1f}\" x2=\"{:.0f}\" y2=\"{:.1f}\" stroke=\"#e4e4e4\"/>\n",
                       kLeft - 10, y + 14, markupText(s.rows[row]), kLeft, y + kRow - 3, kLeft + kWidth,
                       y + kRow - 3);
  }
  for (const Bar* b : painted(s, part)) {
    const double y = kTop + kRow * static_cast<double>(b->row);
    const double from = x(b->begin), length = std::max(0.6, x(b->end) - from);
    svg += fmt::format("<rect x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{:.0f}\" fill=\"{}\"{}>"
                       "<title>frame {}: {}, {:.3f} ms</title></rect>\n",
                       from, y + (isWait(b->what) ? 6 : 2), length, isWait(b->what) ? kBar - 8 : kBar,
                       kColours[b->frame % kColours.size()], isWait(b->what) ? " fill-opacity=\"0.25\"" : "",
                       b->frame, nameOf(b->what), b->end - b->begin);
    if (!isWait(b->what) && length > 24)
      svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"#ffffff\">{}</text>\n", from + 4, y + 15,
                         b->frame);
  }
  for (const ShownFrame& f : s.shown)
    if (f.shown >= part.begin && f.shown <= part.end)
      svg +=
          fmt::format("<line x1=\"{0:.2f}\" y1=\"{1:.0f}\" x2=\"{0:.2f}\" y2=\"{2:.1f}\" stroke=\"#c0392b\" "
                      "stroke-dasharray=\"4 3\"/>\n<text x=\"{0:.2f}\" y=\"{3:.1f}\" text-anchor=\"middle\" "
                      "fill=\"#c0392b\">swap {4}</text>\n",
                      x(f.shown), kTop - 4, bottom + 4, bottom + 16, f.frame);
  const double tick = tickOf(part.end - part.begin);
  for (double t = 0; t <= part.end - part.begin; t += tick)
    svg += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" fill=\"#666666\">{:g} ms</text>\n",
        kLeft + t * scale, bottom + 36, t);
  return svg +
         fmt::format("<text x=\"{:.0f}\" y=\"{:.1f}\" fill=\"#666666\">A colour a frame; pale: the thread "
                     "waits for its turn, its pixels or other walls.</text>\n</svg>\n",
                     kLeft, bottom + 56);
}

}  // namespace stadion::plan
