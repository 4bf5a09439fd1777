#pragma once
/// What the program's exit status means, to scripts and CI.

#include "engine/base/diagnostic.h"
#include "pipeline/wall/stages.h"

#include <cstdio>

namespace stadion {

enum ExitCode : int {
  kOk = 0,
  kCheckFailed = 1,    ///< a check or comparison failed
  kBadInput = 2,       ///< bad usage, a file of the user's is wrong, or not all that was asked for is there
  kInternalFault = 3,  ///< our fault, OpenGL's, or the display is gone
  kOtherFiles = 4,     ///< of a cluster: who leads has other files; with its next show they may be alike
  kStopped = 128,      ///< plus the number of the signal that ended a run, as shells have it: 130, 143
};

/// Of a run that could not go on.
inline ExitCode exitCodeOf(const Reason& why) {
  return why.kind == FailureKind::Refusal ? kBadInput : kInternalFault;
}

/// Says on stderr why the program ends with `code`, which it gives back.
inline int complain(const Diagnostic& why, int code) {
  std::fprintf(stderr, "stadion: %s\n", format(why).c_str());
  return code;
}

}  // namespace stadion
