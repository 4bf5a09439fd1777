#include "show/player/draw_settings.h"

namespace stadion {

HeadTiming DrawSettings::headFor(std::vector<WallViews>& walls) const {
  HeadTiming head;
  head.predict = ahead;
  if (!latch) return head;
  head.latch = *latch;
  for (WallViews& wall : walls) wall.reach = *latch;
  return head;
}

}  // namespace stadion
