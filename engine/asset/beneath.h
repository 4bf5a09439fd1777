#pragma once
/// Opens files inside a folder, and no others.

#include "engine/base/file_descriptor.h"

#include <string>

namespace stadion {

/// Opens a regular file for reading, or a folder with `folder`, below `root` (an open folder). The kernel
/// refuses absolute paths, `..` and symbolic links that lead out. On failure the descriptor is empty and
/// errno tells why (EXDEV: it would have left the folder; EINVAL: not a regular file).
FileDescriptor openBeneath(int root, const std::string& path, bool folder = false);

}  // namespace stadion
