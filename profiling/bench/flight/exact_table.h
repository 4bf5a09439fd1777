#pragma once
/// The coefficients of a thing's exact model every few degrees, as a wind tunnel would give them.

#include "dynamics/flight/flight_table.h"
#include "profiling/bench/flight/objects.h"

namespace stadion::bench {

struct ExactTable {
  std::vector<FlightTableRow> rows;
  double area = 1, length = 1;
  int axis = 0;
};
/// Of a javelin or a discus, at 30 m/s.
ExactTable exactTable(Thing thing);

TableFlight tableOf(const ExactTable& table);
/// The file that `flighttable` names.
std::string textOf(const ExactTable& table);

}  // namespace stadion::bench
