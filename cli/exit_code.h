#pragma once
/// What the program's exit status means, to scripts and CI.

#include "engine/base/diagnostic.h"
#include "show/base/process_status.h"

#include <cstdio>

namespace stadion {

/// kOtherFiles, kWrongWrite and kStopped are those of any process that plays a show.
enum ExitCode : int {
  kOk = kPlayed,
  kCheckFailed = 1,          ///< a check or comparison failed
  kBadInput = kRefused,      ///< wrong usage, a wrong file, or a result that was asked for is missing
  kInternalFault = kFailed,  ///< our fault, OpenGL's, or the display was lost
  kReaderGone = 141,         ///< standard output is no longer read, as if SIGPIPE had ended the program
};

/// Returns the exit code of a run that ended early for this reason.
inline int exitCodeOf(const Reason& why) {
  return statusOf(why);
}

/// Writes to stderr why the program ends with `code`. Returns `code`.
inline int printError(const Diagnostic& why, int code) {
  std::fprintf(stderr, "stadion: %s\n", format(why).c_str());
  return code;
}

}  // namespace stadion
