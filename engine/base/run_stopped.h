#pragma once
/// The one thing that is thrown on purpose.

namespace stadion {

/// Thrown by whoever would keep a run waiting that has been told to stop (a file is still being loaded, a
/// frame takes long to draw). Ends the work on the frame; the frame does not count.
struct RunStopped {};

}  // namespace stadion
