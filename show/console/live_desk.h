#pragma once
/// What a live show has beside it, longer than one group of visitors stays: the operator with keys and
/// network, trackers, sounds, and the parts of a show that need not be made again. `run` and `view` have one
/// each.
///
/// Threads  main, but for what its parts say of theirs.

#include "pipeline/operator/osc_operator.h"
#include "show/console/operator_keys.h"
#include "show/player/kept_parts.h"
#include "show/session/run_watch.h"
#include "show/settings/run_options.h"

#include <atomic>
#include <chrono>
#include <memory>

namespace stadion {

class LiveDesk {
public:
  using Say = std::function<void(const std::string&)>;

  /// Opens trackers. Null, with the reason in the findings, if they cannot be opened. `say` is given what
  /// there is to tell, a line at a time, from any thread; none: it goes to the terminal.
  static std::unique_ptr<LiveDesk> open(const RunOptions& options, Diagnostics& findings, Say say = {});
  ~LiveDesk();

  /// What a live run keeps from group to group; null: this run is for one.
  KeptParts* kept() { return live_ ? &kept_ : nullptr; }

  /// The first show is there: opens sounds and what hears commands. False, with the reason in the findings,
  /// if it cannot.
  bool begin(const Player& player, Diagnostics& findings);
  /// A show is about to begin, of the next group or of the same one: what is written down of the operator's
  /// orders goes to `watch`.
  void beginGroup(Player& player, RunWatch& watch);
  /// A picture of the present show is seen: tells how long it took since the operator asked, once a group.
  /// Any thread.
  void pictureSeen();
  /// Where the record of the present group goes.
  std::string recordName() const;
  /// The show is over; the next one is being made, for the next group. Tells how long it was and which
  /// distances were measured.
  void endGroup(const RunWatch& watch);
  /// Nothing is heard until the next show.
  void silence();

  void addTo(ShowParts& parts, FrameLoopOptions& loop);
  /// Learns what the operator has decided, whenever that has changed; on the App thread.
  std::function<void(const OperatorState&)> changed;
  const OperatorState& state() const { return desk_->state(); }
  /// Orders again what had been decided about a show that goes on here; whether it waits for Start included.
  void resume(const OperatorState& decided);
  /// Takes orders from elsewhere too, such as keys in a window.
  OperatorQueue& queue() { return desk_->queue(); }
  Playback& playback() { return desk_->playback(); }
  std::uint64_t groups() const { return desk_->groups(); }
  double uptime() const;  ///< since it was opened [s]

private:
  LiveDesk(const RunOptions& options, Say say)
      : options_(options), say_(std::move(say)), live_(!options.asksForEveryFrame()) {}
  void writeDown(std::uint64_t frame, const OperatorCommand& command, RunWatch& watch) const;
  void tell(const OperatorCommand& command, Nanoseconds showTime) const;

  using Clock = std::chrono::steady_clock;

  const RunOptions& options_;
  Say say_;
  bool live_;
  bool visitorIsLive_ = false;
  Clock::time_point opened_ = Clock::now();
  Clock::time_point asked_{};  ///< when the present group was asked for
  Clock::time_point ready_{};  ///< its show could begin
  bool groupIsNew_ = false;
  KeptParts kept_;
  AssetRoots roots_;
  std::unique_ptr<TrackerDevice> trackers_;
  std::unique_ptr<OperatorDesk> desk_;
  std::unique_ptr<SoundPlayer> sounds_;
  std::unique_ptr<OscOperator> osc_;
  std::unique_ptr<OperatorKeys> keys_;
};

}  // namespace stadion
