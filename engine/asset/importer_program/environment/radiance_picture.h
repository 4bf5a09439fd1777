#pragma once
/// Pictures of surroundings: the readers of their formats.
///
/// Radiance HDR (.hdr): "#?" and a head of lines, then runs of pixels with a common exponent (Ward 1991). The
/// reader is our own: stb_image takes a file that is cut short for a whole one.
/// OpenEXR (.exr): with the library OpenEXR, which only exr_picture.cpp includes.
///
/// Errors   Refusal: damaged, cut short, not twice as wide as high, too large, or with a pixel that is not a
///          finite number. A negative colour counts as 0, one above a million as that.

#include "engine/environment/radiance_map.h"

#include <span>

namespace stadion::importer {

/// The most columns of a picture; it has half as many rows.
constexpr std::uint32_t kMostRadianceColumns = 8192;

RadianceMap readRadianceHdr(std::span<const std::uint8_t> file);
RadianceMap readExr(std::span<const std::uint8_t> file);

/// Refuses a size that serves for no surroundings.
void checkRadianceSize(std::int64_t width, std::int64_t height);
/// Refuses colours that are not finite, and replaces negative ones.
void checkRadiance(RadianceMap& map);

}  // namespace stadion::importer
