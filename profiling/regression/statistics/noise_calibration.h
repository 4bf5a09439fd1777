#pragma once
/// A fixed piece of work, run in the same minute as a measurement. Times in multiples of it can be compared
/// between days, and between machines of different speed.
///
/// Threads  free functions, any thread.

namespace stadion::regression {

/// Returns the processor time of the kernel [ms], the least of a few runs. It does arithmetic, sorting, and
/// random access to memory, about a third each, some 10 ms in all.
double calibrationMs();

}  // namespace stadion::regression
