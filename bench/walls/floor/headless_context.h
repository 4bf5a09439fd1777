#pragma once
/// An OpenGL context without a window: EGL on Mesa's surfaceless platform, as in the other programs.
///
/// Ownership  lives as long as the program runs; the context is current in the thread that made it.
/// Errors     the program ends with a message.

#include <cstdint>

namespace stadion::bench {

void openHeadlessContext(std::uint32_t width, std::uint32_t height);

}  // namespace stadion::bench
