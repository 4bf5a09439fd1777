#pragma once
/// The places of Stadion's files and programs, in a checkout and in an installed copy.
///
/// Each is looked for from the folder of the running program, then beside the first `stadion` in PATH, since
/// a program that embeds Stadion may be anywhere. An environment variable takes precedence over both.
///
/// Threads  any; the environment must not change meanwhile.

#include <filesystem>
#include <string>

namespace stadion {

/// The folder with walls/, scripts/ and assets/: STADION_SHARE; else the first folder, from the program's own
/// upwards, that has walls/ or share/stadion/walls/. Empty if there is none.
std::string shareFolder();

/// Returns a program that another one starts, such as "stadion-import", or a library of Stadion that it loads. It
/// is looked for in STADION_PROGRAMS,
/// else beside the running program, in ../lib/stadion, or (for a program there) in ../../bin. Returns the
/// bare name if there is none: starting it then fails, and says so.
std::filesystem::path helperProgram(const std::string& name);

}  // namespace stadion
