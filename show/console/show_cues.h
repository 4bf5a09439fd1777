#pragma once
/// The cues of a show, as the operator sees them.
///
/// Threads  cuesOf() on the App thread, or while no frame is simulated.

#include "engine/scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace stadion {

struct ShowCue {
  std::uint32_t number = 0;
  std::string name, label;

  /// "3 (The storm)"
  std::string text() const;
};

/// Returns the cues of all loaded files, by number.
std::vector<ShowCue> cuesOf(const Scene& scene);

}  // namespace stadion
