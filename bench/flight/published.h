#pragma once
/// Real throws: landings of the shipped models compared with published measurements.

#include "bench/flight/checks.h"

namespace stadion::bench {

/// Hubbard & Cheng (2007): the best throw of a discus at 25 m/s and 42 rad/s, 69.39 m; a javelin at 30 m/s
/// and 34 degrees lands at 85 to 91 m.
struct PublishedThrows {
  double discusRange = 0, gamma = 0, pitch = 0, roll = 0;  ///< [m], [degrees]
  double javelinRange = 0;                                 ///< [m]
  Checks checks;
};
PublishedThrows measurePublishedThrows();

}  // namespace stadion::bench
