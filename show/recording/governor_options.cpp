#include "show/recording/governor_options.h"

namespace stadion {

bool hasDrawnBudgets(const Scene& scene) {
  bool any = false;
  scene.tree().forEachLoad([&](const LoadedScene& load) {
    for (const auto& [position, terms] : load.terms) any |= mayBeDrawn(load.nodes[position].get());
  });
  return any;
}

GovernorOptions governorOf(const PlaySettings& play, const Player& player, std::vector<std::string> walls,
                           std::function<void(const std::string&)> say) {
  const bool live = !play.everyFrameCounts(player);
  const FrameLoopOptions loop = play.loopOptions(player);
  GovernorOptions g;
  g.rate = loop.rate;
  g.paced = loop.pace != Pace::Free;
  g.pipelined = loop.mode == Mode::Pipelined;
  g.walls = std::move(walls);
  g.stress = play.stress;
  g.acts = live && play.degradationControl;
  if (live) g.tell = std::move(say);
  return g;
}

}  // namespace stadion
