#pragma once
/// What a player and the process that watches over it have in common: how far the show is, whether it goes
/// on, and the scene as it was a little while ago. It lies in memory and outlives the player, however that
/// dies.
///
/// A scene is written before the newest one or behind it, and becomes the newest one when all of it is there:
/// a player that dies while it writes leaves the one before.
///
/// Ownership  owns a nameless file in memory, whose descriptor the player inherits.
/// Threads    simulated() and keep() on the App thread, shown() on the Draw thread that swaps, the rest from
///            any. The player and its watcher at the same time; two players never.
/// Errors     what lies there may be damaged, since a program that crashed could write to it: a scene that
///            cannot be restored is refused by SceneSnapshot::restore().

#include "engine/base/diagnostic.h"
#include "engine/base/time_signature.h"
#include "pipeline/operator/operator_state.h"
#include "pipeline/platform/child_process.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace stadion {

/// The machine's steady clock, the same in all its processes [ns].
Nanoseconds machineClock();

class SharedProgress {
public:
  enum class Phase : std::uint32_t {
    Opening,  ///< files are read, drivers begin
    Playing,  ///< pictures are to come
    Ending,   ///< the run is over; summaries are written
  };
  /// A frame, and when it was simulated.
  struct Moment {
    std::uint64_t frame = 0;
    Nanoseconds time = 0;   ///< show time [ns]
    Nanoseconds clock = 0;  ///< machineClock(); 0: there has been none
    Nanoseconds due = 0;    ///< where show time would be, had no player died: later while one catches up
  };
  /// A scene that was kept: after which frame.
  struct Kept {
    std::uint64_t frame = 0;
    Nanoseconds time = 0;       ///< show time [ns]
    std::uint64_t history = 0;  ///< hash of the states up to then
    std::uint64_t bytes = 0;
    std::uint64_t at = 0;  ///< where it lies; keep() says
  };

  /// For who watches.
  static Result<std::unique_ptr<SharedProgress>> create();
  /// For the player, by the descriptor that it has inherited; null if that is none of these.
  static std::unique_ptr<SharedProgress> attach(int descriptor);
  ~SharedProgress();
  SharedProgress(const SharedProgress&) = delete;
  SharedProgress& operator=(const SharedProgress&) = delete;

  int descriptor() const { return file_.get(); }

  void enter(Phase phase);
  Phase phase() const;
  void simulated(const TimeSignature& now, Nanoseconds due);
  /// A frame has been shown, or the last one once more while the show stands still.
  void shown();
  /// 0, or the errno of why it cannot be written; the one before is then still the newest.
  int keep(Kept kept, std::span<const std::uint8_t> scene);
  /// The player simulates what it has missed until then, by machineClock(), at the latest.
  void catchesUpUntil(Nanoseconds clock);
  /// A show begins from its start: no moment and no scene of before is of it.
  void forget();
  /// What the operator has decided.
  void obeyed(const OperatorState& state);

  Moment newest() const;
  std::uint64_t framesShown() const;
  Nanoseconds lastShown() const;  ///< machineClock(); 0: none yet
  /// How long the present player has shown pictures since it had caught up; 0 until then [ns].
  Nanoseconds played() const;
  std::optional<Kept> kept() const;
  /// The scene of kept(); empty if it cannot be read.
  std::vector<std::uint8_t> scene() const;
  /// As obeyed() was told last; the rest as it is when a run begins.
  OperatorState operatorState() const;
  /// Where show time would be now, had it gone on since the newest frame [ns].
  Nanoseconds timeNow() const;

  /// Players so far; who watches counts them.
  std::uint64_t starts() const;
  void countStart();

private:
  struct Page;
  SharedProgress(Descriptor file, Page* page) : file_(std::move(file)), page_(page) {}
  static std::unique_ptr<SharedProgress> map(Descriptor file);

  Descriptor file_;
  Page* page_;
};

}  // namespace stadion
