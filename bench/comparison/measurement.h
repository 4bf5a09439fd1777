#pragma once
/// One line of a program stadion-dyn-ENGINE: the cost and the errors of an engine on a case.

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace stadion::bench {

struct Measurement {
  std::string engine, caseName;
  int n = 1;      ///< steps a frame
  double ns = 0;  ///< processor time per body and frame [ns]; NaN if the case was not played
  bool unsupported = false;
  int crash = 0;                    ///< the signal that ended it; -1 for another end, 0 for none
  std::map<std::string, double> m;  ///< errors by name; NaN if not a number

  bool refused() const { return metric("mesh_refused") > 0; }  ///< refused to load a mesh of the case
  bool played() const { return !unsupported && crash == 0 && !refused(); }
  /// Returns NaN if there is no metric of that name.
  double metric(const std::string& name) const;
};

/// Returns nothing if the line is no measurement.
std::optional<Measurement> parseMeasurement(const std::string& line);
std::string toJson(const Measurement& m);

/// Combines several rounds into one measurement with the median cost. Errors are equal in each round; the
/// times among them are not.
Measurement medianOf(const std::vector<Measurement>& rounds);

}  // namespace stadion::bench
