#pragma once
/// Flights that break careless integrators.

#include "profiling/bench/flight/checks.h"

namespace stadion::bench {

Checks measureHardCases();

}  // namespace stadion::bench
