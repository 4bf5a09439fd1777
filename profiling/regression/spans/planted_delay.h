#pragma once
/// Useless work that is planted on purpose, to test whether it is found. It runs only if a probe requests it,
/// so runs without a probe never contain it.
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
  std::string name;                ///< name of the node, or of the wall
  NodeRef node{};                  ///< Simulate: the node with this name
  std::uint32_t wall = 0;          ///< Cull, Draw: the wall
  std::uint64_t iterations = 0;    ///< calls of burn(), in each chosen frame
  std::uint32_t milliseconds = 0;  ///< instead of iterations: a duration
  bool asleep = false;             ///< sleeps instead of working
  std::uint32_t every = 1;         ///< one frame of `every` is chosen
  std::uint32_t first = 0;         ///< the first chosen frame
  bool atRandom = false;           ///< chooses each frame with probability 1/every, other frames in each run

  /// "simulate:NODE=AMOUNT", "cull:WALL=AMOUNT", "draw:WALL=AMOUNT" or "frame:=AMOUNT". The amount is
  /// "ITERATIONS", "20ms" or "sleep20ms". Behind it "/EVERY" or "/EVERY+FIRST" choose frames, "~EVERY"
  /// chooses them at random.
  static std::optional<PlantedDelay> parse(const std::string& text);

  bool isIn(std::uint64_t frame) const;
  void spend() const;
};

/// Executes the same instructions for the same count, on every machine.
void burn(std::uint64_t iterations);

/// Processor time of the thread [ns].
std::uint64_t threadNanoseconds();

}  // namespace stadion::regression
