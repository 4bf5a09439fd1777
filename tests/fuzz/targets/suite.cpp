#include "profiling/regression/suite.h"

#include "tests/fuzz/targets.h"

namespace stadion::fuzz {

void suite(Bytes bytes) {
  Diagnostics findings;
  const auto read = regression::parseSuite(asText(bytes), "folder/any.suite", findings);
  require(read.has_value() || findings.hasErrors(), "what is refused has a reason");
  for (const Diagnostic& d : findings.all()) require(!format(d).empty(), "a finding says something");
  if (!read) return;
  for (const regression::SuiteCase& c : read->cases) {
    require(!c.name.empty() && !c.show.empty() && !c.modes.empty(), "a case has a name, a show and a mode");
    require(c.frames <= 1'000'000 && c.rate >= 0 && c.rate <= 1000, "figures are in their ranges");
  }
}

}  // namespace stadion::fuzz
