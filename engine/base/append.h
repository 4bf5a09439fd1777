#pragma once
/// Appends to files that grow line by line.
///
/// Threads  any; two that append to the same file need a lock.
/// Errors   in the result, as an errno.

#include <string_view>

namespace stadion {

/// Appends all of the text to a plain file that is open to append, or nothing. If the disk gets full, the
/// written part is cut off again, so that the next line does not follow half of one. Returns 0, or an errno.
int appendWhole(int file, std::string_view text);

}  // namespace stadion
