#pragma once
/// One line of the programs stadion-dyn-ENGINE: what a case cost an engine and how far off it was.

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace stadion::bench {

struct Measurement {
  std::string engine, caseName;
  int n = 1;      ///< steps a frame
  double ns = 0;  ///< processor time per body and frame [ns]; no number if it has not played
  bool unsupported = false;
  int crash = 0;                    ///< the signal that ended it, -1 for another end, 0 none
  std::map<std::string, double> m;  ///< errors by name; NaN where there is no number

  bool refused() const { return metric("mesh_refused") > 0; }  ///< to load what the case needs
  bool played() const { return !unsupported && crash == 0 && !refused(); }
  /// NaN if there is none of that name.
  double metric(const std::string& name) const;
};

/// Nothing if the line is none.
std::optional<Measurement> parseMeasurement(const std::string& line);
std::string toJson(const Measurement& m);

/// Of several rounds of the same: the median cost. Errors are the same in each round, times among them are
/// not.
Measurement medianOf(const std::vector<Measurement>& rounds);

}  // namespace stadion::bench
