#include "show/player/draw_settings.h"

namespace stadion {

HeadTiming DrawSettings::headFor(std::vector<WallView>& walls) const {
  HeadTiming head;
  head.predict = ahead;
  if (!latch) return head;
  head.latch = *latch;
  for (WallView& view : walls) view.reach = *latch;
  return head;
}

}  // namespace stadion
