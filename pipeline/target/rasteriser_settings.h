#pragma once
/// Settings of Mesa's software rasteriser in this process. Mesa reads them from the environment once, when
/// the first context is made.

#include "engine/base/diagnostic.h"

#include <optional>

namespace stadion {

/// Sets the settings that the environment leaves open: vectors of 256 bits, so that every machine computes
/// the same way, and one rasteriser thread per core, which all contexts of the process share. Also keeps the
/// memory that one frame frees for the next. The rasteriser frees megabytes in every frame, and the kernel
/// would have to clear each of their pages again (a quarter of a frame's cost).
///
/// Threads  changes the environment: the program calls it first, before it starts threads.
/// Errors   reports a setting in the environment with which the rasteriser crashes.
std::optional<Diagnostic> pinRasteriser();

/// Keeps the memory that one frame frees for the next, as pinRasteriser() does.
void keepFreedMemory();

/// Returns the number of rasteriser threads that the environment sets. Call it before pinRasteriser(), which
/// sets the same variable.
std::optional<unsigned> rasteriserThreadsGiven();

/// Overrides the environment's number of threads. Call it before the first context is made and, like
/// pinRasteriser(), while no other thread reads the environment.
void setRasteriserThreads(unsigned threads);

/// Only checks, and changes nothing. Providers call it before they load Mesa.
std::optional<Diagnostic> checkRasteriser();

}  // namespace stadion
