#include "profiling/regression/instruction_comparison.h"

#include "profiling/regression/time_comparison.h"

#include <fmt/format.h>

#include <algorithm>

namespace stadion::regression {
namespace {

/// By how much each node's row of the stage grew.
std::string culpritOf(const SpanRow& stage, const std::vector<SpanRow>& before,
                      const std::vector<SpanRow>& now, double growth) {
  std::map<std::string, double> was;
  for (const SpanRow& r : before) was[r.key()] = r.instructions;
  std::vector<std::pair<SpanRow, double>> grown;
  for (const SpanRow& r : now)
    if (!r.isStage() && r.stage == stage.stage && r.wall == stage.wall)
      grown.emplace_back(r, r.instructions - was[r.key()]);
  return culpritIn(stage.name(), grown, growth);
}

}  // namespace

std::map<std::string, double> stageInstructions(const std::vector<SpanRow>& rows) {
  std::map<std::string, double> all;
  for (const SpanRow& r : rows)
    if (r.isStage() && r.stage != "swap" && r.instructions > 0) all[r.name()] = r.instructions;
  return all;
}

std::vector<InstructionShift> compareInstructions(const std::map<std::string, double>& before,
                                                  const std::map<std::string, double>& now,
                                                  double tolerance) {
  std::vector<InstructionShift> shifts;
  for (const auto& [name, count] : now) {
    const auto at = before.find(name);
    if (at == before.end()) continue;
    InstructionShift s{name, at->second, count};
    const bool judged = std::max(s.before, s.now) >= kFewest;
    s.more = judged && s.shift() > tolerance, s.fewer = judged && s.shift() < -tolerance;
    if (s.more) s.culprit = name;
    shifts.push_back(std::move(s));
  }
  return shifts;
}

std::vector<InstructionShift> compareInstructions(const std::vector<SpanRow>& before,
                                                  const std::vector<SpanRow>& now, double tolerance) {
  auto shifts = compareInstructions(stageInstructions(before), stageInstructions(now), tolerance);
  for (InstructionShift& s : shifts)
    for (const SpanRow& r : now)
      if (s.more && r.isStage() && r.name() == s.name)
        s.culprit = culpritOf(r, before, now, s.now - s.before);
  return shifts;
}

std::vector<Check> checksOf(const std::vector<InstructionShift>& shifts, const std::string& with,
                            double tolerance) {
  std::vector<Check> checks;
  for (const InstructionShift& s : shifts) {
    Check c{"instructions of " + s.name, s.more ? Outcome::Failed : Outcome::Passed, {}, s.culprit};
    c.said = fmt::format("{:+.2f} % against {} ({:.0f} a frame), tolerance {:g} %{}", 100 * s.shift(), with,
                         s.before, 100 * tolerance, s.fewer ? ": fewer" : "");
    if (std::max(s.before, s.now) < kFewest) {
      c.outcome = Outcome::Skipped;
      c.said = fmt::format("{:.0f} a frame are too few to be judged", s.now);
    }
    checks.push_back(std::move(c));
  }
  return checks;
}

}  // namespace stadion::regression
