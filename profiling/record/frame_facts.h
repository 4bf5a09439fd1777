#pragma once
/// What is known of one frame when it has been shown, and whose fault it is if it came late.
///
/// FrameRecord and StageFacts are plain fixed-width records. A file that outlives the program holds them
/// (black_box.h).
///
/// Units    milliseconds. Threads  plain values.

#include "engine/core/frame_probe.h"

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

namespace stadion {

/// How one stage fared.
struct StageFacts {
  float ms = 0;                ///< as it was, without waiting for its turn
  float processor = 0;         ///< of its own thread
  float turn = 0;              ///< Draw: waited for other walls that use the rasteriser
  float loading = 0;           ///< App: files; Draw: models and pictures on their way to the graphics
  std::uint32_t switches = 0;  ///< how often the system gave its processor to others
  std::uint32_t faults = 0;    ///< pages that had to be fetched
  /// So long its thread could have run but got no processor; Draw: or the rasteriser's thread that had to
  /// wait most.
  float delayed = 0;
  float late = 0;  ///< likewise before it began, since the stage before on its thread
  float at = 0;    ///< when it began, after the frame before was shown; less than 0: before that
};

enum class Cause : std::uint32_t {
  None,  ///< it was not late
  App,
  Cull,
  Draw,
  Turn,       ///< a wall's Draw had to wait for another's
  Preempted,  ///< the stage's threads got no processor: the system gave it to others
  PageFaults,
  Loading,
  Swap,     ///< showing took long
  Follows,  ///< App could not begin for frames before it: it had missed its tick, or no slot was free
  Woken,    ///< a thread that waited for its turn was woken late, though it was not kept from a processor
  Unknown,  ///< nothing of all that took long
};

/// A budget that was overrun in a frame.
struct Overrun {
  std::string name;  ///< with file and line
  double ms = 0, budget = 0;
};

/// The facts of a frame that do not grow with the number of walls.
struct FrameRecord {
  std::uint64_t frame = kNoFrame;
  float period = 0;  ///< since the frame before was shown
  float budget = 0;  ///< what it may be
  std::uint32_t walls = 0;
  std::uint32_t sequential = 0;  ///< the stages followed each other: their times add up
  std::uint32_t sampled = 0;     ///< its drawing, or that of the frame before, took longer to be looked at
  float tick = 0, slot = 0;      ///< App waited so long for its tick, for a slot
  float sinceApp = 0;            ///< from the begin of App before it to this one's
  float waited = 0;              ///< Follows, Woken: by so much the stage of the cause began late
  /// Whose App this is: not its own, if one that was passed over since the last one shown held App up more.
  std::uint64_t appFrame = kNoFrame;
  StageFacts app, swap;
  std::uint32_t node[2] = {0, 0};  ///< the dearest in App: load, position
  float nodeMs = 0;
  Cause cause = Cause::None;
  Span stage = Span::App;    ///< that of the cause
  std::uint32_t wall = 0;    ///< likewise
  std::uint32_t holder = 0;  ///< Cause::Turn: the wall that had the rasteriser
  char name[112] = {};       ///< of the dearest node in App, with its file and line
  char most[112] = {};       ///< Cull and Draw: of the node that has most to cull or to draw there
  char over[112] = {};       ///< of the node that overran its budget most, if one did
  float overMs = 0, overBudget = 0;

  NodeRef dearest() const { return {node[0], node[1]}; }
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

/// Fills in the cause, from the other facts. A frame is late if its period is half as long again as it may
/// be. One whose drawing was sampled may be late for that: it is, if something but drawing took long.
void judge(FrameFacts& facts);

/// Whether the dearest node in App is why it was late: only of App that took long by itself. What had no
/// processor, waited or fetched memory is dear wherever that befell it.
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
