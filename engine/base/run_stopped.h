#pragma once
/// The only exception that is thrown on purpose.

namespace stadion {

/// Thrown by a wait in a run that was told to stop (a file is still being loaded, a frame takes long to
/// draw). Ends the work on the frame; the frame does not count.
struct RunStopped {};

}  // namespace stadion
