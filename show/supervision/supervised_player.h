#pragma once
/// A supervised player's side: it reports its progress, saves a snapshot of the scene every few seconds where
/// it outlives the player, and continues from the last one if it is not the first player. While it catches up
/// it saves every second, and once more when it has caught up: if it crashes soon, the next player has less
/// to catch up with.
///
/// Threads  main, but for simulated(), which is App's, and shown(), which is the Draw thread's that swaps.

#include "pipeline/supervision/shared_progress.h"
#include "show/console/operator_console.h"
#include "show/recording/run_watch.h"
#include "show/supervision/supervision_settings.h"

#include <memory>
#include <optional>
#include <string>

namespace stadion {

class SupervisedPlayer {
public:
  /// Null if this process has no supervisor, or with the reason in the findings. `keepsScene`: the scene is
  /// saved for the next player; in a cluster the other machines have it.
  static std::unique_ptr<SupervisedPlayer> create(const SupervisionSettings& settings, bool keepsScene,
                                                  std::function<void(const std::string&)> say,
                                                  Diagnostics& findings);

  /// The snapshot to continue from; null: the show begins.
  std::shared_ptr<const std::vector<std::uint8_t>> state() const { return state_; }
  /// The snapshot could not be restored, for the reasons found: the show restarts.
  void restartShow(const Diagnostics& found);
  /// The first show of this process: where it continues, and what the operator had decided. Reports it.
  void goOn(FrameLoopOptions& loop, OperatorConsole& console, RunWatch& watch);

  void enter(SharedProgress::Phase phase) { progress_->enter(phase); }
  /// The next group's show begins.
  void beginGroup() { progress_->forget(); }
  void setOperatorState(const OperatorState& state) { progress_->setOperatorState(state); }
  /// `late`: it is still catching up.
  void simulated(const TimeSignature& now, Scene& scene, const RunWatch& watch, bool late);
  void shown() { progress_->shown(); }

  /// For the summary: the number of players before this one, and what saving the snapshots took.
  std::string remark() const;

private:
  SupervisedPlayer(std::unique_ptr<SharedProgress> progress, std::function<void(const std::string&)> say);
  void keep(const TimeSignature& now, Scene& scene, const RunWatch& watch);

  std::unique_ptr<SharedProgress> progress_;
  std::function<void(const std::string&)> say_;
  std::optional<SharedProgress::Kept> from_;
  std::shared_ptr<const std::vector<std::uint8_t>> state_;
  bool keeps_ = true;  ///< the scene, for the next player
  OperatorState operator_;
  bool wentOn_ = false, catchesUp_ = false;
  Nanoseconds begun_ = 0;     ///< time at which the show continued, by machineClock()
  Nanoseconds due_ = 0;       ///< the show time where it would have been then
  Nanoseconds nextKept_ = 0;  ///< machineClock()
  Nanoseconds step_ = 0;      ///< the longest time that keeping may take unnoticed
  bool told_ = false;
  std::size_t bytes_ = 0, times_ = 0;  ///< size of the saved scene; number of saves
  Nanoseconds longest_ = 0;            ///< longest time that a save took
};

}  // namespace stadion
