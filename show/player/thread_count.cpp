#include "show/player/thread_count.h"

#include <fmt/format.h>

namespace stadion {

ThreadCount threadsOf(const DrawSetting& setting, std::size_t walls) {
  ThreadCount count;
  count.cull = count.draw = walls;
  count.rasteriser = setting.rasteriserThreads * (setting.processes ? walls : 1);
  return count;
}

std::string textOf(const ThreadCount& threads, std::size_t processors, const std::string& walls) {
  std::string text =
      fmt::format("threads: {} App, {} Cull, {} Draw, {} of the software rasteriser: {} for {} processor{}\n",
                  threads.app, threads.cull, threads.draw, threads.rasteriser, threads.all(), processors,
                  processors == 1 ? "" : "s");
  if (threads.all() > processors)
    text += fmt::format("They take turns, so walls wait for each other. stadion calibrate finds the fastest "
                        "split here;\nstadion plan SHOW --walls {} --cores {} predicts a machine with a "
                        "processor for each.\n",
                        walls, threads.all());
  return text;
}

}  // namespace stadion
