#include "pipeline/platform/setting_trials.h"

#include "engine/maths/median.h"

#include <algorithm>

namespace stadion {
namespace {}  // namespace

SettingTrials::SettingTrials(const std::vector<DrawSetting>& settings, bool pin) : pin_(pin) {
  for (const DrawSetting& setting : settings) tried_.push_back({setting});
  beginRound();
}

void SettingTrials::beginRound() {
  for (std::size_t i = 0; i < tried_.size(); ++i)
    if (!tried_[i].out) round_.push_back(i);
  if (rounds_ % 2 == 1) std::ranges::reverse(round_);
}

void SettingTrials::measured(double framesPerSecond, double cpuMs) {
  Tried& tried = tried_[round_.front()];
  tried.framesPerSecond.push_back(framesPerSecond);
  tried.cpuMs.push_back(cpuMs);
  goOn();
}

void SettingTrials::failed() {
  tried_[round_.front()].out = true;
  goOn();
}

void SettingTrials::goOn() {
  round_.erase(round_.begin());
  if (!round_.empty()) return;
  dropSlow();
  if (rounds_++ == 0 && pin_)
    for (std::size_t i = 0, end = tried_.size(); i < end; ++i)
      if (!tried_[i].out) {
        DrawSetting pinned = tried_[i].setting;
        pinned.pinned = true;
        tried_.push_back({pinned});
      }
  beginRound();
}

void SettingTrials::dropSlow() {
  double fastest = 0;
  for (const Tried& t : tried_)
    if (!t.out) fastest = std::max(fastest, median(t.framesPerSecond));
  for (Tried& t : tried_)
    if (!t.out && median(t.framesPerSecond) < kWorthwhile * fastest) t.out = true;
}

std::vector<MeasuredSetting> SettingTrials::results() const {
  std::vector<MeasuredSetting> results;
  for (const Tried& t : tried_)
    if (!t.framesPerSecond.empty())
      results.push_back({t.setting, median(t.framesPerSecond), median(t.cpuMs),
                         static_cast<std::uint32_t>(t.framesPerSecond.size())});
  return results;
}

}  // namespace stadion
