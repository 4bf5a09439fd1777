#pragma once
/// The facts known about a frame when it has been shown, and the cause if it came late.
///
/// FrameRecord and StageFacts are plain fixed-width records. A file that outlives the program holds them
/// (black_box.h).
///
/// Units    milliseconds.
/// Threads  plain values.

#include "engine/core/frame_probe.h"

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

namespace stadion {

/// Measurements of one stage.
struct StageFacts {
  float ms = 0;                ///< duration, without waiting for its turn
  float processor = 0;         ///< processor time of the stage's own thread
  float turn = 0;              ///< Draw: waited for other walls that use the rasteriser
  float loading = 0;           ///< App: files; Draw: models and textures being uploaded
  std::uint32_t switches = 0;  ///< number of times that the system gave its processor to others
  std::uint32_t faults = 0;    ///< pages that had to be fetched
  /// Time in which its thread was ready but had no processor. For Draw, the rasteriser's thread with the
  /// longest wait counts, too.
  float delayed = 0;
  float late = 0;  ///< such a delay between the thread's previous stage and this one
  float at = 0;    ///< start, relative to the previous frame's swap; negative: before it
};

enum class Cause : std::uint32_t {
  None,  ///< the frame was not late
  App,
  Cull,
  Draw,
  Turn,       ///< a wall's Draw had to wait for another wall's
  Preempted,  ///< the stage's threads got no processor: the system gave it to others
  PageFaults,
  Loading,
  Swap,     ///< showing took long
  Follows,  ///< App could not begin because of earlier frames: it had missed its tick, or no slot was free
  Woken,    ///< a thread that waited for its turn was woken late, without a lack of processors
  Unknown,  ///< none of these took long
};

/// A budget that was overrun in a frame.
struct Overrun {
  std::string name;  ///< with file and line
  double ms = 0, budget = 0;
};

/// The facts of a frame that do not grow with the number of walls. It has more than 20 fields: one for each
/// fact, at a fixed place of the file.
struct FrameRecord {
  std::uint64_t frame = kNoFrame;
  float period = 0;  ///< since the frame before was shown
  float budget = 0;  ///< the limit of the period
  std::uint32_t walls = 0;
  std::uint32_t sequential = 0;  ///< the stages ran one after the other: their times add up
  std::uint32_t sampled = 0;     ///< sampling lengthened its drawing, or that of the previous frame
  float tick = 0, slot = 0;      ///< App's wait for its tick, for a slot
  float sinceApp = 0;            ///< from the previous start of App to this one
  float waited = 0;              ///< Follows, Woken: delay of the stage in question
  /// The frame of this App. It is another frame if a skipped one since the last swap delayed App more.
  std::uint64_t appFrame = kNoFrame;
  StageFacts app, swap;
  std::uint32_t node[2] = {0, 0};  ///< the most expensive in App: load, position
  float nodeMs = 0;
  Cause cause = Cause::None;
  Span stage = Span::App;    ///< the stage of the cause
  std::uint32_t wall = 0;    ///< the wall of the cause
  std::uint32_t holder = 0;  ///< Cause::Turn: the wall that had the rasteriser
  char name[112] = {};       ///< name of the most expensive node in App, with its file and line
  char most[112] = {};       ///< Cull and Draw: of the node with the most to cull or to draw there
  char over[112] = {};       ///< name of the node with the worst budget overrun, if there is one
  float overMs = 0, overBudget = 0;

  NodeRef mostExpensive() const { return {node[0], node[1]}; }
};
static_assert(std::is_trivially_copyable_v<FrameRecord> && std::is_trivially_copyable_v<StageFacts>);

/// All facts of a frame.
struct FrameFacts : FrameRecord {
  explicit FrameFacts(std::size_t wallCount = 0)
      : cull(std::max<std::size_t>(1, wallCount)), draw(std::max<std::size_t>(1, wallCount)) {
    walls = static_cast<std::uint32_t>(wallCount);
  }

  std::vector<StageFacts> cull, draw;  ///< by wall; one element if there is no wall
};

/// Fills in the cause from the other facts. A frame is late if its period exceeds the limit by half. Sampling
/// may lengthen a frame; a sampled frame counts as late only if something other than drawing took long.
void judge(FrameFacts& facts);

/// Returns true if the most expensive node in App explains the delay. This needs an App stage that took long
/// by itself: a lack of processors, a wait or a page fault makes any node look expensive.
bool nodeExplains(const FrameFacts& facts);

/// "frame 812 came after 66.8 ms (16.7): Draw of wall floor took 41.2 ms". The names are the walls'.
std::string toText(const FrameFacts& facts, std::span<const std::string> walls);
std::string_view nameOf(Cause cause);

/// Into a field of a record, cut off where that ends.
template <std::size_t N>
void copyText(const std::string& from, char (&to)[N]) {
  to[from.copy(to, N - 1)] = 0;
}

}  // namespace stadion
