#pragma once

namespace stadion {

/// Of the program, as CMakeLists.txt has it.
inline constexpr const char* kVersion = "0.1.0";

}  // namespace stadion
