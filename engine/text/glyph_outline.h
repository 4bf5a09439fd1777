#pragma once
/// From a glyph's path to the area that its strokes cover.
///
/// Units    as in glyphs.h: hundredths of the height of a capital.

#include <string_view>
#include <vector>

namespace stadion {

struct GlyphPoint {
  double x = 0, y = 0;
};

/// A stroke as a band between two rails, which have as many points; seen along its way, one is left of it and
/// one right. Closed: the last points are followed by the first.
struct Band {
  std::vector<GlyphPoint> left, right;
  bool closed = false;
};

/// Expects a path as glyphs.h describes it. Arcs become chords of at most 10 degrees.
std::vector<Band> bandsOf(std::string_view path);

}  // namespace stadion
