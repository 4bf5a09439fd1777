#pragma once
/// The operator's controls of a running show: requested commands, the frame in which they take effect, and
/// the current state.
///
/// Commands take effect at the start of the next frame, on all walls together. Pausing, stepping, waiting and
/// the next group control show time, and so the frames' times. Freezing the head changes its tracker's
/// samples. The other commands change only pictures and sounds. The input log of a live run records all
/// commands, and a replay applies them.
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

class OperatorControls {
public:
  /// `waits`: each group's show stands at its first frame until Start.
  OperatorControls(bool waits, double wallsEyeSeparation);

  OperatorQueue& queue() { return queue_; }
  const OperatorState& state() const { return state_; }
  Playback& playback() { return playback_; }

  /// Sets the run's limit of frames in flight; 0: as many as there is room for.
  void startWith(std::size_t mostInFlight);
  /// Begins a show from its start: it plays, or waits. Black walls, eyes and volume stay as they are.
  void beginGroup();
  /// Returns the number of groups so far, this one included.
  std::uint64_t groups() const { return groups_; }
  /// Ignores further requests for the next group until the present group's first picture is seen. A second
  /// press of the key in the meantime means the same group.
  void awaitPicture() { pictureAwaited_ = true; }
  /// Returns true for the first picture.
  bool pictureSeen() { return pictureAwaited_.exchange(false); }
  /// Returns true if the next group was requested: a picture that is being drawn need not be finished.
  bool leaving() const { return leaving_; }

  /// Applies the coming frame's commands in their order: first those of a log, then those received.
  void beginFrame(std::uint64_t frame);
  /// Sets the orders of a replayed run.
  void replay(RunOrders orders) { recorded_ = std::move(orders); }

  /// Called for each applied command, on the App thread.
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
