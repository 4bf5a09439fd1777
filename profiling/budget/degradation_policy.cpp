#include "profiling/budget/degradation_policy.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kMild = 1.25, kSevere = 3;  ///< of the budget
constexpr int kEnough = 4, kEnoughInTrouble = 2;
constexpr double kSmooth = 1.0 / 16;
constexpr double kMostCounted = 2;        ///< limit of one frame's share in the smoothed cost, relative to
                                          ///< the budget
constexpr double kSteadyOver = 1.05;      ///< of the budget, smoothed
constexpr std::size_t kSteadyAfter = 32;  ///< frames before the smoothed cost counts
constexpr std::size_t kSettled = 30;      ///< frames after which the smoothed cost belongs to the level
constexpr double kSays = 0.05;            ///< of the previous cost: a smaller rest is chance
constexpr double kRoom = 0.8;             ///< of the budget, for a more expensive level
constexpr double kOverrun = 1.0;          ///< of the budget: a frame above it is an overrun
constexpr std::uint32_t kMostFailures = 6;
constexpr std::uint32_t kKnownBetter = 3;  ///< tries saved if a level is known to be too expensive
constexpr std::uint64_t kTrial = 4;        ///< times the patience: the trial of a recovered level

// Usual savings of degradations; the true savings are known after they were applied.
constexpr double kLodSaves = 0.75;

}  // namespace

std::vector<LevelSavings> savingsOf(const std::vector<DegradationStep>& ladder) {
  std::vector<LevelSavings> levels;
  for (std::uint32_t level = 0; level <= levelsOf(ladder); ++level) {
    const NodeDegradation r = degradationAt(ladder, level);
    LevelSavings s;
    s.cycle = r.rests ? 1 : 1U << r.pace;
    s.app = r.rests ? 0 : 1.0 / s.cycle;
    s.drawn = r.hidden ? 0 : std::pow(kLodSaves, std::log(r.lod) / std::log(kLodLevel));
    levels.push_back(s);
  }
  return levels;
}

DegradationPolicy::DegradationPolicy(Options options, std::vector<LevelSavings> levels)
    : options_(options), levels_(std::move(levels)), known_(levels_.size()), settled_(levels_.size()) {}

void DegradationPolicy::applied(std::uint64_t frame) {
  if (level_ == wanted_) return;
  trying_ = wanted_ < level_;
  troubled_ = wanted_ > level_;
  // Until the new level is measured, its expected cost counts.
  const LevelSavings &from = levels_[level_], &to = levels_[wanted_];
  mean_.app = from.app > 0 ? mean_.app * to.app / from.app : 0;
  mean_.drawn = from.drawn > 0 ? mean_.drawn * to.drawn / from.drawn : 0;
  level_ = wanted_;
  since_ = frame;
  seen_ = 0;
  calm_ = 0;
  strikes_.fill(0);
}

void DegradationPolicy::relay(std::vector<LevelSavings> levels, const std::vector<std::uint32_t>& becomes) {
  std::vector<std::optional<double>> known(levels.size()), settled(levels.size());
  for (std::size_t l = 0; l < becomes.size(); ++l) {
    known.at(becomes[l]) = known_[l];
    settled.at(becomes[l]) = settled_[l];
  }
  levels_ = std::move(levels);
  known_ = std::move(known);
  settled_ = std::move(settled);
  level_ = becomes.at(level_);
  wanted_ = becomes.at(wanted_);
}

void DegradationPolicy::note(const BudgetedCost& cost) {
  window_[seen_ % kWindow] = cost;
  // For nodes that run now and then, the frames in between belong to the cycle.
  const std::size_t cycle = levels_[level_].cycle;
  BudgetedCost typical;
  for (std::size_t i = 0; i < std::min(cycle, seen_ + 1); ++i) {
    typical.app += window_[(seen_ - i) % kWindow].app / static_cast<double>(cycle);
    typical.drawn += window_[(seen_ - i) % kWindow].drawn / static_cast<double>(cycle);
  }
  const double share = typical.total() / options_.budget;
  strikes_[seen_ % kWindow] = share > kSevere ? 2 : share > kMild ? 1 : 0;
  const double weight = seen_ == 0 && level_ == 0 && mean_.total() == 0 ? 1 : kSmooth;
  // One spike says nothing about the steady cost.
  const double counted = std::min(1.0, kMostCounted / std::max(share, 1e-9));
  mean_.app += weight * (counted * typical.app - mean_.app);
  mean_.drawn += weight * (counted * typical.drawn - mean_.drawn);
  if (++seen_ == kSettled && troubled_) settled_[level_] = mean_.total();
  calm_ = share > kOverrun ? 0 : calm_ + 1;
}

bool DegradationPolicy::isTooMuch() const {
  int strikes = 0;
  for (const int s : strikes_) strikes += s;
  if (strikes >= (troubled_ || trying_ ? kEnoughInTrouble : kEnough)) return true;
  return seen_ >= kSteadyAfter && mean_.total() > kSteadyOver * options_.budget;
}

double DegradationPolicy::expectedAt(std::uint32_t level) const {
  const LevelSavings &from = levels_[level_], &to = levels_[level];
  const auto scaled = [](double cost, double have, double get) {
    return have > 0 ? cost * get / have : get > 0 ? HUGE_VAL : 0;
  };
  return scaled(mean_.app, from.app, to.app) + scaled(mean_.drawn, from.drawn, to.drawn);
}

/// Chooses the first level that is expected to fit, else the one that helps most.
void DegradationPolicy::giveUp(std::uint64_t frame) {
  if (trying_ && frame - since_ < kTrial * options_.patience)
    failures_ = std::min(failures_ + 1, kMostFailures);
  trying_ = false;
  // Frames over budget weigh more than the smoothed cost.
  BudgetedCost worst;
  for (std::size_t i = 0; i < std::min(seen_, kWindow); ++i)
    if (window_[i].total() > worst.total()) worst = window_[i];
  const double cycle = levels_[level_].cycle;
  mean_ = {std::max(mean_.app, worst.app / cycle), std::max(mean_.drawn, worst.drawn / cycle)};
  known_[level_] = mean_.total();
  std::uint32_t best = level_;
  for (std::uint32_t l = level_ + 1; l < levels_.size(); ++l) {
    const double expected = std::max(expectedAt(l), known_[l].value_or(0));
    if (expected < 0.999 * std::max(expectedAt(best), best == level_ ? 0 : known_[best].value_or(0)))
      best = l;
    if (expected <= options_.budget) break;
  }
  wanted_ = best;
}

/// The expected cost of the level below: the present cost times the ratio when that level was left. Once
/// levels have recovered, the old ratio is out of date.
double DegradationPolicy::expectedBack() const {
  const auto &before = known_[level_ - 1], &settled = settled_[level_];
  if (troubled_ && before && settled && *settled > kSays * *before) return mean_.total() * *before / *settled;
  return expectedAt(level_ - 1);
}

std::uint64_t DegradationPolicy::waitFor() const {
  const double expected = expectedBack();
  if (expected <= kRoom * options_.budget) return options_.patience;
  const bool unknown = std::isinf(expected);
  return options_.patience << std::min(failures_ + (unknown ? 0 : kKnownBetter), kMostFailures);
}

void DegradationPolicy::takeBack(std::uint64_t frame) {
  if (trying_ && frame - since_ >= kTrial * options_.patience) {
    failures_ /= 2;
    trying_ = false;
  }
  if (level_ == 0 || calm_ < waitFor()) return;
  wanted_ = level_ - 1;
}

std::uint32_t DegradationPolicy::take(std::uint64_t frame, const BudgetedCost& cost) {
  if (frame < since_ || wanted_ != level_) return wanted_;
  note(cost);
  if (isTooMuch())
    giveUp(frame);
  else
    takeBack(frame);
  return wanted_;
}

}  // namespace stadion
