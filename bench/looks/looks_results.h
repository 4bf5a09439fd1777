#pragma once
/// The results of `stadion bench looks`: a row for each rung and each wall of a scene, and the limits.
///
/// Threads  plain values and functions.

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace stadion::bench {

/// One rung on one wall of a scene, both eyes together.
struct LooksRow {
  std::string scene, wall, rung;
  double ms = 0, leastMs = 0;           ///< processor time a view: median and least of the rounds
  double mean = 0;                      ///< difference from the reference [of 255]
  int p99 = 0, most = 0;                ///< likewise: 99 % are at most this; all are
  double within8 = 1;                   ///< part of the channels that differ by 8 or less
  std::optional<double> flicker{};      ///< mean, of 255; nothing: not measured
  std::optional<double> disparity{};    ///< mean error [pixels]; nothing: no block has contrast
  std::optional<double> butteraugli{};  ///< distance; nothing: no program
  std::optional<double> ssimulacra{};   ///< 0: alike; nothing: no program
};

/// What the rows must show.
struct LooksLimit {
  std::string what;
  double value, most;
  bool met() const { return value <= most; }
};

/// The limits that the rows can show: the default against OpenGL and against 8 samples, and the filled
/// stadium against the usual one.
std::vector<LooksLimit> limitsOf(const std::vector<LooksRow>& rows);

std::string headOfTable();
std::string lineOf(const LooksRow& row);
std::string lineOf(const LooksLimit& limit);
nlohmann::json jsonOf(const LooksRow& row);
nlohmann::json jsonOf(const LooksLimit& limit);

}  // namespace stadion::bench
