#pragma once
/// Flights that break careless integrators: bodies so light that drag stops them within a step, fast spin
/// with and without air, starts from rest, flight backwards, gusts.

#include "bench/flight/checks.h"

namespace stadion::bench {

/// Returns one check for each case, with its limits and its unit.
Checks measureHardCases();

}  // namespace stadion::bench
