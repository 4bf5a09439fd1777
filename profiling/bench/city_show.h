#pragma once
/// A show of very many nodes that stand still, for measurements: a city of small towers that reaches far
/// beyond what can be seen, and near the visitor a few balloons that sway.
///
/// The room is four walls of 3 m about the visitor, who sees as far as keeps the visible part near a
/// hundredth of a million.
///
/// Threads  a plain function.

#include <cstddef>
#include <string>

namespace stadion::bench {

struct CityShow {
  std::size_t still = 1'000'000, moving = 100;
};

/// Writes city.evs, city.walls and tower.obj to the folder. Returns why it could not.
std::string writeCity(const std::string& folder, const CityShow& show);

}  // namespace stadion::bench
