#pragma once
/// Durations of one kind, kept as a sum and a histogram: bounded, however long a show runs.
///
/// Units    milliseconds.
/// Threads  plain values; one thread at a time.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace stadion {

class CostSeries {
public:
  /// From 1 ns to half an hour, eight bins an octave: percentiles are exact to 9 %.
  static constexpr int kBinsAnOctave = 8, kOctaves = 41;

  void add(double ms, std::uint64_t times = 1) {
    sum_ += ms * static_cast<double>(times);
    count_ += times;
    most_ = std::max(most_, ms);
    bins_[binOf(ms)] += static_cast<std::uint32_t>(times);
  }
  void add(const CostSeries& other) {
    sum_ += other.sum_;
    count_ += other.count_;
    most_ = std::max(most_, other.most_);
    for (std::size_t i = 0; i < bins_.size(); ++i) bins_[i] += other.bins_[i];
  }
  double sum() const { return sum_; }
  double most() const { return most_; }
  std::uint64_t count() const { return count_; }
  double mean() const { return count_ > 0 ? sum_ / static_cast<double>(count_) : 0; }
  /// Returns the middle of the bin that contains that percentile.
  double percentile(double percent) const {
    const double wanted = percent / 100 * static_cast<double>(count_);
    double seen = 0;
    for (std::size_t i = 0; i < bins_.size(); ++i) {
      seen += bins_[i];
      if (seen >= wanted && bins_[i] > 0) return std::min(middleOf(i), most_);
    }
    return most_;
  }
  static double middleOf(std::size_t bin) {
    return 1e-6 * std::exp2((static_cast<double>(bin) + 0.5) / kBinsAnOctave);
  }
  const auto& bins() const { return bins_; }

private:
  static std::size_t binOf(double ms) {
    const double octave = std::log2(std::max(ms * 1e6, 1.0));
    return static_cast<std::size_t>(std::min(octave * kBinsAnOctave, kBinsAnOctave * kOctaves - 1.0));
  }

  double sum_ = 0, most_ = 0;
  std::uint64_t count_ = 0;
  std::array<std::uint32_t, static_cast<std::size_t>(kBinsAnOctave* kOctaves)> bins_{};
};

}  // namespace stadion
