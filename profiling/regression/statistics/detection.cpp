#include "profiling/regression/statistics/detection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace stadion::regression {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kNothing = "nothing";

/// Named nodes that are visited in every frame, in a fixed order.
std::vector<const SpanRow*> candidates(const std::vector<SpanRow>& rows) {
  std::size_t frames = 0;
  for (const SpanRow& r : rows)
    if (r.isStage() && r.stage == "app") frames = r.count;
  std::vector<const SpanRow*> all;
  for (const SpanRow& r : rows)
    if (!r.path.empty() && r.stage == "app" && r.count == frames) all.push_back(&r);
  std::ranges::sort(all, {}, [](const SpanRow* r) { return r->key(); });
  return all;
}

std::vector<const SpanRow*> stages(const std::vector<SpanRow>& rows, const std::string& stage) {
  std::vector<const SpanRow*> all;
  for (const SpanRow& r : rows)
    if (r.isStage() && r.stage == stage) all.push_back(&r);
  return all;
}

}  // namespace

std::vector<Trial> trialsOf(std::size_t planted, std::size_t same) {
  std::vector<Trial> trials;
  const std::size_t rounds = std::max<std::size_t>(1, planted);
  std::size_t sameDone = 0;
  for (std::size_t i = 0; i < rounds; ++i) {
    if (i < planted)
      for (const char* kind : {"simulate", "cull", "draw"}) trials.push_back({kind, i});
    for (; sameDone < same * (i + 1) / rounds; ++sameDone) trials.push_back({kNothing, sameDone});
  }
  return trials;
}

// Every node gets one turn before any gets a second.
std::optional<PlantedDelay> plantedIn(const Trial& trial, const std::vector<SpanRow>& rows,
                                      const StagePrices& prices, double share) {
  PlantedDelay planted;
  if (trial.kind == "simulate") {
    const auto nodes = candidates(rows);
    if (nodes.empty()) return std::nullopt;
    planted.where = PlantedDelay::Where::Simulate;
    planted.name = nodes[trial.number * 7 % nodes.size()]->path;
  } else {
    const auto walls = stages(rows, trial.kind);
    if (walls.empty()) return std::nullopt;
    planted.where = trial.kind == "cull" ? PlantedDelay::Where::Cull : PlantedDelay::Where::Draw;
    planted.name = walls[trial.number % walls.size()]->wall;
  }
  const auto price = prices.stages.find(stageOf(planted));
  if (price == prices.stages.end() || prices.iteration <= 0) return std::nullopt;
  planted.iterations =
      static_cast<std::uint64_t>(std::max(1.0, std::round(price->second * share / prices.iteration)));
  return planted;
}

std::string stageOf(const PlantedDelay& planted) {
  if (planted.where == PlantedDelay::Where::Simulate) return "app";
  return (planted.where == PlantedDelay::Where::Cull ? "cull of wall " : "draw of wall ") + planted.name;
}

std::string toText(const PlantedDelay& planted) {
  const char* where = planted.where == PlantedDelay::Where::Simulate ? "simulate"
                      : planted.where == PlantedDelay::Where::Cull   ? "cull"
                                                                     : "draw";
  return fmt::format("{}:{}={}", where, planted.name, planted.iterations);
}

bool isNamedBy(const PlantedDelay& planted, const std::string& alarm) {
  if (planted.where == PlantedDelay::Where::Simulate)
    return alarm.starts_with(planted.name + " (") && alarm.ends_with(" in app");
  return alarm == stageOf(planted);
}

std::string toJsonLine(const TrialResult& r) {
  return Json{{"trial", r.trial},     {"kind", r.kind},       {"by", r.by},
              {"share", r.share},     {"planted", r.planted}, {"lengthened", r.lengthened},
              {"alarms", r.alarms},   {"seen", r.seen},       {"right", r.right},
              {"seconds", r.seconds}, {"program", r.program}}
             .dump(-1, ' ', false, Json::error_handler_t::replace) +
         "\n";
}

std::vector<TrialResult> readTrials(const std::string& text) {
  std::vector<TrialResult> all;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    try {
      const Json j = Json::parse(text.substr(at, end - at));
      all.push_back({j.at("trial"), j.at("kind"), j.at("planted"), j.at("alarms"), j.at("seen"),
                     j.at("right"), j.at("seconds"), j.at("by"), j.at("share"), j.at("lengthened"),
                     j.value("program", "")});
    } catch (const Json::exception&) {
      // An incomplete line, from an interrupted experiment.
    }
    at = end + 1;
  }
  return all;
}

std::string detectionTable(const std::vector<TrialResult>& results, std::size_t planted, std::size_t same,
                           bool& met) {
  met = true;
  double seconds = 0;
  std::string text = "planted in     trials  really planted      valid  found, right place named   limit\n";
  const auto count = [&](const std::string& kind, bool right) {
    return static_cast<std::size_t>(std::ranges::count_if(
        results, [&](const TrialResult& r) { return r.kind == kind && r.valid() && (!right || r.right); }));
  };
  const std::size_t least = planted - planted / 20;
  for (const char* kind : {"simulate", "cull", "draw"}) {
    if (planted == 0) break;
    const std::size_t valid = count(kind, false), right = count(kind, true);
    const bool ok = valid >= planted && right >= least;
    met = met && ok;
    std::vector<double> share;
    for (const TrialResult& r : results)
      if (r.kind == kind) share.push_back(r.lengthened);
    const auto [low, high] =
        share.empty() ? std::pair(0.0, 0.0) : std::pair(std::ranges::min(share), std::ranges::max(share));
    text += fmt::format("{:<12} {:>8}  {:>5.2f} to {:>5.2f} % {:>7}  {:>24}   at least {:>3}  {}\n", kind,
                        share.size(), low, high, valid, right, least, ok ? "ok" : "MISSED");
  }
  const std::size_t alarms = count(kNothing, false) - count(kNothing, true), most = same / 100;
  met = met && alarms <= most && count(kNothing, false) >= same;
  text += fmt::format("{:<12} {:>8}  {:>16} {:>7}  {:>11} false alarms   at most {:>4}  {}\n", kNothing,
                      count(kNothing, false), "-", "-", alarms, most, alarms <= most ? "ok" : "MISSED");
  for (const TrialResult& r : results) {
    seconds += r.seconds;
    if (!r.valid())
      text += fmt::format("  {}: not valid, {:.2f} % were planted\n", r.trial, r.lengthened);
    else if (!r.right)
      text += fmt::format("  {}: planted {}, moved: {}\n", r.trial, r.planted.empty() ? kNothing : r.planted,
                          r.alarms.empty() ? kNothing : fmt::format("{}", fmt::join(r.alarms, "; ")));
  }
  return text + fmt::format("{:.1f} minutes\n", seconds / 60);
}

}  // namespace stadion::regression
