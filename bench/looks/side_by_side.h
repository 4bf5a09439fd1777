#pragma once
/// Pictures of one view beside each other, enlarged, so that their differences can be seen.
///
/// Threads  plain functions.

#include "pipeline/picture/picture.h"

#include <string>
#include <vector>

namespace stadion::bench {

struct LabelledPicture {
  std::string label;
  Picture picture;
};

/// The part of the pictures where they differ most from the first one, which is the reference: three in a
/// row, with labels. Expects at least one picture, and all of one size.
Picture sideBySide(const std::vector<LabelledPicture>& pictures);

}  // namespace stadion::bench
