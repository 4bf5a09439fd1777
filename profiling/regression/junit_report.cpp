#include "profiling/regression/reports.h"
#include "engine/plain_text/markup_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace stadion::regression {
namespace {

std::string testCase(const std::string& suite, const CaseResult& c, const std::string& name,
                     const std::string& inside) {
  return fmt::format("    <testcase classname=\"{}.{}\" name=\"{}\" time=\"{:.3f}\"{}\n", markupText(suite),
                     markupText(c.name), markupText(name),
                     c.seconds / static_cast<double>(std::max<std::size_t>(1, c.checks.size())),
                     inside.empty() ? "/>" : ">" + inside + "</testcase>");
}

std::string insideOf(const Check& k) {
  const std::string said = markupText(k.culprit.empty() ? k.said : k.said + "; moved: " + k.culprit);
  if (k.outcome == Outcome::Failed) return fmt::format("<failure message=\"{}\"/>", said);
  if (k.outcome == Outcome::Skipped) return fmt::format("<skipped message=\"{}\"/>", said);
  return fmt::format("<system-out>{}</system-out>", said);
}

std::string testSuite(const std::string& suite, const CaseResult& c) {
  const auto count = [&](Outcome o) { return std::ranges::count(c.checks, o, &Check::outcome); };
  std::string text = fmt::format(
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{:.3f}\">\n",
      markupText(c.name), c.checks.size() + (c.fault.empty() ? 0 : 1), count(Outcome::Failed),
      c.fault.empty() ? 0 : 1, count(Outcome::Skipped), c.seconds);
  if (!c.fault.empty())
    text += testCase(suite, c, "play", fmt::format("<error message=\"{}\"/>", markupText(c.fault)));
  for (const Check& k : c.checks) text += testCase(suite, c, k.metric, insideOf(k));
  std::string warnings;
  for (const std::string& warning : c.warnings) warnings += markupText(warning) + "\n";
  if (!warnings.empty()) text += "    <system-err>" + warnings + "</system-err>\n";
  return text + "  </testsuite>\n";
}

}  // namespace

std::string junitOf(const SuiteResult& result) {
  std::size_t tests = 0;
  double seconds = 0;
  for (const CaseResult& c : result.cases) {
    tests += c.checks.size() + (c.fault.empty() ? 0 : 1);
    seconds += c.seconds;
  }
  std::string text =
      fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{}\" "
                  "tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3f}\">\n",
                  markupText(result.suite), tests, result.count(Outcome::Failed), result.faults(), seconds);
  for (const CaseResult& c : result.cases) text += testSuite(result.suite, c);
  return text + "</testsuites>\n";
}

}  // namespace stadion::regression
