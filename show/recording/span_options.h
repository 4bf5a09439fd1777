#pragma once
/// What `run` can be asked to measure frame by frame, and to spoil. For `stadion regress` and its tests.

#include <string>

namespace stadion {

struct SpanOptions {
  std::string file;           ///< where the record goes; empty: nowhere
  std::string planted;        ///< see PlantedDelay::parse
  bool turns = false;         ///< frames are taken in turns with another run, over the standard input
  bool instructions = false;  ///< callgrind counts them
  bool hardware = false;      ///< the processor's counter does
};

}  // namespace stadion
