#pragma once
/// Facets: the flat views from which the picture of one projector is made.
///
/// A renderer draws onto planes. A curved part of a screen gets one plane or several: a facet is a rectangle
/// near a part of the screen, and the part of the output that it serves. Its rectangle covers that part of
/// the screen for all eyes within the visitor's reach, so it does not move with the head.
///
/// Sampling  the pixels of a facet's picture are about as dense as those of the output, seen from the usual
///           place. More facets cost more views, and fewer stretch more where rays meet the plane at a flat
///           angle: the number with the fewest pixels is taken.
/// Frames    R is the rig.
/// Units     metres.
/// Threads   pure functions.

#include "engine/display/frustum.h"
#include "engine/display/projector.h"
#include "pipeline/projection/thrown_image.h"

#include <cstdint>
#include <vector>

namespace stadion {

struct Facet {
  Wall rectangle;  ///< in R
  std::uint32_t left = 0, top = 0, right = 0,
                bottom = 0;  ///< its pixels of the output, without right, bottom
};

struct Facets {
  /// Of a projector for one eye; half of that for both: so many views fit into a draw list.
  static constexpr std::uint32_t kMost = 8;

  std::vector<Facet> all;
  std::uint32_t width = 0, height = 0;  ///< size of the picture of each facet [pixels]
};

/// Returns what it costs to draw the facets [pixels].
double costOf(const Facets& facets);

/// Returns the facets of a projector; none: it lights nothing that a visitor can see.
Facets facetsOf(const Projector& projector, const ThrownImage& image, const VisitorPlace& visitor);

}  // namespace stadion
