#include "bench/comparison/comparison.h"

#include <algorithm>
#include <fmt/format.h>

namespace stadion::bench {
namespace {

const std::vector<int> kSteps{1, 2, 4, 8, 16};

/// One setting of one engine on one case, and its results by round.
struct Job {
  const EngineProgram* program;
  std::string variant;
  int n;
  std::vector<Measurement> rounds;

  bool failed() const { return !rounds.empty() && !rounds.back().played(); }
};

struct Contest {
  ListedCase about;
  std::vector<Job> jobs;

  std::vector<Measurement> medians() const {
    std::vector<Measurement> all;
    for (const Job& j : jobs) all.push_back(medianOf(j.rounds));
    return all;
  }
};

bool contains(const std::vector<int>& list, int n) {
  return std::find(list.begin(), list.end(), n) != list.end();
}

void addPeers(Contest& c, const std::vector<EngineProgram>& programs, int n) {
  for (const EngineProgram& p : programs)
    if (!p.ours)
      for (const std::string& variant : p.variants) c.jobs.push_back({&p, variant, n, {}});
}

Contest contestOn(const ListedCase& about, const std::vector<EngineProgram>& programs, bool everyStep) {
  Contest c{about, {}};
  for (const EngineProgram& p : programs)
    if (p.ours)
      for (const std::string& variant : p.variants) c.jobs.push_back({&p, variant, 1, {}});
  for (const int n : kSteps)
    if (contains(about.steps, n) && (everyStep || n == 1 || n == 4)) addPeers(c, programs, n);
  return c;
}

void playRound(Contest& c, std::size_t round, int limit) {
  for (Job& j : c.jobs)
    if (j.rounds.size() == round && !j.failed())
      j.rounds.push_back(measure(*j.program, j.variant, c.about.name, j.n, limit));
}

/// Returns true if more steps a frame could make another peer count.
bool wantsFinerPeers(const Contest& c) {
  const CaseLimits* limits = limitsFor(c.about.name);
  if (!limits || limits->cost.at == CostLimit::At::Never) return false;
  const std::vector<Measurement> all = c.medians();
  const auto mine = std::find_if(all.begin(), all.end(), isOurs);
  return mine != all.end() && mine->played() && !peerFor(*limits, all, mine->metric("err"));
}

/// The first round uses ever finer steps until a peer finishes the case.
void playFirstRound(Contest& c, const std::vector<EngineProgram>& programs, int limit) {
  playRound(c, 0, limit);
  for (const int n : kSteps) {
    if (std::any_of(c.jobs.begin(), c.jobs.end(), [n](const Job& j) { return !j.program->ours && j.n >= n; }))
      continue;
    if (!wantsFinerPeers(c)) return;
    addPeers(c, programs, n);
    playRound(c, 0, limit);
  }
}

}  // namespace

std::vector<std::string> unknownCases(const ComparisonOptions& options,
                                      const std::vector<ListedCase>& known) {
  std::vector<std::string> unknown;
  for (const std::string& name : options.cases)
    if (std::none_of(known.begin(), known.end(),
                     [&name](const ListedCase& c) { return c.name.find(name) != std::string::npos; }))
      unknown.push_back(name);
  return unknown;
}

void compareEngines(const std::vector<EngineProgram>& programs, const ComparisonOptions& options,
                    const std::function<void(const std::string&)>& progress,
                    const std::function<void(const CaseComparison&)>& done) {
  std::vector<Contest> contests;
  for (const ListedCase& c : casesOf(programs.front()))
    if (options.cases.empty() ||
        std::any_of(options.cases.begin(), options.cases.end(),
                    [&c](const std::string& part) { return c.name.find(part) != std::string::npos; }))
      contests.push_back(contestOn(c, programs, options.everyStep));
  for (int round = 0; round < options.rounds; ++round)
    for (Contest& c : contests) {
      progress(fmt::format("round {} of {}: {}", round + 1, options.rounds, c.about.name));
      if (round == 0)
        playFirstRound(c, programs, options.limit);
      else
        playRound(c, static_cast<std::size_t>(round), options.limit);
      if (round + 1 < options.rounds) continue;
      CaseComparison result{c.about.name, c.medians(), {}};
      result.verdict = judge(result.name, result.measurements);
      done(result);
    }
}

}  // namespace stadion::bench
