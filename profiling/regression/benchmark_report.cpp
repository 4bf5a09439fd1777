#include "profiling/regression/reports.h"
#include "profiling/regression/statistics/rank_test.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdlib>
#include <thread>
#include <unistd.h>

namespace stadion::regression {
namespace {

using Json = nlohmann::ordered_json;

Json contextOf(const SuiteResult& result) {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  std::array<double, 3> load{};
  if (getloadavg(load.data(), 3) != 3) load = {};
  return {{"date", result.when},
          {"host_name", host.data()},
          {"executable", result.program},
          {"num_cpus", std::thread::hardware_concurrency()},
          {"mhz_per_cpu", 0},
          {"cpu_scaling_enabled", false},
          {"caches", Json::array()},
          {"load_avg", load},
          {"library_build_type", "release"},
          {"suite", result.suite},
          {"against", result.against}};
}

/// By real time, and by processor time, which may be of several threads.
Json entry(const std::string& name, std::size_t repetitions, double ms, double processorMs) {
  return {{"name", name},     {"run_name", name}, {"run_type", "iteration"}, {"repetitions", repetitions},
          {"threads", 1},     {"iterations", 1},  {"real_time", ms},         {"cpu_time", processorMs},
          {"time_unit", "ms"}};
}

/// Without `elapsed`, from builds that do not report it, processor time stands for both.
void addStage(const std::string& name, const std::vector<double>& rounds, std::vector<double> elapsed,
              Json& benchmarks) {
  if (elapsed.size() != rounds.size()) elapsed = rounds;
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    Json e = entry(name, rounds.size(), elapsed[i], rounds[i]);
    e["repetition_index"] = i;
    benchmarks.push_back(std::move(e));
  }
  Json middle = entry(name + "_median", rounds.size(), median(elapsed), median(rounds));
  middle["run_name"] = name;
  middle["run_type"] = "aggregate";
  middle["aggregate_name"] = "median";
  middle["aggregate_unit"] = "time";
  benchmarks.push_back(std::move(middle));
}

Json checkOf(const CaseResult& c, const Check& k) {
  Json j{{"case", c.name},
         {"metric", k.metric},
         {"outcome", k.outcome == Outcome::Passed   ? "passed"
                     : k.outcome == Outcome::Failed ? "failed"
                                                    : "skipped"},
         {"said", k.said}};
  if (!k.culprit.empty()) j["moved"] = k.culprit;
  return j;
}

}  // namespace

std::string benchmarkJsonOf(const SuiteResult& result) {
  Json j{{"context", contextOf(result)},
         {"benchmarks", Json::array()},
         {"checks", Json::array()},
         {"warnings", Json::array()}};
  for (const CaseResult& c : result.cases) {
    Json whole = entry(c.name, 1, 1000 * c.seconds, 1000 * c.processorSeconds);
    if (!c.fault.empty()) {
      whole["error_occurred"] = true;
      whole["error_message"] = c.fault;
    }
    for (const auto& [name, value] : c.facts) {
      // Counters are numbers in this layout; hashes stay text.
      char* end = nullptr;
      const double number = std::strtod(value.c_str(), &end);
      const bool isHash = name.find("hash") != name.npos || name.starts_with("image ");
      whole[name] = isHash || *end ? Json(value) : Json(number);
    }
    for (const auto& [name, value] : c.frameFigures) whole[name] = value;
    for (const auto& [stage, count] : c.instructions) whole["instructions " + stage] = count;
    j["benchmarks"].push_back(std::move(whole));
    for (const auto& [stage, rounds] : c.milliseconds) {
      const auto elapsed = c.elapsedMs.find(stage);
      addStage(c.name + "/" + stage, rounds,
               elapsed == c.elapsedMs.end() ? std::vector<double>() : elapsed->second, j["benchmarks"]);
    }
    for (const Check& k : c.checks) j["checks"].push_back(checkOf(c, k));
    for (const std::string& said : c.warnings) j["warnings"].push_back({{"case", c.name}, {"said", said}});
    if (!c.fault.empty()) j["checks"].push_back(checkOf(c, {"play", Outcome::Failed, c.fault}));
  }
  return j.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace stadion::regression
