#pragma once
/// What a session is made of. A part records a show, shows it, or has a say in how it is played; the session
/// plays it.
///
/// A part overrides the functions that concern it. To add one, write a file in parts/ with a function that
/// makes it, and add that function to the declaration and the list in session_parts.cpp.

#include "profiling/record/live_budget.h"
#include "show/base/reporter.h"
#include "show/cluster/cluster_session.h"
#include "show/console/operator_console.h"
#include "show/output/output_folder.h"
#include "show/recording/run_watch.h"
#include "show/session/journal_reporter.h"
#include "show/session/session_end.h"
#include "show/session/session_report.h"
#include "show/session/session_settings.h"
#include "show/supervision/run_journal.h"
#include "show/supervision/supervised_player.h"
#include "show/web/operator_web.h"

#include <functional>
#include <memory>

namespace stadion {

/// The state that the parts of a session share: a field for each of them, which is why it has more than 20.
/// A pointer is null if the session has no such thing, or not yet.
struct SessionState {
  SessionSettings settings;  ///< as asked for; the cluster file completes them
  JournalReporter& reporter;  ///< the journal and the operator's page receive its lines, too
  const std::atomic<bool>& stop;

  RunJournal* journal = nullptr;
  SupervisedPlayer* supervised = nullptr;
  ServiceNotifier* service = nullptr;
  ClusterSession* cluster = nullptr;
  OutputFolder* folder = nullptr;
  OperatorConsole* console = nullptr;
  OperatorWeb* web = nullptr;
  Player* player = nullptr;
  RunWatch* watch = nullptr;
  const ShowRenderer* renderer = nullptr;
  const DrawingPlan* drawing = nullptr;
  const ShowStages* stages = nullptr;  ///< stages of the played show
  const FrameLoop* loop = nullptr;
  LiveBudget* budget = nullptr;  ///< receives the costs of frames while they are shown

  /// Plays a loop to its end. A part that owns windows replaces it.
  std::function<FrameLoopOutcome(FrameLoop&)> runLoop = [](FrameLoop& l) { return l.run(); };
  /// Brings keys that were pressed in windows to the operator console. False: a window was lost.
  std::function<bool()> takeKeys = [] { return true; };
  bool drawnInWindows = false;
  bool inputIsLost = false;  ///< the input was to be recorded, and cannot be
  bool played = false;       ///< a show has been played
  bool reported = false;     ///< ... to its end, and report() has been called
};

/// A show whose loop has ended.
struct EndedLoop {
  const FrameLoopOutcome& outcome;
  bool ends;            ///< no show of another group follows
  bool rejoin = false;  ///< set by a part: the show is to be joined again, as the other machines have it
};

/// Which show follows.
enum class NextShow { OfGroup, Rejoined };

/// Threads  afterFrame() on the App thread, shown() on the Draw thread that swaps; all others on the
///          session's thread.
class SessionPart {
public:
  virtual ~SessionPart() = default;

  /// A show has been opened. False, with the reason in the findings, if it cannot be played.
  virtual bool opened(Diagnostics& /*findings*/) { return true; }
  /// The show is about to be played, by these stages and this loop.
  virtual void beforeFrames(ShowParts& /*stages*/, FrameLoopOptions& /*loop*/) {}
  /// A frame has been simulated.
  virtual void afterFrame(const TimeSignature& /*now*/, const InputSample& /*input*/,
                          const Scene& /*scene*/) {}
  /// All walls show a frame.
  virtual void shown() {}
  /// The loop has ended. From here on the session calls the parts in reverse order.
  virtual void ended(EndedLoop& /*show*/) {}
  /// The show is about to be closed, and another one follows.
  virtual void following(NextShow /*next*/, Diagnostics& /*findings*/) {}
  /// Adds to the report of the last show.
  virtual void report(SessionReport& /*report*/) {}
  /// The session is over. Returns how it ended, as far as this part can tell.
  virtual SessionEnd closed(SessionEnd end) { return end; }
};

/// Makes a part; null if the settings do not ask for it, or with the reason in the findings.
using MakeSessionPart = std::unique_ptr<SessionPart>(SessionState&, Diagnostics& findings);

/// All parts that the settings ask for. If the findings have errors, some are missing.
std::vector<std::unique_ptr<SessionPart>> makeSessionParts(SessionState& session, Diagnostics& findings);

/// Notes the first failure and reports it. What follows from it is not reported again.
void addFailure(SessionReport& report, const Failure& why, Reporter& reporter);

}  // namespace stadion
