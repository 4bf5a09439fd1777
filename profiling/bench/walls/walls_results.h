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

  /// How many rows a case has.
  std::size_t count(const std::string& name) const;
  /// Over the rounds; nothing if no row has this number.
  std::optional<double> median(const std::string& name, const std::string& field) const;
  /// What a number is to another of the same row, over the rounds.
  std::optional<double> medianRatio(const std::string& name, const std::string& field,
                                    const std::string& to) const;
  /// In the order in which they came first.
  const std::vector<std::string>& names() const { return names_; }
  const std::vector<nlohmann::json>& rowsOf(const std::string& name) const;

private:
  std::vector<std::string> names_;
  std::map<std::string, std::vector<nlohmann::json>> rows_;
};

}  // namespace stadion::bench
