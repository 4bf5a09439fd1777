#pragma once
/// A herald with his trumpet and a judge with his forked staff, as models with clips: "wait", and
/// "call" of the herald, "approve" of the judge.

#include "assets/generator/craft/figure_model.h"

namespace stadion::assets {

FigureModel herald();
FigureModel judge();

/// A trumpet of bronze, 1.1 m, its mouthpiece at the origin, +Y to the bell. The herald's "grip" carries it.
Parts trumpet();
/// A forked rod of 1.75 m, upright, held at the origin. A judge's "grip" carries it.
Parts staff();

}  // namespace stadion::assets
