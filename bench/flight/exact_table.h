#pragma once
/// The coefficients of an object's exact model at steps of a few degrees, as from a wind tunnel.

#include "bench/flight/objects.h"
#include "dynamics/flight/flight_table.h"

namespace stadion::bench {

struct ExactTable {
  std::vector<FlightTableRow> rows;
  double area = 1, length = 1;
  int axis = 0;
};
/// For a javelin or a discus, at 30 m/s.
ExactTable exactTable(Thing thing);

TableFlight tableOf(const ExactTable& table);
/// Returns the text of the file that `flighttable` names.
std::string textOf(const ExactTable& table);

}  // namespace stadion::bench
