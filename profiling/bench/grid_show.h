#pragma once
/// A show of very many nodes, for measurements: pillars on a grid, some of them carried up and down by a path
/// each, the others standing still.
///
/// Threads  a plain function.

#include <cstddef>
#include <string>

namespace stadion {

struct GridShow {
  std::size_t nodes = 10'000;  ///< paths and objects together
  std::size_t moving = 5'000;  ///< paths, each with an object; visited by App in every frame
};

/// The script. It wants suites/pillar.obj of the asset root scripts/.
std::string gridScript(const GridShow& show = {});

}  // namespace stadion
