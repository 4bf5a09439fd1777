#pragma once
/// When something that costs too much gives something up, how much, and when it gets it back.
///
/// It gives up at once on a clear overrun: two frames of more than three times the budget, or four that are a
/// quarter over it, of eight; one such frame spoils nothing. It goes to the first level of its ladder that is
/// expected to fit, by what that level cost the last time, else by what its concessions usually save.
///
/// It gets back one level after a second of calm (`patience` frames, none of them over), if the dearer level
/// is expected to leave a fifth of the budget free. If that cannot be expected or is not known, it is tried
/// all the same, after a time that doubles with every try that failed: so what goes on being too dear is
/// tried less and less often, and what has become cheap again recovers.
///
/// Units    milliseconds, frames. No clock: it knows what it is told.
/// Threads  plain values; one thread at a time.

#include "engine/core/load_control.h"

#include <array>
#include <optional>
#include <vector>

namespace stadion {

/// Of one frame.
struct LoadCost {
  double app = 0;    ///< [ms] of App
  double drawn = 0;  ///< [ms] of Cull and Draw, all walls and eyes
  double total() const { return app + drawn; }
};

/// What is left of the cost at a level of a ladder, by experience: of App and of Cull and Draw.
struct LevelSavings {
  double app = 1, drawn = 1;
  std::uint32_t cycle = 1;  ///< frames, of which one bears the cost
};
/// By level, from 0 on.
std::vector<LevelSavings> savingsOf(const std::vector<Concession>& ladder);

class ReliefPolicy {
public:
  struct Options {
    double budget = 1;            ///< [ms]
    std::uint64_t patience = 60;  ///< frames of calm before anything is taken back
  };

  ReliefPolicy(Options options, std::vector<LevelSavings> levels);

  /// What a frame cost; frames in their order. Frames from before the last level took effect count for
  /// nothing. Returns the level that is wanted now.
  std::uint32_t take(std::uint64_t frame, const LoadCost& cost);
  /// The level that was wanted takes effect with this frame.
  void applied(std::uint64_t frame);
  /// The ladder has changed: `becomes` says of each level of the old one, from 0 on, which level of the new
  /// one gives up the same. All that is known stays known.
  void relay(std::vector<LevelSavings> levels, const std::vector<std::uint32_t>& becomes);

  std::uint32_t wanted() const { return wanted_; }
  std::uint32_t level() const { return level_; }
  /// What is expected of a level, from what the present one costs.
  double expectedAt(std::uint32_t level) const;

private:
  static constexpr std::size_t kWindow = 8;

  void note(const LoadCost& cost);
  bool isTooMuch() const;
  void giveUp(std::uint64_t frame);
  void takeBack(std::uint64_t frame);
  double expectedBack() const;
  std::uint64_t waitFor() const;

  Options options_;
  std::vector<LevelSavings> levels_;
  std::uint32_t level_ = 0, wanted_ = 0;
  std::uint64_t since_ = 0;  ///< frame from which level_ counts
  std::array<LoadCost, kWindow> window_{};
  std::array<int, kWindow> strikes_{};
  std::size_t seen_ = 0;        ///< frames at this level
  std::uint64_t calm_ = 0;      ///< of them, the last ones without any trouble
  LoadCost mean_;               ///< smoothed
  std::uint32_t failures_ = 0;  ///< tries to take something back that failed, one after the other
  bool trying_ = false;         ///< the present level is such a try
  bool troubled_ = false;       ///< the present level was given up for: one clear sign is enough now
  std::vector<std::optional<double>> known_;    ///< what levels cost when they were left for a higher one
  std::vector<std::optional<double>> settled_;  ///< and a while after they were reached
};

}  // namespace stadion
