#pragma once
/// Reads the user's files as a whole: plain files of a bounded size, and nothing that could block.
///
/// Errors   one sentence with the file's name: it does not exist, is a folder, a pipe or a device, is too
///          large, or cannot be read.
/// Threads  free functions, any thread.

#include "engine/base/diagnostic.h"

#include <cstddef>
#include <string>

namespace stadion {

/// The content of the plain file `path`, at most `limit` bytes. A pipe is not waited for; a file that is too
/// large is refused before any of it is read.
Result<std::string> readPlainFile(const std::string& path, std::size_t limit);

/// Reads a file that is open already; `path` is its name in messages.
Result<std::string> readPlainFile(int file, const std::string& path, std::size_t limit);

}  // namespace stadion
