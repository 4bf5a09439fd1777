#include "show/session/session_settings.h"

namespace stadion {

DrawingNeeds SessionSettings::drawingNeeds(std::size_t walls) const {
  DrawingNeeds needs;
  needs.walls = walls;
  needs.look = show.look;
  needs.wishes.rasteriserThreads = draw.rasteriserThreads;
  needs.wishes.processes = draw.processes;
  const bool inTurn = play.display || (show.mode == Mode::Sequential && !draw.processes.value_or(false));
  if (draw.pinned || inTurn) needs.wishes.pinned = draw.pinned.value_or(false);
  if (draw.processes) return needs;
  if (play.display) needs.here = "--display draws into windows of this program";
  if (show.mode == Mode::Sequential) needs.here = "--mode sequential does everything in one thread";
  if (play.guard) needs.here = "--guard watches the stages of this program";
  if (record.measuresDrawing()) needs.here = "what is measured looks into the drawing";
  return needs;
}

std::optional<WallProcesses>
SessionSettings::wallProcesses(const Player& player, const DrawSetting& setting, RendererKind renderer,
                               std::function<void(const std::string&)> say) const {
  if (!setting.processes) return {};
  WallProcesses w;
  w.rasteriserThreads = setting.rasteriserThreads;
  w.renderer = renderer;
  w.everyFrame = play.everyFrameCounts(player) || !cluster.file.empty();
  w.rate = player.rate();
  w.tell = [say = std::move(say)](const std::string& what) { say("stadion: " + what); };
  return w;
}

}  // namespace stadion
