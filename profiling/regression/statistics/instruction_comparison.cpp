#include "profiling/regression/statistics/instruction_comparison.h"

#include <fmt/format.h>

#include <algorithm>

namespace stadion::regression {
std::map<std::string, double> stageInstructions(const std::vector<SpanRow>& rows) {
  std::map<std::string, double> all;
  for (const SpanRow& r : rows)
    if (r.isStage() && r.stage != "swap" && r.instructions > 0) all[r.name()] = r.instructions;
  return all;
}

InstructionCounts instructionCounts(const std::vector<SpanRow>& rows) {
  return {stageInstructions(rows), nodeInstructions(rows)};
}

std::vector<InstructionShift> compareInstructions(const InstructionCounts& before,
                                                  const std::vector<SpanRow>& now, double tolerance) {
  const InstructionCounts counted = instructionCounts(now);
  std::vector<InstructionShift> shifts;
  for (const auto& [name, count] : counted.stages) {
    const auto at = before.stages.find(name);
    if (at == before.stages.end()) continue;
    InstructionShift s{name, at->second, count};
    const bool judged = std::max(s.before, s.now) >= kFewest;
    s.more = judged && s.shift() > tolerance;
    s.fewer = judged && s.shift() < -tolerance;
    if (s.more) s.culprit = culpritSince(name, s.before, s.now - s.before, before.nodes, counted.nodes, now);
    shifts.push_back(std::move(s));
  }
  return shifts;
}

std::vector<Check> checksOf(const std::vector<InstructionShift>& shifts, const std::string& with,
                            double tolerance) {
  std::vector<Check> checks;
  for (const InstructionShift& s : shifts) {
    Check c{"instructions of " + s.name, s.more ? Outcome::Failed : Outcome::Passed, {}, s.culprit};
    if (s.more) c.figures = {s.name + " [instructions]"};
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
