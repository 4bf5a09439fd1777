#include "cli/bench/looks_scenes.h"

#include "bench/walls/wall_files.h"
#include "cli/terminal.h"
#include "engine/base/atomic_file.h"
#include "engine/base/installed_files.h"
#include "engine/base/plain_file.h"

#include <algorithm>
#include <fmt/format.h>

namespace stadion {
namespace {

constexpr std::size_t kSlot = 0;  ///< App and Cull take turns, so that one slot serves
constexpr std::size_t kWallsOfRoom = 4;
constexpr std::size_t kMostScriptBytes = 1 << 20;
constexpr std::size_t kMostFrames =
    700;  ///< length of the visitor's path: the moment, and what --frames may add

/// The stadium of Olympia, filled to the last row: its spectators once more in 22 places between those that
/// sit there. So it has ten times as many triangles.
std::string filledStadium(const std::string& olympia) {
  constexpr int kAlong = 11, kUp = 2;
  std::string script = olympia;
  for (int i = 0; i < kAlong; ++i)
    for (int k = 0; k < kUp; ++k)
      for (const char* part : {"north_1", "north_2", "south_1", "south_2"})
        script += fmt::format("object( file=crowd_{}.glb, position=\"{:.2f}, {:.2f}, {:.2f}\" )\n", part,
                              (part[0] == 'n' ? 0.6 : -0.6) * k, 0.6 * (i - kAlong / 2) + 0.3, 0.15 * k);
  return script;
}

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
      {"filled", "", {"right", "front"}, 4},
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
  if (scene.script.empty())
    if (const std::string wrong = show->writeScene(scene, options); !wrong.empty())
      return findings.error({}, wrong), nullptr;
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

/// Writes the files of a scene without a script of its own, and names them in the options. Returns what is
/// wrong.
std::string LooksShow::writeScene(const LooksScene& scene, ShowOptions& options) const {
  options.script = folder_.path("show.evs");
  if (scene.name.size() == 1) {
    options.walls = folder_.path("room.walls");
    return bench::writeWallScene(folder_.path(""), bench::WallScene{.letter = scene.name.front()},
                                 kWallsOfRoom, false, kMostFrames);
  }
  const std::string scripts = shareFolder() + "/scripts";
  options.assetRoots = {scripts, shareFolder() + "/assets"};
  options.input = scripts + "/olympia.input";
  const auto olympia = readPlainFile(scripts + "/olympia.evs", kMostScriptBytes);
  if (!olympia) return olympia.error().message;
  const auto wrong = writeFile(options.script, filledStadium(olympia.value()));
  return wrong ? wrong->message : "";
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
