#include "profiling/regression/baseline.h"

#include "engine/base/plain_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>

namespace stadion::regression {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char *kFormat = "stadion-baseline 2", *kOldFormat = "stadion-baseline 1";
constexpr std::size_t kMaxFileBytes = 64 << 20;

/// A few thousand numbers, on one line.
std::string lineOf(const std::vector<double>& values) {
  return fmt::format("{:.4g}", fmt::join(values, " "));
}

std::vector<double> numbersIn(const std::string& line) {
  std::vector<double> values;
  std::istringstream in(line);
  for (double v = 0; in >> v;) values.push_back(std::isfinite(v) ? v : 0);
  return values;
}

Json jsonOf(const KeptStage& kept) {
  Json longer = Json::array();
  for (const auto& run : kept.longer) {
    Json& of = longer.emplace_back(Json::object());
    for (const auto& [frame, excess] : run) of[std::to_string(frame)] = excess;
  }
  return {{"usual", lineOf(kept.usual)},
          {"deviation", kept.deviation},
          {"levels", lineOf(kept.levels)},
          {"longer", std::move(longer)},
          {"figures", kept.figures}};
}

KeptStage keptStageOf(const Json& j) {
  constexpr std::size_t kMostNumbered = 1'000'000;
  KeptStage kept{numbersIn(j.at("usual").get<std::string>()),
                 j.at("deviation").get<double>(),
                 numbersIn(j.at("levels").get<std::string>()),
                 {},
                 {}};
  for (const Json& run : j.at("longer")) {
    auto& of = kept.longer.emplace_back();
    for (const auto& [frame, excess] : run.items())
      if (const auto n = std::strtoull(frame.c_str(), nullptr, 10); n < kMostNumbered)
        of[n] = excess.get<double>();
  }
  j.at("figures").get_to(kept.figures);
  return kept;
}

BaselineCase caseOf(const Json& j) {
  BaselineCase c;
  c.facts.renderer = j.at("renderer").get<std::string>();
  j.at("state").get_to(c.facts.state);
  j.at("images").get_to(c.facts.images);
  j.at("counts").get_to(c.facts.counts);
  c.states = j.value("states", "");
  if (j.contains("fields"))
    for (const auto& [frame, text] : j.at("fields").items())
      c.fields[std::strtoull(frame.c_str(), nullptr, 10)] = text.get<std::string>();
  if (j.contains("times")) j.at("times").get_to(c.times);
  if (j.contains("frames"))
    for (const auto& [stage, clocks] : j.at("frames").items())
      for (const auto& [clock, kept] : clocks.items()) c.frames[stage][clock] = keptStageOf(kept);
  if (j.contains("instructions")) j.at("instructions").get_to(c.instructions);
  c.countedBy = j.value("counted_by", c.countedBy);
  if (j.contains("node_times")) j.at("node_times").get_to(c.nodeTimes);
  if (j.contains("node_instructions")) j.at("node_instructions").get_to(c.nodeInstructions);
  return c;
}

Json jsonOf(const BaselineCase& c) {
  Json j{{"renderer", c.facts.renderer},
         {"state", c.facts.state},
         {"images", c.facts.images},
         {"counts", c.facts.counts}};
  if (!c.states.empty()) j["states"] = c.states;
  for (const auto& [frame, text] : c.fields) j["fields"][std::to_string(frame)] = text;
  if (!c.times.empty()) j["times"] = c.times;
  for (const auto& [stage, clocks] : c.frames)
    for (const auto& [clock, kept] : clocks) j["frames"][stage][clock] = jsonOf(kept);
  if (!c.instructions.empty()) {
    j["instructions"] = c.instructions;
    j["counted_by"] = c.countedBy;
  }
  if (!c.nodeTimes.empty()) j["node_times"] = c.nodeTimes;
  if (!c.nodeInstructions.empty()) j["node_instructions"] = c.nodeInstructions;
  return j;
}

Diagnostic refused(const std::string& path, const std::string& why) {
  return {
      Severity::Error, {path, 0, 0}, "is no baseline: " + why + "; remove it, and --update writes one", {}};
}

}  // namespace

Result<Baseline> readBaseline(const std::string& path) try {
  const Result<std::string> text = readPlainFile(path, kMaxFileBytes);
  if (!text) return text.error();
  const Json j = Json::parse(text.value());
  const std::string format = j.is_object() ? j.value("format", "") : "";
  if (format.starts_with("stadion-baseline ") && format != kFormat && format != kOldFormat)
    return refused(path, "its format is \"" + format + "\", and this build reads versions 1 and 2");
  if (format != kFormat && format != kOldFormat)
    return refused(path, std::string("its format is not \"") + kFormat + "\"");
  Baseline baseline;
  for (const auto& [name, value] : j.at("cases").items()) baseline[name] = caseOf(value);
  return baseline;
} catch (const Json::exception& e) {
  return refused(path, e.what());
}

std::string toJson(const Baseline& baseline) {
  Json j{{"format", kFormat}, {"cases", Json::object()}};
  for (const auto& [name, c] : baseline) j["cases"][name] = jsonOf(c);
  return j.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void takeUp(const RunFacts& found, const Metrics& asked, const SuiteCase& played, const std::string& name,
            Baseline& baseline) {
  const auto [at, isNew] = baseline.try_emplace(name);
  BaselineCase& c = at->second;
  if (isNew || asked.state) c.facts.state = found.state;
  if (isNew || asked.images) {
    c.facts.images = found.images;
    c.facts.renderer = found.renderer;
  }
  if (isNew || asked.counts) c.facts.counts = found.counts;
  if (asked.times && !played.metrics.times) {
    c.times.clear();
    c.frames.clear();
    c.nodeTimes.clear();
  }
  if (asked.instructions && !played.metrics.instructions) {
    c.instructions.clear();
    c.nodeInstructions.clear();
  }
}

std::vector<std::string> othersThan(const Suite& suite, const Baseline& baseline) {
  std::set<std::string> known;
  for (const SuiteCase& c : suite.cases)
    for (const std::string& mode : c.modes) known.insert(playedName(c, mode));
  std::vector<std::string> others;
  for (const auto& [name, c] : baseline)
    if (!known.contains(name)) others.push_back(name);
  return others;
}

std::string baselineBeside(const std::string& suiteFile) {
  std::filesystem::path path = suiteFile;
  if (path.extension() == ".suite") path.replace_extension();
  return path.string() + ".baseline.json";
}

}  // namespace stadion::regression
