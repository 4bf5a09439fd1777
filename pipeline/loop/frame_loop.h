#pragma once
/// The frame, in one place.
///
/// Sequential mode runs the stages of a frame one after the other in the calling thread. Pipelined mode runs
/// the same stages on one App thread and, for each wall, one Cull and one Draw thread, so that App works on
/// frame n + 2 while Cull works on n + 1 and Draw on n. Both give the same pixels and the same state, frame
/// by frame.
///
/// Threads  run() returns when all threads have ended, and times() is read after that. App may call
///          endAfterThisFrame() and catchesUp(), from within its stage. The fields are grouped by their
///          thread.
/// Errors   run() lets no exception out. The first failure of any thread is in the outcome.
/// Size     FrameLoop has more than 20 fields: the state of a frame that App, Cull, Draw and the swap share.

#include "engine/base/time_signature.h"
#include "engine/core/cost_budget.h"
#include "engine/core/frame_probe.h"
#include "engine/input/run_decisions.h"
#include "pipeline/frame/frame_times.h"
#include "pipeline/frame/playback.h"
#include "pipeline/loop/frame_orders.h"
#include "pipeline/loop/pacer.h"
#include "pipeline/loop/write_watch.h"
#include "pipeline/operator/operator_controls.h"
#include "pipeline/state/frame_slots.h"
#include "pipeline/wall/stages.h"

#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

enum class Mode { Sequential, Pipelined };

/// Returns the mode's name on the command line: "sequential", "pipelined".
constexpr const char* nameOf(Mode mode) {
  return mode == Mode::Sequential ? "sequential" : "pipelined";
}

struct FrameLoopOptions {
  Mode mode = Mode::Pipelined;
  Pace pace = Pace::Free;
  Delivery delivery = Delivery::Every;
  double rate = 60;  ///< [1/s]
  /// A late loop skips no tick, but simulates frame after frame until it has caught up. The show is then the
  /// same on machines of any speed. A sequential loop does not draw meanwhile.
  bool everyTick = false;
  std::size_t walls = 1;
  /// Limit of frames in flight, in pipelined mode (FrameSlots::limitInFlight); the operator may change it.
  std::size_t mostInFlight = 0;
  bool drawBeginsEarly = true;  ///< in pipelined mode: while Cull still fills the list (ListFilling)
  /// The last frame of a show that continues; nothing: the show starts.
  std::optional<TimeSignature> after{};
  /// Delay with which the show starts or continues; it catches up (Pacer::startLate) [ns].
  Nanoseconds late = 0;
  std::uint64_t frames = 0;  ///< 0 = until stopped
  Nanoseconds end = 0;       ///< last show time; 0 = until stopped
  /// Show times that a recorded run chose for some of its frames (see RunDecisions); the loop applies them.
  std::map<std::uint64_t, Nanoseconds> frameTimes{};
  /// A recorded run's decisions about overload; the loop applies them.
  DegradationDecisions degradation{};
  DegradationDecider* decider = nullptr;  ///< makes these decisions in a live run; null = none are made
  Playback* playback = nullptr;           ///< pauses a live run or slows it down; null = never
  OperatorControls* controls = nullptr;   ///< commands, taken at the start of each frame; null = none
  /// The other hosts that play this show, which is then shown frame by frame; null = there are none.
  FrameOrders* orders = nullptr;
  /// Ends the run at the first write of a stage to what it may only read; null = nothing is watched. While it
  /// watches, Draw waits for the whole list.
  WriteWatch* watch = nullptr;
};

struct FrameLoopOutcome {
  std::uint64_t framesSimulated = 0;
  std::uint64_t framesShown = 0;        ///< frames that reached the swap, drawn or not (FrameTicket::drawn)
  std::uint64_t framesDrawn = 0;        ///< frames among them with new pictures
  std::uint64_t missedTicks = 0;        ///< ticks in which App began no frame
  std::uint64_t ticksWithoutFrame = 0;  ///< sum over all pairs of shown frames, as below
  /// Greatest number of ticks between two shown frames that follow each other, without frames that began
  /// before the first one was shown.
  std::uint64_t mostTicksWithoutFrame = 0;
  bool stopped = false;    ///< by request, before all frames were done
  bool nextGroup = false;  ///< the operator asked to restart the show
  Failure failure;
};

class FrameLoop {
public:
  /// `stopRequested` may be set by a signal handler and is read once a frame. The frame that reads it is the
  /// last one, and is drawn as such. A stop before the first frame ends the run without one.
  FrameLoop(Stages& stages, const FrameLoopOptions& options, const std::atomic<bool>& stopRequested,
            FrameProbe* probe = nullptr);

  FrameLoopOutcome run();
  const FrameTimes& times() const { return times_; }
  /// Ends the show after App's current frame. For App's own thread.
  void endAfterThisFrame() { ending_ = true; }
  /// Returns true if the show began late and has not caught up yet. For App's own thread.
  bool catchesUp() const { return pacer_.catchesUp(); }

private:
  class Pipeline;

  void runSequential();
  void runPipelined();
  std::optional<FrameOrder> nextOrder();
  std::optional<FrameOrder> leadersOrder();
  Standstill standstill() const;  ///< the reason for which show time stands still
  FrameOrder issue(FrameOrder order);
  template <class Wait>
  auto timedWait(Span what, std::uint64_t frame, std::size_t wall, const Wait& wait);
  bool takeCommands();
  std::size_t mostInFlight() const;
  std::size_t wallsLeft() const;
  FrameDecisions decisionsFor(std::uint64_t frame);
  TimeSignature signatureAfter(std::uint64_t ticks, double speed);
  bool noneFollows();
  bool isPastEnd() const;

  bool leavesUndrawn(const FrameTicket& ticket);
  std::optional<FrameTicket> appStage(const FrameOrder& order, std::size_t slot);
  bool cullStage(std::size_t wall, std::size_t slot, const FrameTicket& ticket, DrawList& list);
  bool openStage(std::size_t wall);
  bool warmUpStage(std::size_t wall, const DrawList& list);
  void warmedUp(std::chrono::steady_clock::duration took);
  bool drawStage(std::size_t wall, DrawList& list);
  bool swapStage(const FrameTicket& ticket);
  void noteShown(const FrameTicket& ticket);
  void countTicksWithoutFrame(const FrameTicket& ticket);
  void closeStage(std::size_t wall);
  template <class Work>
  bool attempt(const char* what, std::size_t wall, std::uint64_t frame, const Work& work);
  template <class Work>
  bool attemptGuarded(const char* what, std::size_t wall, std::uint64_t frame, const Work& work);
  Failure drawWall(std::size_t wall, DrawList& list);
  bool fail(const char* what, std::size_t wall, std::uint64_t frame, const char* why) noexcept;
  bool fail(Reason why);

  // Set before the threads start, then read by all of them.
  Stages& stages_;
  FrameLoopOptions options_;
  const std::atomic<bool>& stopRequested_;
  FrameProbe* probe_;

  // App's own.
  Pacer pacer_;
  FrameClock clock_;
  TimeSignature lastSignature_;
  std::uint64_t nextIndex_ = 0;
  std::uint64_t undrawnInARow_ = 0;  ///< late frames in a row that were not drawn
  bool begun_ = false;   ///< a frame has been simulated, on any host: the show can stand still at it
  bool ending_ = false;  ///< App must end after this frame
  bool ended_ = false;   ///< App has begun its last frame

  // Each wall's entry belongs to its Draw thread. App reads all of them when the walls are warm.
  std::vector<double> warmUps_;  ///< by wall: duration of its warm-up [ms]

  // Of the thread that swaps: the Draw thread that arrives last. The barrier orders these threads.
  std::chrono::steady_clock::time_point ready_{};  ///< time at which the first frame was shown
  std::chrono::steady_clock::time_point lastSwap_{};
  bool lastDrawn_ = false;                ///< the frame shown last had new pictures
  std::optional<Nanoseconds> lastShown_;  ///< show time of the frame shown last

  // Each field has one writer: App, a wall's Cull or Draw, or the thread that swaps. Read after the run.
  FrameTimes times_;
  FrameLoopOutcome outcome_;  ///< except `failure`, which any thread may set

  // Any thread's.
  std::atomic<bool> stopped_ = false;
  std::atomic<bool> broken_ = false;  ///< failed, or Draw stopped: all threads must end at once
  std::mutex failureMutex_;           ///< guards outcome_.failure
};

}  // namespace stadion
