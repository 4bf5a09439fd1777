#pragma once
/// Processor time of this process, its threads and everything it started.
///
/// Children that run count as well as those that have ended, and theirs. (RUSAGE_CHILDREN knows only those
/// that have ended and were waited for.)
///
/// Units    seconds.
/// Threads  plain function, any thread.
/// Errors   a process that ends while it is looked at may be left out for that moment.

namespace stadion {

double processorSeconds();

}  // namespace stadion
