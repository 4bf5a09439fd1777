#pragma once
/// The library that gives a program its faults (fault_library/fault.h).

#include "tests/programs/program.h"

#include <string>

namespace stadion {

/// Its file, for LD_PRELOAD. There is none in builds with sanitizers.
inline std::string faultLibrary() {
  return STADION_BINARY_DIR "/bin/libfault-library.so";
}

}  // namespace stadion
