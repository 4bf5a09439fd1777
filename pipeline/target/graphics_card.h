#pragma once
/// Finds out whether this machine has a graphics card, before any driver is loaded.
///
/// Threads  any.

#include <filesystem>
#include <optional>
#include <string>

namespace stadion {

/// Returns the device file of a graphics card: a render node of the kernel (dri/renderD128) or of NVIDIA's
/// driver (nvidia0). Nothing if there is none, or if this process may not use it.
std::optional<std::string> graphicsCardFile(const std::filesystem::path& devices = "/dev");

}  // namespace stadion
