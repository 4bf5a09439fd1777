#pragma once
/// Chooses the next setting to measure, for as long as there is time.
///
/// Settings are measured in rounds, so that a disturbance of the machine affects all alike. Every second
/// round runs in reverse order. After each round clearly slower settings are removed. Settings that remain
/// after the first round are also tried pinned.
///
/// Threads  one at a time.

#include "pipeline/platform/calibration.h"

#include <vector>

namespace stadion {

class SettingTrials {
public:
  /// Expects at least one setting, none of them pinned. `pin`: also tries them pinned.
  SettingTrials(const std::vector<DrawSetting>& settings, bool pin);

  /// A setting below this part of the fastest is removed.
  static constexpr double kWorthwhile = 0.8;

  /// Returns false once no setting is left: each has failed.
  bool any() const { return !round_.empty(); }
  /// Returns true if each has been tried once. Further measurements only make the choice more certain.
  bool allTried() const { return rounds_ >= 1; }
  /// Returns true if there are figures.
  bool anyMeasured() const { return !results().empty(); }
  /// Returns the setting to measure next. Expects any().
  const DrawSetting& next() const { return tried_[round_.front()].setting; }
  /// Reports its result.
  void measured(double framesPerSecond, double cpuMs);
  /// Reports that it could not be measured: it is removed, without figures.
  void failed();

  /// Returns the measured settings, in the order in which they were first tried.
  std::vector<MeasuredSetting> results() const;

private:
  struct Tried {
    DrawSetting setting;
    bool out = false;
    std::vector<double> framesPerSecond{}, cpuMs{};
  };
  void goOn();
  void dropSlow();
  void beginRound();

  bool pin_;
  std::vector<Tried> tried_;
  std::vector<std::size_t> round_;  ///< settings left in it, the next one first
  std::size_t rounds_ = 0;          ///< finished rounds
};

}  // namespace stadion
