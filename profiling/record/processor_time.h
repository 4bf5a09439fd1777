#pragma once
/// Processor time of this process, its threads and all its descendants.
///
/// Running children count as well as finished ones, and so do their children. (RUSAGE_CHILDREN knows only
/// children that have ended and were waited for.)
///
/// Units    seconds.
/// Threads  plain function, any thread.
/// Errors   a process that ends during the call may be missing in that result.

namespace stadion {

double processorSeconds();

}  // namespace stadion
