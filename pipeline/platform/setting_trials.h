#pragma once
/// Which setting is measured next, for as long as there is time.
///
/// In rounds, so that what disturbs the machine disturbs all alike; every second one goes the other way
/// round. After each round what is clearly slower is out, and gets no more time. What the first round leaves
/// is tried pinned, too.
///
/// Threads  one at a time.

#include "pipeline/platform/calibration.h"

#include <vector>

namespace stadion {

class SettingTrials {
public:
  /// Expects at least one setting, none of them pinned. `pin`: whether they are tried pinned, too.
  SettingTrials(const std::vector<DrawSetting>& settings, bool pin);

  /// What is slower than this part of the fastest is out.
  static constexpr double kWorthwhile = 0.8;

  /// False once nothing is left: each has failed.
  bool any() const { return !round_.empty(); }
  /// Whether each has been tried once: from then on what comes makes the choice surer.
  bool allTried() const { return rounds_ >= 1; }
  /// Whether there are figures.
  bool anyMeasured() const { return !results().empty(); }
  /// To be measured next. Expects any().
  const DrawSetting& next() const { return tried_[round_.front()].setting; }
  /// What came of it.
  void measured(double framesPerSecond, double cpuMs);
  /// It could not be measured: it is out, without figures.
  void failed();

  /// What has figures, in the order in which it was first tried.
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
  std::vector<std::size_t> round_;  ///< what is left of it, the next one first
  std::size_t rounds_ = 0;          ///< that are over
};

}  // namespace stadion
