#pragma once
/// The options that say which show is played, on which walls and for how long: the same in every subcommand.
///
/// Ownership  the options' values are written into `o`, which must stay where it is until the command line
///            has been read.

#include "show/player/player.h"

namespace CLI {
class App;
}

namespace stadion {

void addShowOptions(CLI::App& command, ShowOptions& o);
/// Only those that say what is played and how long: rate, length, input, assets.
void addLengthOptions(CLI::App& command, ShowOptions& o);

}  // namespace stadion
