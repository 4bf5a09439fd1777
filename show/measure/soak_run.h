#pragma once
/// Plays shows for very many frames, for `stadion soak`, and counts what must not change.
///
/// Method   visits of three kinds take turns: pipelined and long, sequential and short, and short ones whose
///          wall processes are killed. The visitor does the same in all of them, so the same frame of a show
///          must have the same history of states.
/// Threads  App's; playSoak() returns after the last frame.
/// Errors   playSoak() returns false if a show could not be played; the reporter has received the reason.

#include "pipeline/shader/look.h"
#include "show/base/reporter.h"
#include "show/base/standard_nodes.h"
#include "show/measure/soak_record.h"
#include "show/player/show_renderer.h"

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

namespace stadion {

struct SoakPlan {
  std::vector<std::string> shows;  ///< scripts, played in turns
  SharedTypes types = standardNodes();
  std::uint64_t frames = 1'000'000;
  std::uint64_t visit = 400'000;  ///< frames of a long visit
  Look look = Look::Plain;
};

/// Goes on from the record's counts until the plan's frames have been played or `stop` is set.
bool playSoak(const SoakPlan& plan, SoakRecord& record, ShowRenderer& renderer, Reporter& reporter,
              const std::atomic<bool>& stop);

}  // namespace stadion
