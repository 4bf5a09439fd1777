#include "profiling/regression/suite_progress.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace stadion::regression {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const CaseResult& r) {
  Json j{{"name", r.name},
         {"seconds", r.seconds},
         {"milliseconds", r.milliseconds},
         {"facts", r.facts},
         {"instructions", r.instructions},
         {"processor_seconds", r.processorSeconds},
         {"elapsed_ms", r.elapsedMs},
         {"frame_figures", r.frameFigures},
         {"warnings", r.warnings},
         {"checks", Json::array()}};
  for (const Check& c : r.checks)
    j["checks"].push_back(Json{{"metric", c.metric},
                               {"outcome", static_cast<int>(c.outcome)},
                               {"said", c.said},
                               {"culprit", c.culprit},
                               {"figures", c.figures},
                               {"among_modes", c.amongModes}});
  return j;
}

CaseResult resultOf(const Json& j) {
  CaseResult r;
  j.at("name").get_to(r.name);
  j.at("seconds").get_to(r.seconds);
  j.at("milliseconds").get_to(r.milliseconds);
  j.at("facts").get_to(r.facts);
  j.at("instructions").get_to(r.instructions);
  j.at("processor_seconds").get_to(r.processorSeconds);
  j.at("elapsed_ms").get_to(r.elapsedMs);
  j.at("frame_figures").get_to(r.frameFigures);
  j.at("warnings").get_to(r.warnings);
  for (const Json& c : j.at("checks"))
    r.checks.push_back({c.at("metric"), static_cast<Outcome>(std::clamp(c.at("outcome").get<int>(), 0, 2)),
                        c.at("said"), c.at("culprit"), c.at("figures"), c.value("among_modes", false)});
  return r;
}

}  // namespace

std::string progressHeading(const std::string& identity) {
  return Json{{"suite", identity}}.dump() + "\n";
}

std::string progressLine(const std::string& caseName, const std::vector<CaseResult>& results) {
  if (std::ranges::any_of(results, [](const CaseResult& r) { return !r.fault.empty(); })) return {};
  Json j{{"case", caseName}, {"results", Json::array()}};
  for (const CaseResult& r : results) j["results"].push_back(jsonOf(r));
  return j.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

DoneCases readProgress(const std::string& text, const std::string& identity) {
  const std::string heading = progressHeading(identity);
  DoneCases done;
  if (!text.starts_with(heading)) return done;
  for (std::size_t at = heading.size(); at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    try {
      const Json j = Json::parse(text.substr(at, end - at));
      std::vector<CaseResult> results;
      for (const Json& r : j.at("results")) results.push_back(resultOf(r));
      done[j.at("case").get<std::string>()] = std::move(results);
    } catch (const Json::exception&) {
      // An incomplete line.
    }
    at = end + 1;
  }
  return done;
}

}  // namespace stadion::regression
