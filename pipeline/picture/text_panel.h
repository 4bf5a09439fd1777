#pragma once
/// Lines of text on a dark, half transparent background, to be laid over a picture.
///
/// Threads  pure functions.

#include "pipeline/picture/picture.h"

#include <array>
#include <string>
#include <vector>

namespace stadion {

struct PanelLine {
  std::string text;
  std::array<std::uint8_t, 3> colour{235, 235, 235};
};

/// As wide as the longest line needs, at most `mostWidth` pixels; longer lines are wrapped.
Picture textPanel(const std::vector<PanelLine>& lines, std::uint32_t mostWidth, std::uint32_t scale = 2);

}  // namespace stadion
