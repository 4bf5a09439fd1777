#include "engine/hall_formats/sgct_reader.h"
#include "tests/fuzz/hall_bytes.h"

namespace stadion::fuzz {

void sgct(Bytes bytes) {
  const HallBytes hall(bytes);
  Diagnostics findings;
  const auto read = readSgct(hall.configuration, "any.json", hall.reader(), findings);
  requireSound(read, findings);
}

}  // namespace stadion::fuzz
