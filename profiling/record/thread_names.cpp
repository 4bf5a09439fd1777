#include "profiling/record/thread_names.h"

#include <algorithm>

namespace stadion {

void ThreadNames::see(std::size_t track, const SpanRecord& r) {
  Seen& seen = seen_[track];
  if (r.what == Span::App) seen.app = true;
  if (r.what == Span::Cull) seen.cull = r.wall;
  if (r.what == Span::Draw) seen.draw = r.wall;
}

std::string ThreadNames::wallName(std::uint32_t wall) const {
  return wall < walls_.size() ? walls_[wall] : "wall " + std::to_string(wall);
}

std::vector<ThreadNames::Thread> ThreadNames::threads() const {
  std::vector<std::pair<std::uint32_t, Thread>> placed;
  std::uint32_t helpers = 0;
  for (const auto& [track, seen] : seen_)
    if (seen.app && (seen.cull || seen.draw))
      placed.push_back({0, {track, "App, Cull, Draw"}});
    else if (seen.app)
      placed.push_back({0, {track, "App"}});
    else if (seen.cull)
      placed.push_back({1000 + *seen.cull, {track, "Cull " + wallName(*seen.cull)}});
    else if (seen.draw)
      placed.push_back({2000 + *seen.draw, {track, "Draw " + wallName(*seen.draw)}});
    else {
      ++helpers;
      placed.push_back({helpers, {track, "App helper " + std::to_string(helpers)}});
    }
  std::ranges::stable_sort(placed, {}, [](const auto& p) { return p.first; });
  std::vector<Thread> threads;
  for (auto& [place, thread] : placed) threads.push_back(std::move(thread));
  return threads;
}

}  // namespace stadion
