#include "cli/walls/simulate_walls.h"

#include "cli/exit_code.h"
#include "cli/findings_json.h"
#include "cli/options/value_grammar.h"
#include "cli/terminal.h"
#include "show/simulation/drawn_pictures.h"
#include "show/simulation/simulation_pictures.h"
#include "show/simulation/simulation_report.h"

#include <fmt/format.h>

#include <cstdio>

namespace stadion {
namespace {

/// Reads the faults; nothing and a finding if a number is none.
std::optional<std::vector<HallFault>> faultsOf(const SimulateOptions& o, double metresPerUnit,
                                               Diagnostics& findings) {
  std::vector<HallFault> faults;
  const auto number = [&](const std::string& word, const char* option) {
    const auto value = readDecimal(word);
    if (!value) findings.error({}, fmt::format("{}: \"{}\" is not a number", option, word));
    return value.value_or(0);
  };
  if (o.moved.size() == 4) {
    Vec3 by;
    for (int axis = 0; axis < 3; ++axis)
      by[axis] = number(o.moved[static_cast<std::size_t>(axis) + 1], "--moved") * metresPerUnit;
    faults.push_back({o.moved[0], by, {}});
  }
  if (o.wrongGamma.size() == 2) {
    const double gamma = number(o.wrongGamma[1], "--wrong-gamma");
    if (!findings.hasErrors() && !(gamma >= 0.5 && gamma <= 6))
      findings.error({}, fmt::format("--wrong-gamma: the gamma must be from 0.5 to 6, not {}", gamma));
    faults.push_back({o.wrongGamma[0], {}, gamma});
  }
  return findings.hasErrors() ? std::nullopt : std::optional(faults);
}

int failed(Diagnostics& findings, bool json) {
  printFindings(findings);
  if (json) printJson({{"ok", false}, {"findings", jsonOf(findings)}});
  return kBadInput;
}

}  // namespace

int simulateWalls(const WallFile& walls, const SimulateOptions& o) {
  Diagnostics findings;
  const auto faults = faultsOf(o, walls.metresPerUnit, findings);
  if (!faults) return failed(findings, o.json);
  SimulationSettings settings;
  settings.every = static_cast<std::uint32_t>(o.every);
  settings.heads = o.heads;
  settings.faults = *faults;
  settings.progress = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
  SimulationPictures pictures;
  if (!o.out.empty()) settings.seen = [&](const SeenPixel& pixel) { pictures.add(pixel); };
  auto source = drawnPictures(walls);
  if (!source) {
    findings.add(source.error());
    return failed(findings, o.json);
  }
  const auto result = simulateHall(walls, *source.value(), settings);
  if (!result) {
    findings.add(result.error());
    return failed(findings, o.json);
  }
  if (!o.out.empty())
    if (const auto wrong = pictures.write(o.out)) {
      findings.add(*wrong);
      return failed(findings, o.json);
    }
  if (o.json)
    printJson(jsonOf(result.value()));
  else
    std::printf("%s", textOf(result.value()).c_str());
  return kOk;
}

}  // namespace stadion
