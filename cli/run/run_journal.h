#pragma once
/// What `run --journal FILE` writes down, for whoever looks after the installation: how a run began and
/// ended, what it told on the terminal meanwhile, which files came and went, trackers that fell silent, and
/// once a minute how it does.
///
/// Threads  see() on the App thread, the rest from any.
/// Errors   a line that cannot be written is told on stderr, the first one; the show goes on.

#include "engine/scene/scene.h"
#include "pipeline/record/journal.h"
#include "show/settings/run_options.h"

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace stadion {

class RunJournal {
public:
  /// Null without --journal, or, with the reason in the findings, if the file cannot be written; a supervised
  /// player's show goes on without it then.
  static std::unique_ptr<RunJournal> open(const RunOptions& options, Diagnostics& findings);

  void note(std::string_view what);
  void note(const Diagnostics& findings);
  /// The show has been opened: what is played where.
  void began(const RunOptions& options, const Player& player);
  /// A show begins, of the next group too: nothing of it is known yet.
  void beginGroup();
  /// After each App stage.
  void see(const TimeSignature& now, const InputSample& input, const Scene& scene);
  /// All walls have shown a frame. True for the run's first one.
  bool shown();
  /// `gl` says who draws.
  void firstPicture(const std::string& gl);
  /// A late frame, in words.
  void late(const std::string& text);
  /// The run is over; `code` is its exit status. Returns what that becomes if lines were lost.
  int ended(int code);

private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::minutes kEvery{1};

  explicit RunJournal(std::unique_ptr<Journal> file) : file_(std::move(file)) {}
  void noteLoads(const Scene& scene);
  void noteTrackers(const InputSample& input);
  void noteMinute(Clock::time_point now);
  std::string figures();

  std::unique_ptr<Journal> file_;
  std::mutex mutex_;  ///< of the next ones
  std::optional<Journal::Place> place_{};
  std::uint64_t shown_ = 0, shownBefore_ = 0, late_ = 0, lateBefore_ = 0;
  std::string lastLate_;
  // App's.
  std::uint64_t loadsSeen_ = 0;
  std::map<std::uint32_t, std::string> loads_;
  std::map<std::string, bool, std::less<>> heard_;  ///< trackers, whether they say something
  Clock::time_point minute_ = Clock::now();
};

}  // namespace stadion
