#pragma once
/// A show that plays live on its own threads, from opening it to its last frame.
///
/// Threads  opened and ended by one thread (any); it plays on threads of its own; const functions may be
///          called meanwhile.

#include "engine/display/unfolding.h"
#include "pipeline/frame/playback.h"
#include "pipeline/loop/write_watch.h"
#include "profiling/record/live_budget.h"
#include "show/console/operator_console.h"
#include "show/recording/run_watch.h"
#include "show/recording/show_recording.h"
#include "show/session/session_settings.h"
#include "show/view/overview.h"
#include "show/web/operator_web.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>

namespace stadion {

/// Where the visitor is in a show, as far as it can be taken along to a changed script.
struct ShowPlace {
  Pose X_WR;                     ///< the rig
  std::set<std::string> loaded;  ///< scene nodes of the show's own file whose files are there
};

/// The surroundings of a played show, which outlive it.
struct ShowSurroundings {
  const SessionSettings& settings;
  ShowRenderer& renderer;
  PictureSink& sink;
  OperatorConsole& console;
  /// From one show of a script to the next; shows that are there at the same time and play have one each.
  std::shared_ptr<ReusableResources> kept;
  InputDevice* visitor = nullptr;        ///< null: the input log plays
  std::vector<SheetPlace> pictureSizes;  ///< by wall, where neither --size nor the wall file says
  SheetPlace overviewSize;
  Reporter& reporter;
  std::function<void()> ended;  ///< the show has come to its end; on its own thread
  /// Once true the show ends, or, while it is still being opened, is given up. One for each show.
  std::shared_ptr<std::atomic<bool>> stopping = std::make_shared<std::atomic<bool>>(false);
  /// Texts of the scripts; null: the scripts as they are on disk when the show is opened.
  std::shared_ptr<const ScriptTexts> texts{};
  bool recorded = true;        ///< --record-input counts
  OperatorWeb* web = nullptr;  ///< the operator's page; null: there is none
};

class PlayingShow {
public:
  /// Reads, checks and loads everything. Null if something of the user's is wrong; the findings say what.
  /// Throws RunStopped if it is given up.
  static std::unique_ptr<PlayingShow> open(const ShowSurroundings& around, Diagnostics& findings);
  /// Stops playing, if it still does.
  ~PlayingShow();

  /// Begins at show time 0. With a place, the rig is put there and what was loaded is loaded again.
  void start(const std::optional<ShowPlace>& place);
  /// Ends it after the frame under way, and waits for that.
  void stop();

  const Player& player() const { return *player_; }
  std::shared_ptr<ReusableResources> kept() const { return around_.kept; }
  Overview& overview() { return *overview_; }
  RunWatch& watch() { return *watch_; }
  ShowPlace place() const;
  FrameBudget budget() const { return budget_.now(); }
  /// How nodes with a budget keep it.
  std::vector<BudgetReport> budgets() const { return recording_->governor()->reports(); }
  /// Everything counts as so many times farther away.
  double stress() const { return recording_->governor()->stress().value_or(StressReport{}).now; }
  /// How many frames were late, why, and where the last ones are kept; empty if none was. After stop().
  std::string lateFrames() const;
  std::uint64_t droppedTicks() const { return dropped_; }
  std::uint64_t framesPlayed() const { return frames_; }
  /// Show time of the newest frame; what is shown comes a little later.
  Nanoseconds time() const { return time_; }
  /// Why it could not go on, if so. After stop().
  const Failure& failure() const { return outcome_.failure; }
  /// Returns true if it ended because the operator asked for the next group. After stop().
  bool nextGroup() const { return outcome_.nextGroup && !outcome_.failure; }
  std::string drawnBy() const { return stages_ ? stages_->drawnBy() : ""; }

private:
  explicit PlayingShow(const ShowSurroundings& around) : around_(around) {}
  ShowParts parts();
  void see(const TimeSignature& now, const InputSample& input, const Scene& scene);
  void takeUp(const ShowPlace& place);
  void notePlace(const Scene& scene);
  void beginRecording();

  ShowSurroundings around_;
  std::unique_ptr<Player> player_;
  std::unique_ptr<RunWatch> watch_;
  std::unique_ptr<Overview> overview_;
  LiveBudget budget_;
  std::unique_ptr<ShowRecording> recording_;
  std::unique_ptr<ShowStages> stages_;
  std::unique_ptr<WriteWatch> writes_;  ///< null: without --guard, and once the show has ended
  std::unique_ptr<FrameLoop> loop_;
  FrameLoopOutcome outcome_;
  std::atomic<std::uint64_t> dropped_ = 0, frames_ = 0;
  std::atomic<Nanoseconds> time_ = 0;
  std::optional<ShowPlace> from_;
  std::uint64_t loadsSeen_ = 0;
  mutable std::mutex mutex_;
  ShowPlace place_;
  std::thread thread_;
};

}  // namespace stadion
