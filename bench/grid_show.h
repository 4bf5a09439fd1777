#pragma once
/// A show of very many nodes, for measurements: pillars on a grid. A path moves each of some of them up and
/// down; the others stand still.
///
/// Threads  a plain function.

#include <cstddef>
#include <string>

namespace stadion {

struct GridShow {
  std::size_t nodes = 10'000;  ///< paths and objects together
  std::size_t moving = 5'000;  ///< paths, each with an object; visited by App in every frame
};

/// Returns the script. It needs suites/pillar.obj of the asset root scripts/.
std::string gridScript(const GridShow& show = {});

}  // namespace stadion
