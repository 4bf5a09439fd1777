#pragma once
/// Memory shared by a player and its supervisor: the show's progress, whether it runs, and a recent snapshot
/// of the scene. The memory outlives the player, however it crashes.
///
/// A snapshot is written before or behind the newest one. It becomes the newest one only when it is complete,
/// so a player that crashes while writing leaves the previous one intact.
///
/// Ownership  owns a nameless file in memory; the player inherits its descriptor.
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
    Opening,  ///< files are read and drivers start
    Playing,  ///< pictures are expected
    Ending,   ///< the run is over; summaries are written
  };
  /// A frame, and the time of its simulation.
  struct Moment {
    std::uint64_t frame = 0;
    Nanoseconds time = 0;   ///< show time [ns]
    Nanoseconds clock = 0;  ///< machineClock(); 0: no frame yet
    Nanoseconds due = 0;    ///< show time without crashes: later than `time` while the player catches up
  };
  /// A saved scene, and the frame after which it was saved.
  struct Kept {
    std::uint64_t frame = 0;
    Nanoseconds time = 0;       ///< show time [ns]
    std::uint64_t history = 0;  ///< hash of the states up to then
    std::uint64_t bytes = 0;
    std::uint64_t at = 0;  ///< position of the snapshot, set by keep()
  };

  /// For the supervisor.
  static Result<std::unique_ptr<SharedProgress>> create();
  /// For the player, with the descriptor that it has inherited. Returns null if the descriptor is another
  /// file.
  static std::unique_ptr<SharedProgress> attach(int descriptor);
  ~SharedProgress();
  SharedProgress(const SharedProgress&) = delete;
  SharedProgress& operator=(const SharedProgress&) = delete;

  int descriptor() const { return file_.get(); }

  void enter(Phase phase);
  Phase phase() const;
  void simulated(const TimeSignature& now, Nanoseconds due);
  /// Reports that a frame was shown, or shown again while the show stands still.
  void shown();
  /// Saves a scene. Returns 0, or the errno of a failed write; then the previous scene stays the newest.
  int keep(Kept kept, std::span<const std::uint8_t> scene);
  /// Reports that the player catches up with missed frames, at most until then, by machineClock().
  void catchesUpUntil(Nanoseconds clock);
  /// Discards all moments and scenes, because a show begins from its start.
  void forget();
  /// Sets the operator's decisions.
  void setOperatorState(const OperatorState& state);

  Moment newest() const;
  std::uint64_t framesShown() const;
  Nanoseconds lastShown() const;  ///< machineClock(); 0: none yet
  /// Returns how long the present player has shown pictures since it caught up; 0 until then [ns].
  Nanoseconds played() const;
  std::optional<Kept> kept() const;
  /// Returns the scene of kept(); empty if it cannot be read.
  std::vector<std::uint8_t> scene() const;
  /// Returns the last state passed to setOperatorState(), otherwise the state at the start of a run.
  OperatorState operatorState() const;
  /// Returns the show time that would be reached now without a stop since the newest frame [ns].
  Nanoseconds timeNow() const;

  /// The number of players so far; the supervisor counts them.
  std::uint64_t starts() const;
  void countStart();

private:
  struct Page;
  SharedProgress(FileDescriptor file, Page* page) : file_(std::move(file)), page_(page) {}
  static std::unique_ptr<SharedProgress> map(FileDescriptor file);

  FileDescriptor file_;
  Page* page_;
};

}  // namespace stadion
