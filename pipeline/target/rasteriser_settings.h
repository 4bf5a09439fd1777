#pragma once
/// How Mesa's software rasteriser works in this process. It reads its settings from the environment once,
/// when the first context is made.

#include "engine/base/diagnostic.h"

#include <optional>

namespace stadion {

/// Settles the settings that nobody chose: vectors of 256 bits, so that every machine computes the same way,
/// and one rasteriser thread per core, which all contexts of the process share. And keeps the memory that one
/// frame frees for the next: the rasteriser frees megabytes in every frame, and the kernel would have to
/// clear each of their pages anew (a quarter of what a frame costs).
///
/// Threads  changes the environment: the program calls it first thing, before it starts threads.
/// Errors   says so when the environment asks for a setting with which the rasteriser crashes.
std::optional<Diagnostic> pinRasteriser();

/// How many threads the rasteriser has, if the environment says it. To be asked before pinRasteriser(), which
/// says it there itself.
std::optional<unsigned> rasteriserThreadsGiven();

/// So many threads, whatever the environment says. Before the first context is made, and like pinRasteriser()
/// while no other thread looks at the environment.
void setRasteriserThreads(unsigned threads);

/// The check alone: changes nothing. Providers call it before they load Mesa.
std::optional<Diagnostic> checkRasteriser();

}  // namespace stadion
