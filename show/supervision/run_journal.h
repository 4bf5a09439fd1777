#pragma once
/// The journal of a run, for the person who maintains the installation: how the run began and ended, what it
/// reported meanwhile, which files were loaded and unloaded, trackers that fell silent, and once a minute its
/// figures.
///
/// Threads  see() on the App thread, the rest from any.
/// Errors   the first line that cannot be written is reported as a fault; the show continues.

#include "engine/scene/scene.h"
#include "pipeline/record/journal.h"
#include "show/base/reporter.h"
#include "show/player/player.h"
#include "show/supervision/supervision_settings.h"

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace stadion {

class RunJournal {
public:
  /// Null if the settings name no file, or with the reason in the findings if it cannot be written. The show
  /// of a supervised player continues without it then. The reporter must outlive the journal.
  static std::unique_ptr<RunJournal> open(const SupervisionSettings& settings, Reporter& reporter,
                                          Diagnostics& findings);

  void note(std::string_view what);
  void note(const Diagnostics& findings);
  /// The show has been opened.
  void began(const ShowOptions& show, const Player& player);
  /// The show of the next group begins.
  void beginGroup();
  /// After each App stage.
  void see(const TimeSignature& now, const InputSample& input, const Scene& scene);
  /// All walls have shown a frame. True for the run's first one.
  bool shown();
  /// `gl`: the renderer, as describeGl() names it.
  void firstPicture(const std::string& gl);
  /// A late frame, in words.
  void late(const std::string& text);
  /// The run is over; `status` is its exit code. Returns kRefused instead of a good one if lines were
  /// lost.
  int ended(int status);

private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::minutes kEvery{1};

  RunJournal(std::unique_ptr<Journal> file, Reporter& reporter)
      : file_(std::move(file)), reporter_(reporter) {}
  void noteLoads(const Scene& scene);
  void noteTrackers(const InputSample& input);
  void noteMinute(Clock::time_point now);
  std::string figures();

  std::unique_ptr<Journal> file_;
  Reporter& reporter_;
  std::mutex mutex_;  ///< guards the members below
  std::optional<Journal::Place> place_{};
  std::uint64_t shown_ = 0, shownBefore_ = 0, late_ = 0, lateBefore_ = 0;
  std::string lastLate_;
  // App's.
  std::uint64_t loadsSeen_ = 0;
  std::map<std::uint32_t, std::string> loads_;
  std::map<std::string, bool, std::less<>> heard_;  ///< trackers, and whether they send samples
  Clock::time_point minute_ = Clock::now();
};

}  // namespace stadion
