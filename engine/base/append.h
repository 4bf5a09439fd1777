#pragma once
/// Adds to files that grow line by line.
///
/// Threads  any; two that add to the same file need a lock.
/// Errors   in the result, as an errno.

#include <string_view>

namespace stadion {

/// Adds all of the text to the end of a plain file that is open to append, or nothing: what a full disk takes
/// of it is cut off again, so that the next line does not begin behind half of one. 0, or why not.
int appendWhole(int file, std::string_view text);

}  // namespace stadion
