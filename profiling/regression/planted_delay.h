#pragma once
/// Work without use, put somewhere on purpose, to see whether it is found. Only a probe that is told to does
/// it: nothing of this is in a run that nobody measures.
///
/// Threads  a plain value; burn() on any thread.

#include "engine/message.h"

#include <cstdint>
#include <optional>
#include <string>

namespace stadion::regression {

struct PlantedDelay {
  enum class Where { Simulate, Cull, Draw };
  Where where = Where::Cull;
  std::string name;              ///< of the node, or the wall
  NodeRef node{};                ///< Simulate: which one that is
  std::uint32_t wall = 0;        ///< Cull, Draw: likewise
  std::uint64_t iterations = 0;  ///< of burn(), once a frame

  /// "simulate:NODE=ITERATIONS", "cull:WALL=ITERATIONS", "draw:WALL=ITERATIONS"
  static std::optional<PlantedDelay> parse(const std::string& text);
};

/// The same instructions for the same count, whatever the machine.
void burn(std::uint64_t iterations);

/// Processor time of the thread [ns].
std::uint64_t threadNanoseconds();

}  // namespace stadion::regression
