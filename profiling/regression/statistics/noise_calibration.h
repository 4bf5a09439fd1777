#pragma once
/// A piece of work that is always the same, run in the same minute as what is timed: times in multiples of it
/// can be compared with those of another day, or of a machine of another speed.
///
/// Threads  free functions, any thread.

namespace stadion::regression {

/// Processor time of the kernel [ms], the least of a few: arithmetic, sorting, and a walk through memory that
/// no cache foresees, about a third each, some 10 ms in all.
double calibrationMs();

}  // namespace stadion::regression
