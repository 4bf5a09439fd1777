#pragma once
/// A run of a show from opening it to its report, with everything that records it, shows it or decides how it
/// goes on.
///
/// A live session plays one show after the other, for one group of visitors each, until the operator ends it.
/// In a cluster it plays what the leader plays. What else it does is in its parts (session_part.h).
///
/// Ownership  owns all parts; the reporter and `stop` are the caller's and must outlive it.
/// Threads    main.
/// Errors     reported to the reporter; end() says how the session ended. Throws RunStopped if `stop` is set
///            while a show is opened.

#include "show/base/reporter.h"
#include "show/session/session_end.h"
#include "show/session/session_report.h"
#include "show/session/session_settings.h"

#include <atomic>
#include <memory>
#include <optional>

namespace stadion {

class OpenSession;

class ShowSession {
public:
  /// Once `stop` is true, the session ends after the frames in flight and writes all its files.
  ShowSession(SessionSettings settings, Reporter& reporter, const std::atomic<bool>& stop);
  ~ShowSession();

  /// Opens everything before anything is played, so that every error is found first. Reports `findings` and
  /// its own. False: the session has ended.
  bool open(Diagnostics findings = {});
  /// Plays to the end. Expects that open() has succeeded.
  SessionEnd play();

  SessionEnd end() const { return end_; }
  /// Returns the report of the last show. Null if none was played to its end.
  const SessionReport* report() const { return report_ ? &*report_ : nullptr; }
  /// Expects an open show.
  const Player& player() const;
  /// Returns true if another machine leads the show.
  bool follows() const;

private:
  std::unique_ptr<OpenSession> session_;
  std::optional<SessionReport> report_;
  SessionEnd end_ = SessionEnd::NoShow;
};

}  // namespace stadion
