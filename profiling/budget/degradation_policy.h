#pragma once
/// Decides when a node degrades, by how much, and when it recovers.
///
/// It degrades at once on a clear overrun: of eight frames, two with more than three times the budget, or
/// four that are a quarter over it; or a smoothed cost that is 5 % over the budget for at least 32 frames.
/// A single such frame changes nothing. It goes to the first level of its ladder that is expected to fit. The
/// expectation is the level's last cost, or else the usual savings of its degradations.
///
/// It recovers one level after a second without overruns (`patience` frames), if the more expensive level is
/// expected to leave a fifth of the budget free. If that is not expected or not known, the level is tried
/// anyway, after a time that doubles with every failed try. A node that stays too expensive is thus tried
/// ever less often, and one that has become cheap recovers.
///
/// Units    milliseconds, frames. It has no clock, and knows only its input.
/// Threads  plain values; one thread at a time.

#include "engine/core/cost_budget.h"

#include <array>
#include <optional>
#include <vector>

namespace stadion {

/// The cost of one frame.
struct BudgetedCost {
  double app = 0;    ///< [ms] of App
  double drawn = 0;  ///< [ms] of Cull and Draw, all walls and eyes
  double total() const { return app + drawn; }
};

/// The part of the cost that a level usually leaves: of App, and of Cull and Draw.
struct LevelSavings {
  double app = 1, drawn = 1;
  std::uint32_t cycle = 1;  ///< frames, of which one has the cost
};
/// By level, from 0 on.
std::vector<LevelSavings> savingsOf(const std::vector<DegradationStep>& ladder);

class DegradationPolicy {
public:
  struct Options {
    double budget = 1;            ///< [ms]
    std::uint64_t patience = 60;  ///< frames without overruns before recovering a level
  };

  DegradationPolicy(Options options, std::vector<LevelSavings> levels);

  /// Adds a frame's cost; frames come in order. Frames from before the last level took effect do not count.
  /// Returns the level that is wanted now.
  std::uint32_t take(std::uint64_t frame, const BudgetedCost& cost);
  /// Reports that the wanted level takes effect with this frame.
  void applied(std::uint64_t frame);
  /// Replaces the ladder. `becomes` maps each level of the old one, from 0 on, to the equal level of the new
  /// one. All knowledge is kept.
  void relay(std::vector<LevelSavings> levels, const std::vector<std::uint32_t>& becomes);

  std::uint32_t wanted() const { return wanted_; }
  std::uint32_t level() const { return level_; }
  /// Returns the expected cost of a level, from the cost of the present one.
  double expectedAt(std::uint32_t level) const;

private:
  static constexpr std::size_t kWindow = 8;

  void note(const BudgetedCost& cost);
  bool isTooMuch() const;
  void giveUp(std::uint64_t frame);
  void takeBack(std::uint64_t frame);
  double expectedBack() const;
  std::uint64_t waitFor() const;

  Options options_;
  std::vector<LevelSavings> levels_;
  std::uint32_t level_ = 0, wanted_ = 0;
  std::uint64_t since_ = 0;  ///< frame from which level_ counts
  std::array<BudgetedCost, kWindow> window_{};
  std::array<int, kWindow> strikes_{};
  std::size_t seen_ = 0;        ///< frames at this level
  std::uint64_t calm_ = 0;      ///< the last of them without overruns
  BudgetedCost mean_;           ///< smoothed
  std::uint32_t failures_ = 0;  ///< failed tries to recover a level, in a row
  bool trying_ = false;         ///< the present level is such a try
  bool troubled_ = false;       ///< the last level was left for an overrun: one clear sign is enough now
  std::vector<std::optional<double>> known_;    ///< costs of levels when they were left for a higher one
  std::vector<std::optional<double>> settled_;  ///< costs of levels a while after they were reached
};

}  // namespace stadion
