#pragma once
/// The exit statuses by which a process that plays a show tells its parent how the show ended. A supervisor
/// and the launcher of a cluster decide by them whether they start another process.

#include "pipeline/wall/stages.h"

namespace stadion {

enum ProcessStatus : int {
  kPlayed = 0,
  kRefused = 2,     ///< a file or an option is wrong, or a result that was asked for is missing
  kFailed = 3,      ///< our fault, OpenGL's, or the display was lost
  kOtherFiles = 4,  ///< in a cluster: the leader has other files; they may be equal when its next show begins
  kWrongWrite = 5,  ///< a stage wrote what it may only read (--guard)
  kStopped = 128,   ///< plus the number of the signal that ended the process, as in shells: 130, 143
};

/// The status of a run that could not continue.
inline ProcessStatus statusOf(const Reason& why) {
  return why.kind == FailureKind::Refusal      ? kRefused
         : why.kind == FailureKind::WrongWrite ? kWrongWrite
                                               : kFailed;
}

}  // namespace stadion
