#pragma once
/// What a live run has beside the show, longer than one group of visitors stays: the operator with keys and
/// network, trackers, sounds, and the models that need not be read again.
///
/// Threads  main, but for what its parts say of theirs.

#include "cli/operator_keys.h"
#include "cli/run_options.h"
#include "cli/run_watch.h"
#include "pipeline/operator/osc_operator.h"

#include <chrono>
#include <memory>

namespace stadion {

class LiveDesk {
public:
  /// Opens trackers and sounds. Null, with the reason in the findings, if the trackers cannot be opened.
  static std::unique_ptr<LiveDesk> open(const RunOptions& options, Diagnostics& findings);
  ~LiveDesk();

  /// Where models of a live run are kept from group to group; null: this run is for one.
  ImportedMeshes* kept() { return live_ ? &kept_ : nullptr; }

  /// The first show is there: opens what hears commands. False, with the reason in the findings, if it
  /// cannot.
  bool begin(const Player& player, Diagnostics& findings);
  /// Tells of the group that is to begin, and what is written down of the operator's orders goes to `watch`.
  void beginGroup(Player& player, RunWatch& watch);
  /// Where the record of the present group goes.
  std::string recordName() const;
  /// The show is over; the next one is being made, and counts from now on.
  void endGroup();

  void addTo(ShowParts& parts, FrameLoopOptions& loop);
  /// Takes orders from elsewhere too, such as keys in a window.
  OperatorQueue& queue() { return desk_->queue(); }
  std::uint64_t groups() const { return desk_->groups(); }
  double uptime() const;  ///< since it was opened [s]

private:
  explicit LiveDesk(const RunOptions& options) : options_(options), live_(!options.asksForEveryFrame()) {}
  void tell(const OperatorCommand& command) const;

  using Clock = std::chrono::steady_clock;

  const RunOptions& options_;
  bool live_;
  Clock::time_point opened_ = Clock::now(), ended_{};
  ImportedMeshes kept_;
  AssetRoots roots_;
  std::unique_ptr<TrackerDevice> trackers_;
  std::unique_ptr<OperatorDesk> desk_;
  std::unique_ptr<SoundPlayer> sounds_;
  std::unique_ptr<OscOperator> osc_;
  std::unique_ptr<OperatorKeys> keys_;
};

}  // namespace stadion
