#include "engine/colour_table/cube_file.h"
#include "tests/fuzz/targets.h"

namespace stadion::fuzz {

void colour_table(Bytes bytes) {
  Diagnostics findings;
  const auto table = readCube(asText(bytes), "any.cube", findings);
  require(table.has_value() != findings.hasErrors(), "a table is read or refused with a reason");
  for (const Diagnostic& d : findings.all()) require(!format(d).empty(), "a finding says something");
  if (!table) return;
  require(!table->empty(), "a table has entries");
  require(table->curve.size() == std::size_t{table->curveSize} * 3, "a curve has all its values");
  require(table->solid.size() == std::size_t{table->solidSize} * table->solidSize * table->solidSize * 3,
          "a solid has all its values");
  const auto again = readCube(formatCube(*table), "again.cube", findings);
  require(again.has_value() && again->curve == table->curve && again->solid == table->solid &&
              again->curveRange == table->curveRange && again->solidRange == table->solidRange,
          "what is written is read again");
}

}  // namespace stadion::fuzz
