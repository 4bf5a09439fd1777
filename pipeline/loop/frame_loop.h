#pragma once
/// The frame, in one place.
///
/// Sequential mode runs the stages of a frame one after the other in the calling thread. Pipelined mode runs
/// the same stages on one App thread and, for each wall, one Cull and one Draw thread, so that App works on
/// frame n + 2 while Cull works on n + 1 and Draw on n. Both give the same pixels and the same state, frame
/// by frame.

#include "engine/base/time_signature.h"
#include "engine/core/frame_probe.h"
#include "engine/core/load_control.h"
#include "engine/input/run_decisions.h"
#include "pipeline/frame/frame_times.h"
#include "pipeline/frame/playback.h"
#include "pipeline/loop/frame_orders.h"
#include "pipeline/loop/pacer.h"
#include "pipeline/operator/operator_desk.h"
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

struct FrameLoopOptions {
  Mode mode = Mode::Pipelined;
  Pace pace = Pace::Free;
  Delivery delivery = Delivery::Every;
  double rate = 60;  ///< [1/s]
  /// Whoever is late leaves out no tick, but simulates frame after frame until it has caught up: the show is
  /// the same however fast the machine is. One that is not pipelined does not draw meanwhile.
  bool everyTick = false;
  std::size_t walls = 1;
  /// Frames under way at most, in pipelined mode (FrameSlots::limitUnderWay); the operator may change it.
  std::size_t latency = 0;
  bool drawBeginsEarly = true;  ///< in pipelined mode: while Cull still fills the list (ListFilling)
  /// The show goes on after this frame, which was that much earlier than the one to be shown now [ns]: it
  /// catches up (Pacer::startLate). Nothing: it begins, late by as much.
  std::optional<TimeSignature> after{};
  Nanoseconds late = 0;
  std::uint64_t frames = 0;  ///< 0 = until stopped
  Nanoseconds end = 0;       ///< no frame after this show time; 0 = until stopped
  /// Show times that a recorded run decided for some of its frames (see RunDecisions); they are obeyed.
  std::map<std::uint64_t, Nanoseconds> frameTimes{};
  /// What it decided because something took too long; it is obeyed.
  LoadDecisions relief{};
  LoadDecider* decider = nullptr;  ///< who decides that in a live run; null = nobody
  Playback* playback = nullptr;    ///< who may pause a live run or slow it down; null = nobody
  OperatorDesk* desk = nullptr;    ///< whose commands are taken at the start of each frame; null = nobody's
  /// The other machines that play this show, which then is shown frame by frame; null = there are none.
  FrameOrders* orders = nullptr;
};

struct FrameLoopOutcome {
  std::uint64_t framesSimulated = 0, framesShown = 0;
  std::uint64_t framesDrawn = 0;      ///< of those shown
  std::uint64_t missedTicks = 0;      ///< App's: it began no frame
  std::uint64_t ticksPassedOver = 0;  ///< between frames shown, as below, in all
  /// Ticks in a row between two frames shown, of those that were begun after the first one was shown.
  std::uint64_t mostPassedOver = 0;
  bool stopped = false;    ///< by request, before all frames were done
  bool nextGroup = false;  ///< the operator asked for the show to begin again
  Failure failure;
};

class FrameLoop {
public:
  /// `stopRequested` may be set by a signal handler; it is looked at once a frame. The frame in which it is
  /// seen is the last one, and drawn as such.
  FrameLoop(Stages& stages, const FrameLoopOptions& options, const std::atomic<bool>& stopRequested,
            FrameProbe* probe = nullptr);

  FrameLoopOutcome run();
  const FrameTimes& times() const { return times_; }
  /// Ends the show after the frame that App is working on. For App's own thread.
  void endAfterThisFrame() { ending_ = true; }
  /// Whether the show began late and has not caught up yet. For App's own thread.
  bool catchesUp() const { return pacer_.catchesUp(); }

private:
  struct StageThreads;

  void runSequential();
  void runPipelined();
  void runThreads(const StageThreads& work);
  void drawAndClose(const StageThreads& work, std::size_t wall);
  /// What App does next.
  using Turn = FrameOrder;
  std::optional<Turn> nextTurn();
  std::optional<Turn> orderedTurn();
  Standstill standstill() const;  ///< where show time does not go on
  Turn told(Turn turn);
  template <class Wait>
  auto waited(Span what, std::uint64_t frame, std::size_t wall, const Wait& wait);
  bool takeCommands();
  std::size_t framesUnderWay() const;
  std::size_t lastWalls() const;
  FrameLoad loadOf(std::uint64_t frame);
  TimeSignature signatureAfter(std::uint64_t ticks, double speed);
  bool noneFollows();
  bool isPastEnd() const;

  bool passesOver(const FrameTicket& ticket);
  std::optional<FrameTicket> appStage(const Turn& turn, std::size_t slot);
  bool cullStage(std::size_t wall, std::size_t slot, const FrameTicket& ticket, DrawList& list);
  bool openStage(std::size_t wall);
  bool warmUpStage(std::size_t wall, const DrawList& list);
  void warmedUp(std::chrono::steady_clock::duration took);
  bool drawStage(std::size_t wall, DrawList& list);
  bool swapStage(const FrameTicket& ticket);
  void noteShown(const FrameTicket& ticket);
  void notePassedOver(const FrameTicket& ticket);
  void closeStage(std::size_t wall);
  template <class Work>
  bool guard(const char* what, std::size_t wall, std::uint64_t frame, const Work& work);
  bool fail(const char* what, std::size_t wall, std::uint64_t frame, const char* why) noexcept;
  bool fail(Reason why);

  Stages& stages_;
  FrameLoopOptions options_;
  const std::atomic<bool>& stopRequested_;
  FrameProbe* probe_;
  Pacer pacer_;
  FrameTimes times_;
  FrameLoopOutcome outcome_;
  std::uint64_t nextIndex_ = 0;
  std::uint64_t passedOver_ = 0;  ///< frames in a row that were late and not drawn
  FrameClock clock_;
  TimeSignature lastSignature_;
  bool begun_ = false;   ///< a frame has been simulated, here or elsewhere: there is one to stand still at
  bool ending_ = false;  ///< App was told to end after this frame
  bool ended_ = false;   ///< App has begun its last frame
  std::atomic<bool> stopped_ = false;
  std::atomic<bool> broken_ = false;  ///< failed, or Draw gave up: all threads are to end at once
  std::mutex failureMutex_;
  std::chrono::steady_clock::time_point ready_{};  ///< the first frame was shown
  std::vector<double> warmUps_;  ///< by wall: what getting ready took [ms]; each its Draw thread's own
  // Of the frame shown last; whoever swaps has them.
  std::chrono::steady_clock::time_point lastSwap_{};
  bool lastDrawn_ = false;
  std::optional<Nanoseconds> lastShown_;  ///< its show time
};

}  // namespace stadion
