#include "show/web/show_board.h"

#include "pipeline/projection/projection.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace stadion {

BoardShow boardShowOf(const std::string& script, const Player& player, const ShowParts& parts) {
  BoardShow show{std::filesystem::path(script).filename().string(), player.rate(), {}};
  for (const WallViews& wall : parts.walls) {
    BoardWall& listed = show.walls.emplace_back();
    listed.name = wall.camera ? "overview" : wall.name;
    const std::size_t facets = wall.projection ? wall.projection->facets().all.size() : 1;
    const std::size_t pictures = wall.views.size() / std::max<std::size_t>(1, facets);
    for (std::size_t i = 0; i < pictures; ++i) listed.views.push_back(pictures == 1 ? "" : pictureName(i));
  }
  return show;
}

void ShowBoard::setPhase(BoardPhase phase) {
  const std::lock_guard lock(mutex_);
  status_.phase = phase;
}

void ShowBoard::beginShow(BoardShow show, const BoardFrame& first) {
  const std::lock_guard lock(mutex_);
  status_ = {BoardPhase::Playing, std::move(show), first, {}, std::move(status_.hosts)};
}

bool ShowBoard::publish(const BoardFrame& frame) {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return false;
  status_.frame = frame;
  return true;
}

bool ShowBoard::publishCues(std::vector<ShowCue>& cues) {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return false;
  status_.cues.swap(cues);
  return true;
}

bool ShowBoard::publishHosts(std::vector<BoardHost>& hosts) {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return false;
  status_.hosts.swap(hosts);
  return true;
}

BoardStatus ShowBoard::read() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

}  // namespace stadion
