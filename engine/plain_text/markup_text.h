#pragma once
/// Text as content, or as a value in quotes, of XML 1.0 and HTML.
///
/// Threads  a plain function.

#include <string>
#include <string_view>

namespace stadion {

/// &, <, > and both quotes are escaped. What XML cannot hold is replaced: control characters by blanks, bytes
/// that are no UTF-8 and characters that are none by U+FFFD; names of files and nodes may be anything.
std::string markupText(std::string_view text);

}  // namespace stadion
