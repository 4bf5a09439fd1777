#pragma once
/// Where the files that ship with Stadion lie: walls/, scripts/, assets/.

#include <string>

namespace stadion {

/// The folder that the environment variable STADION_SHARE names; else, from the folder of the running program upwards, the
/// first one that has walls/, or share/stadion/walls/ (an installed copy). Empty if there is none.
std::string shareFolder();

}  // namespace stadion
