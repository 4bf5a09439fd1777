#pragma once
/// The athletes' performances, and their sub-scenes.

#include "assets/generator/olympia/motion.h"

#include <string>

namespace stadion::assets {

Performance discusThrow();
Performance javelinThrow();
Performance ballKick();

/// The sub-scenes as text (.evs).
std::string discusScript();
std::string javelinScript();
std::string ballScript();

/// Two judges and a herald with his trumpet beside the start, as text.
std::string officialsScript();

}  // namespace stadion::assets
