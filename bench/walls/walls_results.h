#pragma once
/// The rows of all rounds of `stadion bench walls`, by case.
///
/// Threads  plain values.

#include <nlohmann/json.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace stadion::bench {

class WallsResults {
public:
  /// Expects a row with a "case".
  void add(nlohmann::json row);

  /// Returns the number of a case's rows.
  std::size_t count(const std::string& name) const;
  /// Over the rounds; nothing if no row has this number.
  std::optional<double> median(const std::string& name, const std::string& field) const;
  /// Returns the ratio of two numbers of the same row, as the median over the rounds.
  std::optional<double> medianRatio(const std::string& name, const std::string& field,
                                    const std::string& to) const;
  /// In the order of their first rows.
  const std::vector<std::string>& names() const { return names_; }
  const std::vector<nlohmann::json>& rowsOf(const std::string& name) const;

private:
  std::vector<std::string> names_;
  std::map<std::string, std::vector<nlohmann::json>> rows_;
};

}  // namespace stadion::bench
