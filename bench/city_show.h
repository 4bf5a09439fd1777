#pragma once
/// A show of very many static nodes, for measurements: a city of small towers that reaches far beyond the
/// visible part, and a few swaying balloons near the visitor.
///
/// The room has four walls of 3 m around the visitor. The viewing distance keeps the visible part near a
/// hundredth of a million towers.
///
/// Threads  a plain function.

#include <cstddef>
#include <string>

namespace stadion::bench {

struct CityShow {
  std::size_t still = 1'000'000, moving = 100;
};

/// Writes city.evs, city.walls and tower.obj to the folder. Returns the error if it fails.
std::string writeCity(const std::string& folder, const CityShow& show);

}  // namespace stadion::bench
