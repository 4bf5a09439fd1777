#pragma once

namespace stadion {

/// Version of the program, as in CMakeLists.txt.
inline constexpr const char* kVersion = "0.1.0";

}  // namespace stadion
