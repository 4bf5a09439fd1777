#pragma once
/// What a live show keeps from one group of visitors to the next: the operator with keys and network,
/// trackers, sounds, and the parts of a show that can be reused.
///
/// Ownership  borrows settings and reporter, which must outlive it.
/// Threads    main, except where a function names another one.

#include "pipeline/operator/osc_operator.h"
#include "pipeline/sound/sound_player.h"
#include "show/base/reporter.h"
#include "show/console/operator_keys.h"
#include "show/console/operator_settings.h"
#include "show/player/reusable_resources.h"
#include "show/recording/run_watch.h"

#include <atomic>
#include <chrono>
#include <memory>

namespace stadion {

class OperatorConsole {
public:
  struct Settings {
    const ShowOptions& show;
    const PlaySettings& play;
    const OperatorSettings& console;
  };

  /// Opens trackers. Null, with the reason in the findings, if they cannot be opened.
  static std::unique_ptr<OperatorConsole> open(const Settings& settings, Reporter& reporter,
                                               Diagnostics& findings);
  ~OperatorConsole();

  /// Returns the resources that a live run keeps from group to group; null: this run is for one group.
  ReusableResources* kept() { return live_ ? &kept_ : nullptr; }

  /// The first show is open: opens sounds, keys and the OSC port. False, with the reason in the findings, if
  /// one cannot be opened.
  bool begin(const Player& player, Diagnostics& findings);
  /// A show is about to begin. The operator's orders that are recorded go to `watch`.
  void beginGroup(Player& player, RunWatch& watch);
  /// A picture of the present show is visible. Once a group it reports how long that took since the operator
  /// asked. Any thread.
  void pictureSeen();
  /// The file of the present group where `file` is that of the first: visit.input, visit-2.input, ...
  std::string fileOfGroup(const std::string& file) const;
  /// The show is over; the next group follows. Reports how long it was and which distances were measured.
  void endGroup(const RunWatch& watch);
  /// Silences all sounds until the next show.
  void silence();

  void addTo(ShowParts& parts, FrameLoopOptions& loop);
  /// Learns of each picture that is visible: in a window, if the walls have windows. On the thread that calls
  /// pictureSeen().
  std::function<void()> seen;
  /// Both learn what the operator has decided, whenever that has changed; on the App thread.
  std::function<void(const OperatorState&)> changed, commanded;
  const OperatorState& state() const { return controls_->state(); }
  /// Orders again what had been decided about a show that goes on here; whether it waits for Start included.
  void resume(const OperatorState& decided);
  /// Takes orders from elsewhere too, such as keys in a window.
  OperatorQueue& queue() { return controls_->queue(); }
  Playback& playback() { return controls_->playback(); }
  std::uint64_t groups() const { return controls_->groups(); }
  double uptime() const;  ///< since it was opened [s]

private:
  OperatorConsole(const Settings& settings, Reporter& reporter)
      : settings_(settings), reporter_(reporter), live_(!settings.play.everyFrame) {}
  void say(const std::string& line) const { reporter_.say(line); }
  void writeDown(std::uint64_t frame, const OperatorCommand& command, RunWatch& watch) const;
  void report(const OperatorCommand& command, Nanoseconds showTime) const;
  void callCue(Player& player, std::uint32_t number) const;

  using Clock = std::chrono::steady_clock;

  const Settings settings_;
  Reporter& reporter_;
  bool live_;
  bool visitorIsLive_ = false;
  Clock::time_point opened_ = Clock::now();
  Clock::time_point asked_{};  ///< when the present group was asked for
  Clock::time_point ready_{};  ///< time at which the present group's show could begin
  bool groupIsNew_ = false;
  ReusableResources kept_;
  AssetRoots roots_;
  std::unique_ptr<TrackerDevice> trackers_;
  std::unique_ptr<OperatorControls> controls_;
  std::unique_ptr<SoundPlayer> sounds_;
  std::unique_ptr<OscOperator> osc_;
  std::unique_ptr<OperatorKeys> keys_;
};

}  // namespace stadion
