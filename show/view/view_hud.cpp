#include "show/view/view_hud.h"

#include "show/view/view_settings.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stadion {
namespace {

constexpr std::chrono::seconds kStays{6};
constexpr std::size_t kMostMessages = 4;
constexpr std::array<std::uint8_t, 3> kPlain{235, 235, 235}, kGood{120, 230, 120}, kTight{245, 205, 70},
    kBad{250, 105, 90};

/// A bar of ten parts: how much of the frame's time it takes.
PanelLine bar(const char* name, double ms, double frameMs) {
  const double share = ms / frameMs;
  const auto full = static_cast<std::size_t>(std::clamp(std::lround(10 * share), 0l, 10l));
  const std::string line = fmt::format("{:<5}{:7.2f} ms [{}{}] {:3.0f} %", name, ms, std::string(full, '#'),
                                       std::string(10 - full, '.'), 100 * share);
  return {line, share > 1 ? kBad : share > 0.8 ? kTight : kGood};
}

}  // namespace

void ViewHud::say(const std::string& line) {
  const std::lock_guard lock(mutex_);
  messages_.push_back({line, Clock::now() + kStays});
  if (messages_.size() > kMostMessages) messages_.erase(messages_.begin());
}

void ViewHud::setTrouble(const std::vector<std::string>& lines) {
  const std::lock_guard lock(mutex_);
  trouble_ = lines;
}

std::vector<PanelLine> ViewHud::budgetLines(const HudFigures& f) const {
  const double frameMs = 1000 / f.rate;
  std::string state = fmt::format("{}  {:.2f} s", f.show, f.seconds);
  if (f.speed != 1) state += fmt::format("  speed 1/{:.0f}", 1 / f.speed);
  if (f.paused) state += "  paused";
  std::vector<PanelLine> lines{{state, f.paused || f.speed != 1 ? kTight : kPlain},
                               bar("App", f.budget.appMs, frameMs),
                               bar("Cull", f.budget.cullMs, frameMs),
                               bar("Draw", f.budget.drawMs, frameMs),
                               {fmt::format("{:.1f} of {:.0f} frames/s  {:.2f} ms each  {} dropped",
                                            f.budget.framesPerSecond, f.rate, frameMs, f.dropped),
                                kPlain}};
  for (const std::string& line : f.given) lines.push_back({line, kTight});
  return lines;
}

std::vector<PanelLine> ViewHud::helpLines() const {
  std::vector<PanelLine> lines;
  for (const std::string& text : viewKeys()) lines.push_back({text, kPlain});
  return lines;
}

std::vector<PanelLine> ViewHud::messageLines() const {
  const std::lock_guard lock(mutex_);
  std::vector<PanelLine> lines;
  for (const std::string& text : trouble_) lines.push_back({text, kBad});
  const auto now = Clock::now();
  for (const Message& m : messages_)
    if (now < m.until) lines.push_back({m.text, kPlain});
  return lines;
}

}  // namespace stadion
