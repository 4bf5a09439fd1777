#include "cli/bench/looks_scenes.h"

#include "bench/walls/wall_files.h"
#include "cli/terminal.h"
#include "engine/base/installed_files.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr std::size_t kSlot = 0;  ///< App and Cull take turns, so that one slot serves
constexpr std::size_t kWallsOfRoom = 4;
constexpr std::size_t kMostFrames =
    700;  ///< length of the visitor's path: the moment, and what --frames may add

}  // namespace

const std::vector<LooksScene>& allLooksScenes() {
  static const std::vector<LooksScene> scenes{
      {"kick", "kick.evs", {"right", "front"}, 2.5},
      {"olympia-1", "olympia.evs", {"right", "front"}, 4},
      {"olympia-2", "olympia.evs", {"right", "front"}, 18},
      {"olympia-3", "olympia.evs", {"right", "front"}, 32},
      {"olympia-4", "olympia.evs", {"right", "front"}, 46},
      {"olympia-5", "olympia.evs", {"right", "front"}, 60},
      {"olympia-6", "olympia.evs", {"right", "front"}, 74},
      {"crowd", "crowd.evs", {"front"}, 2},
      {"a", "", {"right", "front"}, 1},
      {"b", "", {"right", "front"}, 1},
      {"c", "", {"right", "front"}, 1},
  };
  return scenes;
}

std::unique_ptr<LooksShow> LooksShow::open(const LooksScene& scene, const std::string& size,
                                           Diagnostics& findings) {
  std::unique_ptr<LooksShow> show(new LooksShow);
  ShowOptions options;
  options.walls = "cave4";
  options.script = shareFolder() + "/scripts/" + std::string(scene.script);
  if (scene.script.empty()) {
    options.script = show->folder_.path("show.evs");
    options.walls = show->folder_.path("room.walls");
    const bench::WallScene walls{.letter = scene.name.front()};
    if (const std::string wrong =
            writeWallScene(show->folder_.path(""), walls, kWallsOfRoom, false, kMostFrames);
        !wrong.empty())
      return findings.error({}, wrong), nullptr;
  }
  options.onlyWalls = scene.walls;
  options.size = size;
  if (!options.complete(findings)) return nullptr;
  show->player_ = Player::create(options, findings, printFindings);
  if (!show->player_) return nullptr;
  ShowParts parts = show->player_->parts(StereoLayout::Pair);
  show->size_ = {parts.walls.front().width, parts.walls.front().height};
  show->stages_ = std::make_unique<ShowStages>(std::move(parts));
  return show;
}

void LooksShow::playFrame() {
  now_ = signatureAt(frames_++, player_->rate());
  stages_->app(now_, kSlot);
}

void LooksShow::playTo(double seconds) {
  do playFrame();
  while (toSeconds(now_.time) < seconds);
}

DrawList LooksShow::listOf(const std::string& wall) {
  const std::vector<std::string> names = player_->walls().names();
  DrawList list;
  list.ticket.signature = now_;
  stages_->cull(static_cast<std::size_t>(std::ranges::find(names, wall) - names.begin()), kSlot, list);
  return list;
}

}  // namespace stadion
