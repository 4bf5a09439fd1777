#pragma once
/// What an operator says while a hall is adjusted: as words, or as keys.
///
///     words                          keys
///     next, previous                 Tab, Shift-Tab         chooses a projector
///     projector NAME                                        chooses this one
///     pin 1|2|3|4                    1 2 3 4                upper left, upper right, lower right, lower left corner
///     edge left|top|right|bottom     5 6 7 8                where the ramp begins on this side
///     left|right|up|down [PIXELS]    arrows                 moves by 1 pixel; with Shift 10, with Control 0.1
///     undo, redo, save, quit         U, R, S, Q (Escape)
///     show                                                  writes the pictures to files
///
/// Threads  pure functions.

#include "pipeline/target/window.h"

#include <optional>
#include <string>
#include <string_view>

namespace stadion {

struct AdjustCommand {
  enum class Kind { Next, Previous, Projector, Pin, Edge, Move, Undo, Redo, Save, Quit, Show };
  Kind kind = Kind::Next;
  std::string name{};          ///< of a projector
  std::size_t number = 0;      ///< of a pin, from 0; of an edge, as PictureEdge
  double right = 0, down = 0;  ///< for Move [pixels]
};

struct AdjustWords {
  std::optional<AdjustCommand> command;
  std::string problem;  ///< why there is none; empty: the line has no words
};

/// Reads a line.
AdjustWords adjustCommandOf(std::string_view line);

/// Returns what a pressed key means; nothing: nothing.
std::optional<AdjustCommand> adjustCommandOf(const WindowEvent& press);

}  // namespace stadion
