#pragma once
/// The fields of an `output` line of a wall file:
///
///     output front  screen :0.1  rectangle 0 0 1920 1080  rotate 180  gamma 1.1
///
/// Errors  are reported at the word that is wrong.

#include "engine/display/output.h"
#include "engine/plain_text/statement_reader.h"

namespace stadion {

/// Reads the rest of the reader's line; nothing if it has errors.
std::optional<WallOutput> readOutput(StatementReader& in);

/// The fields as text that readOutput reads back to the same values.
std::string formatOutput(const WallOutput& output);

}  // namespace stadion
