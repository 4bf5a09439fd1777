#pragma once
/// The operator's place beside a running show: what was asked for, when it takes effect, and how things
/// stand.
///
/// Commands take effect at the start of the next frame, on all walls together. Pausing, stepping, waiting and
/// the next group decide when show time goes on, which is in the frames' times; the head's freezing is in
/// what its tracker says; the others change pictures and sounds alone. All of that is in the input log of a
/// live run, and a replay obeys it.
///
/// Threads  queue(), leaving() and pictureSeen() from any; everything else is App's while the show runs.

#include "engine/input/run_decisions.h"
#include "pipeline/frame/playback.h"
#include "pipeline/operator/operator_queue.h"
#include "pipeline/operator/operator_state.h"

#include <atomic>
#include <cstdint>
#include <functional>

namespace stadion {

class OperatorDesk {
public:
  /// `waits`: each group's show stands at its first frame until Start.
  OperatorDesk(bool waits, double wallsEyeSeparation);

  OperatorQueue& queue() { return queue_; }
  const OperatorState& state() const { return state_; }
  Playback& playback() { return playback_; }

  /// The run was started with so many frames under way at most; 0: as many as there is room for.
  void startWith(std::size_t latency);
  /// A show begins from the start: it plays, or waits. Black walls, eyes and volume stay as they are.
  void beginGroup();
  /// Groups so far, this one included.
  std::uint64_t groups() const { return groups_; }
  /// Until the present group's first picture is seen, asking for the next one changes nothing: whoever
  /// presses the key again in the meantime means this one.
  void awaitPicture() { pictureAwaited_ = true; }
  /// True for the first one.
  bool pictureSeen() { return pictureAwaited_.exchange(false); }
  /// The next group was asked for: what is still being drawn need not be finished.
  bool leaving() const { return leaving_; }

  /// The coming frame's commands, in their order: those that a log has for it, then those that have come.
  void beginFrame(std::uint64_t frame);
  /// Orders that a replayed run had.
  void obey(RunOrders orders) { recorded_ = std::move(orders); }

  /// Learns of each command that was obeyed, on the App thread.
  std::function<void(std::uint64_t frame, const OperatorCommand&)> told;

private:
  void take(std::uint64_t frame, const OperatorCommand& command);

  OperatorQueue queue_;
  OperatorState state_;
  Playback playback_;
  RunOrders recorded_;
  bool waits_;
  std::atomic<bool> leaving_ = false, pictureAwaited_ = false;
  std::uint64_t groups_ = 0;
};

}  // namespace stadion
