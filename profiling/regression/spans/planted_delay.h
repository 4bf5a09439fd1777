#pragma once
/// Work without use, put somewhere on purpose, to see whether it is found. Only a probe that is told to does
/// it: nothing of this is in a run that nobody measures.
///
/// Threads  a plain value; burn() on any thread.

#include "engine/core/message.h"

#include <cstdint>
#include <optional>
#include <string>

namespace stadion::regression {

struct PlantedDelay {
  enum class Where { Simulate, Cull, Draw, Frame };  ///< Frame: between the stages
  Where where = Where::Cull;
  std::string name;                ///< of the node, or the wall
  NodeRef node{};                  ///< Simulate: which one that is
  std::uint32_t wall = 0;          ///< Cull, Draw: likewise
  std::uint64_t iterations = 0;    ///< of burn(), in each frame that has it
  std::uint32_t milliseconds = 0;  ///< instead of iterations: this much time
  bool asleep = false;             ///< the time is slept, not worked
  std::uint32_t every = 1;         ///< frames: it is in one of so many
  std::uint32_t first = 0;         ///< the first frame that has it
  bool atRandom = false;           ///< each frame has it with probability 1/every, other frames in each run

  /// "simulate:NODE=AMOUNT", "cull:WALL=AMOUNT", "draw:WALL=AMOUNT" or "frame:=AMOUNT". The amount is
  /// "ITERATIONS", "20ms" or "sleep20ms". Behind it "/EVERY" or "/EVERY+FIRST" choose frames, "~EVERY"
  /// chooses them at random.
  static std::optional<PlantedDelay> parse(const std::string& text);

  bool isIn(std::uint64_t frame) const;
  void spend() const;
};

/// The same instructions for the same count, whatever the machine.
void burn(std::uint64_t iterations);

/// Processor time of the thread [ns].
std::uint64_t threadNanoseconds();

}  // namespace stadion::regression
