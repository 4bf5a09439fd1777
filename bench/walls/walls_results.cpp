#include "bench/walls/walls_results.h"

#include "engine/maths/median.h"

#include <algorithm>

namespace stadion::bench {
namespace {

std::optional<double> number(const nlohmann::json& row, const std::string& field) {
  const auto found = row.find(field);
  if (found == row.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

}  // namespace

void WallsResults::add(nlohmann::json row) {
  const std::string name = row.at("case");
  if (!rows_.contains(name)) names_.push_back(name);
  rows_[name].push_back(std::move(row));
}

const std::vector<nlohmann::json>& WallsResults::rowsOf(const std::string& name) const {
  static const std::vector<nlohmann::json> none;
  const auto found = rows_.find(name);
  return found == rows_.end() ? none : found->second;
}

std::size_t WallsResults::count(const std::string& name) const {
  return rowsOf(name).size();
}

std::optional<double> WallsResults::median(const std::string& name, const std::string& field) const {
  std::vector<double> values;
  for (const nlohmann::json& row : rowsOf(name))
    if (const auto n = number(row, field)) values.push_back(*n);
  if (values.empty()) return std::nullopt;
  return stadion::median(std::move(values));
}

std::optional<double> WallsResults::medianRatio(const std::string& name, const std::string& field,
                                                const std::string& to) const {
  std::vector<double> values;
  for (const nlohmann::json& row : rowsOf(name)) {
    const auto n = number(row, field), d = number(row, to);
    if (n && d && *d > 0) values.push_back(*n / *d);
  }
  if (values.empty()) return std::nullopt;
  return stadion::median(std::move(values));
}

}  // namespace stadion::bench
