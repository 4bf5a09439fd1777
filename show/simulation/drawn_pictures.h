#pragma once
/// The pictures that the drawing makes, for the simulator.
///
/// Threads  as PictureSource.
/// Errors   create() fails as HallPictures does.

#include "engine/base/diagnostic.h"
#include "engine/display/wall_file.h"
#include "show/simulation/picture_source.h"

#include <memory>

namespace stadion {

/// Returns a source that draws the hall as a show does.
Result<std::unique_ptr<PictureSource>> drawnPictures(const WallFile& hall);

}  // namespace stadion
