#pragma once
/// The words of `screen`, `projector` and `panorama` lines after their names, and of fields that walls and projectors share.
///
/// Errors  are reported at the word that is wrong.

#include "engine/display/wall_file.h"
#include "engine/display/wall_words.h"

#include <string>

namespace stadion {

/// Fills the surface of `screen`, which has its name. False after an error. A mesh gets only its file's name.
bool readScreen(StatementReader& in, LengthReader& lengths, Screen& screen);

/// The screen that a projector line names.
struct NamedScreen {
  std::string name;
  StatementPlace at;
};

/// Fills the projector, card and pixels of `entry`, whose wall has its name. Nothing after an error. A
/// measured image gets only its file's name, and the projector no screen.
std::optional<NamedScreen> readProjector(StatementReader& in, LengthReader& lengths, WallEntry& entry);

/// Fills the panorama, card and pixels of `entry`, whose wall has its name. False after an error. The panorama
/// has no size yet.
bool readPanorama(StatementReader& in, LengthReader& lengths, WallEntry& entry);

/// Reads the width and the height of a picture. False after an error.
bool readPixelSize(StatementReader& in, PixelSize& target);

/// Reads the number of a graphics card. False after an error.
bool readCard(StatementReader& in, std::optional<std::uint32_t>& target);

}  // namespace stadion
