#include "profiling/regression/spans/result.h"

#include <algorithm>

namespace stadion::regression {

bool CaseResult::failed() const {
  return std::ranges::any_of(checks, [](const Check& c) { return c.outcome == Outcome::Failed; });
}

void SuiteResult::add(CaseResult result) {
  for (const CaseResult& earlier : cases)
    std::erase_if(result.warnings, [&](const std::string& said) {
      return std::ranges::find(earlier.warnings, said) != earlier.warnings.end();
    });
  cases.push_back(std::move(result));
}

std::size_t SuiteResult::warnings() const {
  std::size_t n = 0;
  for (const CaseResult& c : cases) n += c.warnings.size();
  return n;
}

std::size_t SuiteResult::count(Outcome outcome) const {
  std::size_t n = 0;
  for (const CaseResult& c : cases)
    n += static_cast<std::size_t>(std::ranges::count(c.checks, outcome, &Check::outcome));
  return n;
}

bool SuiteResult::compared() const {
  return std::ranges::any_of(cases, [](const CaseResult& c) {
    return std::ranges::any_of(c.checks,
                               [](const Check& k) { return !k.amongModes && k.outcome != Outcome::Skipped; });
  });
}

std::size_t SuiteResult::faults() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(cases, [](const CaseResult& c) { return !c.fault.empty(); }));
}

bool SuiteResult::refused() const {
  return faults() > 0 &&
         std::ranges::none_of(cases, [](const CaseResult& c) { return !c.fault.empty() && !c.refused; });
}

}  // namespace stadion::regression
