#pragma once
/// The athletes: what they do, and their models with it.

#include "assets/generator/craft/figure_model.h"
#include "assets/generator/olympia/motion.h"

namespace stadion::assets {

Performance discusThrow();
Performance javelinThrow();
Performance ballKick();

/// Stands as the performance has him at this time; he breathes, shifts his weight and looks about. It
/// repeats.
Performance standing(const Performance& as, double time);
/// Stands where the performance ends, raises both arms twice, and stands again.
Performance cheering(const Performance& after);
/// Turns round where the performance ends, walks to where it begins, and turns again.
Performance walkingBack(const Performance& after);

/// The models with their clips: "wait" at the start, "throw", and where that ends "rest", "cheer" and "walk"
/// back to the start. What is held hangs from the bone "right_hand", or "grip", whose +X aims.
FigureModel discusThrower();
FigureModel javelinThrower();
FigureModel ballPlayer();

}  // namespace stadion::assets
