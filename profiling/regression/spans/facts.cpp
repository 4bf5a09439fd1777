#include "profiling/regression/spans/facts.h"

#include <nlohmann/json.hpp>

namespace stadion::regression {
namespace {

using Json = nlohmann::ordered_json;

std::string asText(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

void take(const Json& summary, const char* field, const std::string& name, NamedFacts& facts) {
  if (summary.contains(field) && !summary[field].is_null()) facts[name] = asText(summary[field]);
}

std::string ofEye(const Json& entry) {
  return " " + entry.at("wall").get<std::string>() + " " + entry.at("eye").get<std::string>();
}

void takeCounts(const Json& summary, NamedFacts& counts) {
  take(summary, "frames", "frames", counts);
  take(summary, "frames_drawn", "frames drawn", counts);
  take(summary, "happened_count", "events of nodes", counts);
  const Json counters = summary.value("counters", Json::object());
  for (const auto& [name, value] : counters.items()) counts[name] = asText(value);
  for (const Json& d : summary.value("drawn", Json::array())) {
    counts["draw calls" + ofEye(d)] = asText(d.at("calls"));
    counts["instances" + ofEye(d)] = asText(d.at("instances"));
    counts["triangles" + ofEye(d)] = asText(d.at("triangles"));
  }
}

constexpr std::string_view kDrawnBy = "drawn by ";

}  // namespace

std::optional<RunFacts> factsOf(const std::string& summaryJson) try {
  const Json summary = Json::parse(summaryJson);
  if (!summary.is_object() || !summary.contains("frames")) return std::nullopt;
  RunFacts facts;
  take(summary, "state_hash", "state hash", facts.state);
  take(summary, "history_hash", "history hash", facts.state);
  for (const Json& image : summary.value("image_hashes", Json::array()))
    facts.images["image" + ofEye(image)] = asText(image.at("hash"));
  takeCounts(summary, facts.counts);
  if (summary.contains("rate_hz") && summary["rate_hz"].is_number())
    facts.rate = summary["rate_hz"].get<double>();
  for (const Json& remark : summary.value("remarks", Json::array()))
    if (const std::string text = asText(remark); text.starts_with(kDrawnBy))
      facts.renderer = text.substr(kDrawnBy.size());
  return facts;
} catch (const Json::exception&) {
  return std::nullopt;
}

}  // namespace stadion::regression
