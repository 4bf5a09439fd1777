#include "show/player/play_settings.h"

namespace stadion {

bool PlaySettings::everyFrameCounts(const Player& player) const {
  return everyFrame || player.replaysLog();
}

bool PlaySettings::repeats(const Player& player) const {
  return everyFrameCounts(player) || (player.inputFound() && !player.inputIsLive());
}

FrameLoopOptions PlaySettings::loopOptions(const Player& player) const {
  FrameLoopOptions l = player.loopOptions();
  l.mostInFlight = mostInFlight;
  l.drawBeginsEarly = drawBeginsEarly;
  l.delivery = everyFrameCounts(player) ? Delivery::Every : Delivery::Latest;
  const bool newest = l.delivery == Delivery::Latest;
  l.everyTick = newest && repeats(player);
  // A live show that drops frames ends with its log's last moment, not with its last frame's number.
  if (newest && !l.everyTick && player.end() > 0) {
    l.frames = 0;
    l.end = player.end();
  }
  l.pace = pace;
  return l;
}

}  // namespace stadion
