#pragma once
/// The people on the embankments, and the nearest of them as figures that move.

#include "assets/generator/craft/figure_model.h"
#include "assets/generator/olympia/person.h"

namespace stadion::assets {

struct Spectator {
  Person person;
  Point at;     ///< in the stadium
  double yaw;   ///< [rad]
  double size;  ///< 1 = a man of 1.76 m
  double near;  ///< [m] from where visitors walk
  double far;   ///< [m] likewise, but what lies behind them counts as farther
};

constexpr std::size_t kNearSpectators = 16;  ///< of a side

/// Those of one side, the nearest first.
std::vector<Spectator> spectatorsOn(double side);

/// The nearest of one side as one model, in the stadium's coordinates. Clips: "wait", which repeats, and
/// "cheer", which begins and ends as "wait" does; each person has phases of their own.
FigureModel nearSpectators(double side);

}  // namespace stadion::assets
