#include "show/display/budget_panel.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stadion {
namespace {

constexpr std::uint32_t kPanelMargin = 8;  ///< [pixels]
constexpr std::array<std::uint8_t, 3> kPlainText{235, 235, 235}, kGoodText{120, 230, 120},
    kTightText{245, 205, 70}, kBadText{250, 105, 90};

/// A bar of ten parts: how much of the frame's time it takes.
PanelLine bar(const char* name, double ms, double frameMs) {
  const double share = ms / frameMs;
  const auto full = static_cast<std::size_t>(std::clamp(std::lround(10 * share), 0l, 10l));
  const std::string line = fmt::format("{:<5}{:7.2f} ms [{}{}] {:3.0f} %", name, ms, std::string(full, '#'),
                                       std::string(10 - full, '.'), 100 * share);
  return {line, share > 1 ? kBadText : share > 0.8 ? kTightText : kGoodText};
}

void blend(const Picture& panel, Picture& onto) {
  if (onto.width <= kPanelMargin || onto.height <= kPanelMargin) return;
  const std::uint32_t width = std::min(panel.width, onto.width - kPanelMargin),
                      height = std::min(panel.height, onto.height - kPanelMargin);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::uint8_t* from = &panel.rgba[4 * (static_cast<std::size_t>(y) * panel.width + x)];
      std::uint8_t* to =
          &onto.rgba[4 * (static_cast<std::size_t>(y + kPanelMargin) * onto.width + x + kPanelMargin)];
      for (int c = 0; c < 3; ++c)
        to[c] = static_cast<std::uint8_t>((from[c] * from[3] + to[c] * (255 - from[3]) + 127) / 255);
    }
}

}  // namespace

std::vector<PanelLine> budgetLines(const BudgetNumbers& f) {
  const double frameMs = 1000 / f.rate;
  std::string state = fmt::format("{}  {:.2f} s", f.show, f.seconds);
  if (f.speed != 1) state += fmt::format("  speed 1/{:.0f}", 1 / f.speed);
  if (f.paused) state += "  paused";
  std::vector<PanelLine> lines{{state, f.paused || f.speed != 1 ? kTightText : kPlainText},
                               bar("App", f.budget.appMs, frameMs),
                               bar("Cull", f.budget.cullMs, frameMs),
                               bar("Draw", f.budget.drawMs, frameMs),
                               {fmt::format("{:.1f} of {:.0f} frames/s  {:.2f} ms each  {} dropped",
                                            f.budget.framesPerSecond, f.rate, frameMs, f.dropped),
                                kPlainText}};
  for (const std::string& line : f.given) lines.push_back({line, kTightText});
  return lines;
}

void layPanel(const std::vector<PanelLine>& lines, EyePictures& wall) {
  for (Picture& picture : wall.eyes) {
    const std::uint32_t room =
        picture.width > 4 * kPanelMargin ? picture.width - 2 * kPanelMargin : picture.width;
    blend(textPanel(lines, room, picture.width >= 700 ? 2 : 1), picture);
  }
}

}  // namespace stadion
