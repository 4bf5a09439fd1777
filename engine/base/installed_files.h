#pragma once
/// Where the files and programs that belong to Stadion lie, in a checkout and in an installed copy alike.
///
/// Each is looked for from the folder of the running program; then, since a program that embeds Stadion may
/// lie anywhere, beside the first `stadion` in PATH. An environment variable counts more than both.
///
/// Threads  any; the environment must not change meanwhile.

#include <filesystem>
#include <string>

namespace stadion {

/// The folder with walls/, scripts/ and assets/: STADION_SHARE; else the first folder, from the program's own
/// upwards, that has walls/ or share/stadion/walls/. Empty if there is none.
std::string shareFolder();

/// A program that another one starts, such as "stadion-import": in STADION_PROGRAMS; else beside the running
/// program, in
/// ../lib/stadion, or (for a program that lies there) in ../../bin. The bare name if there is none: starting
/// it then fails, and says so.
std::filesystem::path helperProgram(const std::string& name);

}  // namespace stadion
