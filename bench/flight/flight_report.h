#pragma once
/// All that `stadion bench flight` measures, as text and as JSON.

#include "bench/flight/cost.h"
#include "bench/flight/hard_cases.h"
#include "bench/flight/integrators.h"
#include "bench/flight/ladder.h"
#include "bench/flight/published.h"

namespace stadion::bench {

struct FlightReport {
  Ladder ladder;
  Integrators integrators;
  Costs costs;
  PublishedThrows published;
  Checks hard;

  Checks checks() const;  ///< all of them
};

std::string textOf(const FlightReport& report);
/// On one line, without its end.
std::string jsonOf(const FlightReport& report);
/// The same object, indented for readers.
std::string indentedJsonOf(const FlightReport& report);
bool allMet(const FlightReport& report);

}  // namespace stadion::bench
