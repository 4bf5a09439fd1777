#pragma once
/// `stadion run --supervise`: another process plays the show; this one watches over it.
///
/// A player that dies, or shows no frame for too long, is replaced, and the next one goes on from the scene
/// that was kept, at the show time that would be now.

#include "show/settings/run_options.h"

namespace stadion {

/// Plays until the show ends or is given up. Returns the exit code. Expects settled options, of this
/// process's own command line.
int superviseRun(const RunOptions& options);

}  // namespace stadion
