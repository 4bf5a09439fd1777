#pragma once
/// The frame, in one place.
///
/// Sequential mode runs the stages of a frame one after the other in the calling thread. Pipelined mode runs
/// the same stages on one App thread and, for each wall, one Cull and one Draw thread, so that App works on
/// frame n + 2 while Cull works on n + 1 and Draw on n. Both give the same pixels and the same state, frame
/// by frame.

#include "engine/frame_probe.h"
#include "engine/input/run_decisions.h"
#include "engine/time_signature.h"
#include "pipeline/frame_times.h"
#include "pipeline/pacer.h"
#include "pipeline/stages.h"
#include "pipeline/state/frame_slots.h"

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
  std::size_t walls = 1;
  std::uint64_t frames = 0;  ///< 0 = until stopped
  Nanoseconds end = 0;       ///< no frame after this show time; 0 = until stopped
  /// Show times that a recorded run decided for some of its frames (see RunDecisions); they are obeyed.
  std::map<std::uint64_t, Nanoseconds> frameTimes{};
};

struct FrameLoopOutcome {
  std::uint64_t framesSimulated = 0, framesShown = 0;
  std::uint64_t missedTicks = 0;
  bool stopped = false;  ///< by request, before all frames were done
  Failure failure;
};

class FrameLoop {
public:
  /// `stopRequested` may be set by a signal handler; it is looked at before each frame.
  FrameLoop(Stages& stages, const FrameLoopOptions& options, const std::atomic<bool>& stopRequested,
            FrameProbe* probe = nullptr);

  FrameLoopOutcome run();
  const FrameTimes& times() const { return times_; }
  /// Ends the show after the frame that App is working on. For App's own thread.
  void endAfterThisFrame() { ending_ = true; }

private:
  std::optional<TimeSignature> nextFrame();
  void runSequential();
  void runPipelined();

  bool appStage(const TimeSignature& now, std::size_t slot);
  bool cullStage(std::size_t wall, std::size_t slot, std::uint64_t frame, DrawList& list);
  bool openStage(std::size_t wall);
  bool drawStage(std::size_t wall, const DrawList& list);
  bool swapStage(const TimeSignature& now);
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
  FrameClock clock_;
  bool ending_ = false;
  std::atomic<bool> failed_ = false;
  std::mutex failureMutex_;
  /// When App began a frame, by frame: a frame is shown long before its entry is used again.
  static constexpr std::size_t kAppStarts = 64;
  std::vector<std::chrono::steady_clock::time_point> appStart_;
  std::chrono::steady_clock::time_point lastSwap_;
};

}  // namespace stadion
