#pragma once
/// What the program's exit status means, to scripts and CI.

namespace stadion {

enum ExitCode : int {
  kOk = 0,
  kCheckFailed = 1,    ///< a check or comparison failed
  kBadInput = 2,       ///< bad usage, or a file of the user's is wrong
  kInternalFault = 3,  ///< our fault
};

}  // namespace stadion
