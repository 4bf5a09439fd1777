#pragma once
/// Writes halls as MPCDI files (mpcdi_reader.h says how they are read).
///
/// The standard's part has a region for each wall and projector, with points of the screen and light maps: profile
/// sl if all projectors have flat lenses, otherwise a3, with lengths in metres and the origin on the floor. What
/// the standard cannot say (shapes of screens, corner pins, light, eyes, the visitor) stands in an extension named
/// Stadion: a wall file with its meshes and warps, and a digest of each region. The reader uses it as long as the
/// digests fit.
///
/// Computed blend ramps are not in the file: fill ProjectorBlend::alpha first if other programs are to read it.
///
/// Threads  pure function.
/// Errors   are sentences for the user.

#include "engine/base/diagnostic.h"
#include "engine/display/wall_file.h"
#include "engine/hall_formats/neighbour_files.h"

#include <string>

namespace stadion {

enum class MpcdiVersion {
  One,  ///< 1.0, which more programs read
  Two,  ///< 2.0, which also has the display's gamma
};

struct MpcdiSettings {
  MpcdiVersion version = MpcdiVersion::One;
  std::string date = "1980-01-01 00:00:00";  ///< of the file
};

/// Returns the bytes of the archive. `files` gives the masks that the hall names. Expects a hall whose meshes and
/// warps are loaded.
Result<std::string> formatMpcdi(const WallFile& hall, const NeighbourFiles& files,
                                const MpcdiSettings& settings);

}  // namespace stadion
