#pragma once
/// The earth of the track. Around the start, where visitors walk, it is finer and has marks of earlier
/// visitors.

#include "assets/generator/craft/part.h"

namespace stadion::assets {

/// The ground itself, and on it footprints, lines of lime, pebbles and tufts of grass.
Parts trackEarth();

}  // namespace stadion::assets
