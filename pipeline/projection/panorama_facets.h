#pragma once
/// Facets of a panorama: the sides of a box around the eye, as far as the panorama shows them.
///
/// Method   each cell of the pixel map belongs to the side that its directions point at. A side's rectangle bounds the
///          directions of its cells, so neighbours overlap a little. Sides may be cut in halves: a dome master that
///          ends at the horizon needs only half of four sides, and all facets have pictures of one size. The cheaper
///          way is taken.
/// Sampling  the pixels of a facet's picture are as dense in its middle as those of the panorama. A cube's facets
///          are its sides, pixel for pixel.
/// Frames   rectangles are relative to the eye, in the axes of R; their distance is 1.
/// Threads  pure function.

#include "engine/panorama/panorama.h"
#include "pipeline/projection/facets.h"
#include "pipeline/projection/pixel_map.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace stadion {

struct PanoramaFacets {
  Facets facets;                     ///< their pixels of the output are not set
  std::vector<std::uint8_t> byCell;  ///< facet of each cell of the map; 0xff: dark
};

/// Returns the facets for the map of the panorama's directions; nothing if cells are so large that no plane shows
/// them.
std::optional<PanoramaFacets> panoramaFacets(const Panorama& panorama, const PixelMap& map);

}  // namespace stadion
