#pragma once
/// The threads of a pipelined run, beside the processors that they share.
///
/// Threads  pure functions.

#include "pipeline/platform/draw_setting.h"

#include <cstddef>
#include <string>

namespace stadion {

struct ThreadCount {
  std::size_t app = 1;   ///< App; its worker pool computes only while App waits
  std::size_t cull = 0;  ///< Cull threads, one for each wall
  std::size_t draw = 0;  ///< Draw threads, one for each wall, in this program or in a process of its own
  std::size_t rasteriser = 0;  ///< rasteriser threads of this program, or of all wall processes together
  /// The CPU renderer draws. Draw threads are among its threads while they draw, and are not counted.
  bool byCpu = false;

  std::size_t all() const { return app + cull + draw + rasteriser; }
};

ThreadCount threadsOf(const DrawSetting& setting, std::size_t walls);
ThreadCount threadsOfCpuRenderer(std::uint32_t threads, std::size_t walls);

/// Returns a line with the counts and the processors. If there are more threads than processors, a second
/// line gives advice; `walls` is the name that the user gave the wall file.
std::string textOf(const ThreadCount& threads, std::size_t processors, const std::string& walls);

}  // namespace stadion
