#include "engine/hall_formats/ndisplay_reader.h"
#include "tests/fuzz/hall_bytes.h"

namespace stadion::fuzz {

void ndisplay(Bytes bytes) {
  const HallBytes hall(bytes);
  Diagnostics findings;
  const auto reader = hall.configuration.starts_with('{') ? readNdisplayJson : readNdisplayCfg;
  const auto read = reader(hall.configuration, "any.ndisplay", hall.reader(), findings);
  requireSound(read, findings);
}

}  // namespace stadion::fuzz
