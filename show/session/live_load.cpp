#include "show/session/live_load.h"

namespace stadion {

bool hasDrawnBudgets(const Scene& scene) {
  bool any = false;
  scene.forEachLoad([&](const Load& load) {
    for (const auto& [position, terms] : load.terms) any |= mayBeDrawn(load.nodes[position].get());
  });
  return any;
}

GovernorOptions governorOf(const RunOptions& o, const Player& player, std::vector<std::string> walls) {
  const bool live = !o.everyFrameCounts(player);
  const FrameLoopOptions loop = o.loopOptions(player);
  GovernorOptions g;
  g.rate = loop.rate, g.paced = loop.pace != Pace::Free;
  g.pipelined = loop.mode == Mode::Pipelined;
  g.walls = std::move(walls);
  g.stress = o.stress;
  g.acts = live && o.loadControl;
  if (live) g.tell = o.say;
  return g;
}

}  // namespace stadion
