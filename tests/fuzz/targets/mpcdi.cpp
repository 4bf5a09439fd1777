#include "engine/hall_formats/mpcdi_reader.h"
#include "tests/fuzz/hall_bytes.h"

namespace stadion::fuzz {

void mpcdi(Bytes bytes) {
  Diagnostics findings;
  if (asText(bytes).starts_with("PK")) {
    const std::string archive(asText(bytes));
    return requireSound(readMpcdi(archive, "any.mpcdi", findings), findings);
  }
  const HallBytes hall(bytes);
  const auto read = readMpcdiXml(hall.configuration, "any.mpcdi.xml", hall.reader(), findings);
  requireSound(read, findings);
}

}  // namespace stadion::fuzz
