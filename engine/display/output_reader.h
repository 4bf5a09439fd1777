#pragma once
/// The fields of an `output` line of a wall file:
///
///     output front  screen :0.1  rectangle 0 0 1920 1080  rotate 180  gamma 1.1
///
/// Errors  are told with the word they are about.

#include "engine/base/text_line.h"
#include "engine/display/output.h"

namespace stadion {

/// Reads the words of the reader's line from `first` on; nothing if they have errors.
std::optional<WallOutput> readOutput(LineReader& in, std::size_t first);

/// The fields as text that readOutput reads back to the same values.
std::string formatOutput(const WallOutput& output);

}  // namespace stadion
