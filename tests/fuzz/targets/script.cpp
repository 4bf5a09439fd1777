#include "engine/script/script.h"

#include "engine/build/lint.h"
#include "tests/fuzz/built_show.h"
#include "tests/fuzz/targets.h"
#include "tests/node_types.h"

namespace stadion::fuzz {

void script(Bytes bytes) {
  static const Workshop workshop;
  auto source = SourceText::make("any.evs", asText(bytes));
  if (!source) {
    require(!format(source.error()).empty(), "a finding says something");
    return;
  }
  Diagnostics findings;
  const Document document = checkScript(std::move(source.value()), testTypes(), findings);
  lint(document, true, findings);
  if (!findings.hasErrors()) {
    lintLatencies(document, 16'666'667, findings);
    lintTrackers(document, {"head", "wand"}, "any.input", findings);
    const Built built = workshop.build(document, 1, {}, Affine::Identity(), {}, findings);
    require(built.load != nullptr, "what is right is built");
  }
  for (const Diagnostic& d : findings.all()) require(!format(d).empty(), "a finding says something");
}

}  // namespace stadion::fuzz
