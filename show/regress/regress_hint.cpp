#include "show/regress/regress_hint.h"

#include "show/regress/regress_child.h"

#include <algorithm>
#include <map>

namespace stadion {
namespace {

using namespace regression;

std::vector<SpanRow> profiled(const SuiteCase& c, const std::string& program, std::chrono::seconds limit,
                              const std::atomic<bool>& stop) {
  std::vector<std::string> words = playWords(program, c, "sequential");
  words[1] = "profile";
  const auto pace = std::ranges::find(words, "--pace");
  words.erase(pace, pace + 2);
  return profileRows(runChild(words, limit, stop).out);
}

}  // namespace

ProfileOfBoth::ProfileOfBoth(const SuiteCase& c, const std::string& before, const std::string& now,
                             std::chrono::seconds limit, const std::atomic<bool>& stop)
    : before_(profiled(c, before, limit, stop)), now_(profiled(c, now, limit, stop)) {}

std::string ProfileOfBoth::grewMost(const std::string& stage, const std::string& wall) const {
  std::map<std::string, double> was;  // [ms], both eyes together
  const auto nodeOf = [](const SpanRow& r) { return r.path + "|" + r.file + ":" + std::to_string(r.line); };
  double whole = 0;
  for (const SpanRow& r : before_)
    if (r.stage == stage && r.wall == wall) r.isStage() ? whole -= r.msMean : was[nodeOf(r)] -= r.msMean;
  const SpanRow* most = nullptr;
  for (const SpanRow& r : now_)
    if (r.stage == stage && r.wall == wall) r.isStage() ? whole += r.msMean : was[nodeOf(r)] += r.msMean;
  for (const SpanRow& r : now_)
    if (!r.isStage() && r.stage == stage && r.wall == wall && (!most || was[nodeOf(r)] > was[nodeOf(*most)]))
      most = &r;
  if (!most || whole <= 0 || was[nodeOf(*most)] < whole / 2) return {};
  return most->path + " (" + most->file + ":" + std::to_string(most->line) + ")";
}

}  // namespace stadion
