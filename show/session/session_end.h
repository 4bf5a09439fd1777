#pragma once
/// How a session ended.

#include "show/base/process_status.h"
#include "show/base/stop_signal.h"

namespace stadion {

enum class SessionEnd {
  Played,
  Stopped,     ///< by a signal
  Refused,     ///< a file or an option is wrong, or a result that was asked for is missing
  Failed,      ///< our fault, OpenGL's, or the display was lost
  OtherFiles,  ///< in a cluster: the leader has other files
  WrongWrite,  ///< a stage wrote what it may only read (--guard)
  NoShow,      ///< no show could be opened, or no next one
};

/// Returns the exit status of the process.
inline int statusOf(SessionEnd end) {
  switch (end) {
  case SessionEnd::Played: return kPlayed;
  case SessionEnd::Stopped: return kStopped + stopSignal();
  case SessionEnd::NoShow:
  case SessionEnd::Refused: return kRefused;
  case SessionEnd::OtherFiles: return kOtherFiles;
  case SessionEnd::WrongWrite: return kWrongWrite;
  case SessionEnd::Failed: break;
  }
  return kFailed;
}

inline SessionEnd endOf(const Reason& why) {
  return why.kind == FailureKind::Refusal      ? SessionEnd::Refused
         : why.kind == FailureKind::WrongWrite ? SessionEnd::WrongWrite
                                               : SessionEnd::Failed;
}

}  // namespace stadion
