#include "bench/comparison/measurement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace stadion::bench {
namespace {

double middle(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Some metrics among the errors are times.
bool isTime(const std::string& metric) {
  return metric.ends_with("_ms");
}

}  // namespace

double Measurement::metric(const std::string& name) const {
  const auto found = m.find(name);
  return found == m.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

std::optional<Measurement> parseMeasurement(const std::string& line) {
  const nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
  if (!json.is_object() || !json.contains("engine") || !json.contains("case")) return std::nullopt;
  Measurement r;
  r.engine = json.value("engine", "");
  r.caseName = json.value("case", "");
  r.n = json.value("n", 1);
  if (const auto ns = json.find("ns_per_body_frame"); ns != json.end() && ns->is_number())
    r.ns = ns->get<double>();
  r.unsupported = json.value("unsupported", false);
  r.crash = json.value("crash", 0);
  if (json.contains("m"))
    for (const auto& [name, value] : json["m"].items())
      r.m[name] = value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
  return r;
}

std::string toJson(const Measurement& r) {
  nlohmann::ordered_json json{{"engine", r.engine}, {"case", r.caseName}, {"n", r.n}};
  if (r.crash) {
    json["crash"] = r.crash;
    return json.dump();
  }
  json["ns_per_body_frame"] =
      r.played() ? nlohmann::ordered_json(std::round(r.ns * 10) / 10) : nlohmann::ordered_json();
  if (r.refused()) json["refused"] = true;
  if (r.unsupported) json["unsupported"] = true;
  json["m"] = nlohmann::ordered_json::object();
  for (const auto& [name, value] : r.m)
    json["m"][name] = std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
  return json.dump();
}

Measurement medianOf(const std::vector<Measurement>& rounds) {
  Measurement r = rounds.front();
  std::vector<double> costs;
  for (const Measurement& round : rounds) {
    if (!round.played()) return round;
    costs.push_back(round.ns);
  }
  r.ns = middle(costs);
  for (auto& [name, value] : r.m) {
    if (!isTime(name)) continue;
    std::vector<double> times;
    for (const Measurement& round : rounds) times.push_back(round.metric(name));
    value = middle(times);
  }
  return r;
}

}  // namespace stadion::bench
