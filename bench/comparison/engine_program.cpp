#include "bench/comparison/engine_program.h"

#include "bench/comparison/program_output.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

namespace stadion::bench {
namespace {

std::vector<nlohmann::json> objectsIn(const std::string& text) {
  std::vector<nlohmann::json> objects;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
    if (json.is_object()) objects.push_back(std::move(json));
  }
  return objects;
}

}  // namespace

std::vector<EngineProgram> enginePrograms(const std::string& folder) {
  std::vector<EngineProgram> programs;
  for (const char* engine : {"stadion", "bullet", "ode", "mujoco"}) {
    EngineProgram p;
    p.path = folder + "/stadion-dyn-" + engine;
    p.ours = std::string(engine) == "stadion";
    if (!std::filesystem::exists(p.path)) continue;
    for (const nlohmann::json& line : objectsIn(outputOf({{p.path, "--list"}})))
      if (line.contains("engine")) p.variants.push_back(line["engine"]);
    programs.push_back(std::move(p));
  }
  return programs;
}

std::vector<ListedCase> casesOf(const EngineProgram& program) {
  std::vector<ListedCase> cases;
  for (const nlohmann::json& line : objectsIn(outputOf({{program.path, "--list"}})))
    if (line.contains("case")) cases.push_back({line["case"], line["steps"].get<std::vector<int>>()});
  return cases;
}

Measurement measure(const EngineProgram& program, const std::string& variant, const std::string& caseName,
                    int n, int limit) {
  std::istringstream lines(outputOf({{program.path, caseName, "--exact", "--engine", variant, "--steps",
                                      std::to_string(n), "--limit", std::to_string(limit)}}));
  for (std::string line; std::getline(lines, line);)
    if (const auto found = parseMeasurement(line)) return *found;
  Measurement none;
  none.engine = variant;
  none.caseName = caseName;
  none.n = n;
  none.crash = -1;
  return none;
}

}  // namespace stadion::bench
