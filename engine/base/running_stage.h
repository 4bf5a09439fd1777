#pragma once
/// The stage of the frame that a thread runs. A pool lends the stage of its caller to the threads that take
/// pieces of the job, so that the work of these counts as work of that stage.
///
/// Threads    each thread has its own.
/// Signals    current() may be called in a signal handler.
/// Ownership  borrows the record. Its owner (pipeline/state/write_guard.h) outlives the jobs of the stage.

namespace stadion {

struct StageRecord;  ///< known to its owner only

/// While it lives, this thread runs that stage. Then it runs the one of before again.
class RunningStage {
public:
  explicit RunningStage(StageRecord* stage) : before_(current()) { begin(stage); }
  ~RunningStage() { begin(before_); }
  RunningStage(const RunningStage&) = delete;
  RunningStage& operator=(const RunningStage&) = delete;

  /// Null: this thread runs no stage.
  static StageRecord* current();
  static void begin(StageRecord* stage);

private:
  StageRecord* before_;
};

}  // namespace stadion
