#include "show/player/thread_count.h"

#include <fmt/format.h>

namespace stadion {

ThreadCount threadsOf(const DrawSetting& setting, std::size_t walls) {
  ThreadCount count;
  count.cull = count.draw = walls;
  count.rasteriser = setting.rasteriserThreads * (setting.processes ? walls : 1);
  return count;
}

ThreadCount threadsOfCpuRenderer(std::uint32_t threads, std::size_t walls) {
  ThreadCount count;
  count.cull = walls;
  count.rasteriser = threads;
  count.byCpu = true;
  return count;
}

std::string textOf(const ThreadCount& threads, std::size_t processors, const std::string& walls) {
  const std::string drawing =
      threads.byCpu ? fmt::format("{} of the CPU renderer, which draw all walls", threads.rasteriser)
                    : fmt::format("{} Draw, {} of the software rasteriser", threads.draw, threads.rasteriser);
  std::string text =
      fmt::format("threads: {} App, {} Cull, {}: {} for {} processor{}\n", threads.app, threads.cull, drawing,
                  threads.all(), processors, processors == 1 ? "" : "s");
  if (threads.all() <= processors) return text;
  text += threads.byCpu
              ? "They take turns.\n"
              : "They take turns, so walls wait for each other. stadion calibrate finds the fastest "
                "split here;\n";
  return text + fmt::format("stadion plan SHOW --walls {} --cores {} predicts a machine with a processor for "
                            "each.\n",
                            walls, threads.all());
}

}  // namespace stadion
