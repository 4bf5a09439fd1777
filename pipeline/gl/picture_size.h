#pragma once
/// Limits of a picture's size. OpenGL does not check the size of every buffer, so we do.

#include "engine/base/diagnostic.h"

#include <cstdint>
#include <optional>

namespace stadion {

constexpr std::uint32_t kMaxPictureSide = 16384;         ///< [pixels]
constexpr std::uint64_t kMaxPicturePixels = 1ull << 26;  ///< 8192 x 8192; about 2.5 GB of buffers

/// Returns why a picture of this size is impossible, or nothing.
std::optional<Diagnostic> checkPictureSize(std::uint32_t width, std::uint32_t height);

}  // namespace stadion
