#pragma once
/// The inside of a ShowSession: opens shows, one after the other, and plays them with all parts.

#include "show/player/drawing_plan.h"
#include "show/session/journal_reporter.h"
#include "show/session/session_part.h"

#include <memory>
#include <optional>
#include <vector>

namespace stadion {

class OpenSession {
public:
  OpenSession(SessionSettings settings, Reporter& terminal, const std::atomic<bool>& stop);
  ~OpenSession();

  bool open(Diagnostics& findings);
  /// The step after a show has been played.
  enum class Then { Ends, NextGroup, Rejoin };
  Then playOnce(std::optional<SessionReport>& report);
  /// Creates the next group's show; only the files that were read are reused. Returns false if there is
  /// none.
  bool nextGroup();
  /// The show as the leader has it now. False if there is none.
  bool rejoin();
  SessionEnd close(SessionEnd end);

  const SessionState& state() const { return state_; }
  Reporter& reporter() { return reporter_; }

private:
  bool openDrawing(Diagnostics& findings);
  bool canDraw(Diagnostics& findings);
  bool haveCards(Diagnostics& findings);
  void reconsiderDrawing();
  std::unique_ptr<Player> openShow(Diagnostics& findings);
  std::unique_ptr<Player> createPlayer(const ShowOptions& show, Diagnostics& findings);
  ImportedMeshes* models();
  bool openGroup(Diagnostics& findings);
  void closeShow(NextShow next, Diagnostics& findings);
  bool waitForScript();
  ShowParts stageParts();
  void fillReport(SessionReport& report, const FrameLoopOutcome& outcome, double elapsed);
  void addDrawing(RunSummary& summary) const;
  void addTimes(RunSummary& summary) const;
  void writeSummary(SessionReport& report);

  Reporter& terminal_;
  std::unique_ptr<RunJournal> journal_;
  JournalReporter reporter_;
  SessionState state_;
  std::unique_ptr<ShowRenderer> renderer_;
  std::optional<DrawingPlan> drawing_;
  std::unique_ptr<OperatorWeb> web_;  ///< hears of frames until the parts are closed
  std::unique_ptr<OperatorConsole> console_;
  std::unique_ptr<Player> player_;
  std::vector<std::unique_ptr<SessionPart>> parts_;  ///< closed before the player
};

}  // namespace stadion
