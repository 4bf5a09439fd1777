#pragma once
/// Light maps as PNG files: 1, 2, 4, 8 or 16 bits a channel, grey or colour.
///
/// Bounds   a picture of more than kMostLightMapSide pixels a side is refused before it is unpacked.
/// Threads  pure functions.
/// Errors   are sentences for the user.

#include "engine/base/diagnostic.h"
#include "engine/display/projector.h"

#include <string>
#include <string_view>

namespace stadion {

inline constexpr std::uint32_t kMostLightMapSide = 8192;
inline constexpr std::uint64_t kMostLightMapPixels = 32ULL << 20;
inline constexpr std::size_t kMostLightMapBytes = 256U << 20;

struct ReadLightMap {
  LightMap map;                ///< gamma is 1
  bool hadOpacity = false;     ///< the file had a fourth channel, which is left out
  std::uint32_t bitDepth = 0;  ///< of the file [bits a channel]
};

/// Reads the bytes of a PNG file as they are: no gamma is applied.
Result<ReadLightMap> readLightMap(std::string_view png);

/// Writes the values as they are, with 16 bits a channel, or with 8 if that loses nothing.
Result<std::string> lightMapAsPng(const LightMap& map);

}  // namespace stadion
