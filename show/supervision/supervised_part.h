#pragma once
/// A player's part in `run --supervise`: it says how far it is, keeps the show's scene every few seconds
/// where it outlives the player, and goes on from there if it is not the first one. Then it keeps the scene
/// as soon as it has caught up, and while it does every second: if it dies soon, the next one has less to
/// catch up with than it had.
///
/// Threads  main, but for simulated(), which is App's, and shown(), which is the Draw thread's that swaps.

#include "pipeline/supervision/shared_progress.h"
#include "show/console/live_desk.h"
#include "show/session/run_watch.h"
#include "show/settings/run_options.h"

#include <memory>
#include <optional>
#include <string>

namespace stadion {

class SupervisedPart {
public:
  /// Null if nobody watches over this process.
  static std::unique_ptr<SupervisedPart> create(const RunOptions& options, Diagnostics& findings);

  /// The state to go on from; null: the show begins.
  std::shared_ptr<const std::vector<std::uint8_t>> state() const { return state_; }
  /// It could not be put back, for what was found: the show begins again.
  void beginAgain(const Diagnostics& found);
  /// The first show of this process: where it goes on, what the operator had decided. Says so.
  void goOn(FrameLoopOptions& loop, LiveDesk& desk, RunWatch& watch);

  void enter(SharedProgress::Phase phase) { progress_->enter(phase); }
  /// The next group's show begins.
  void beginGroup() { progress_->forget(); }
  void obeyed(const OperatorState& state) { progress_->obeyed(state); }
  /// `late`: it is still catching up.
  void simulated(const TimeSignature& now, Scene& scene, const RunWatch& watch, bool late);
  void shown() { progress_->shown(); }

  /// What there is to say of it in a summary: players before this one, and what keeping the scene took.
  std::string remark() const;

private:
  SupervisedPart(std::unique_ptr<SharedProgress> progress, std::function<void(const std::string&)> say);
  void keep(const TimeSignature& now, Scene& scene, const RunWatch& watch);

  std::unique_ptr<SharedProgress> progress_;
  std::function<void(const std::string&)> say_;
  std::optional<SharedProgress::Kept> from_;
  std::shared_ptr<const std::vector<std::uint8_t>> state_;
  bool keeps_ = true;  ///< the scene, for the next player; in a cluster the others have it
  OperatorState desk_;
  bool wentOn_ = false, catchesUp_ = false;
  Nanoseconds begun_ = 0;     ///< when it went on, by machineClock()
  Nanoseconds due_ = 0;       ///< the show time where it would have been then
  Nanoseconds nextKept_ = 0;  ///< machineClock()
  Nanoseconds step_ = 0;      ///< the longest time that keeping may take unnoticed
  bool told_ = false;
  std::size_t bytes_ = 0, times_ = 0;  ///< of the scene as it was kept; how often
  Nanoseconds longest_ = 0;            ///< that keeping it took
};

}  // namespace stadion
