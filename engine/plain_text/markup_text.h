#pragma once
/// Text as content, or as a value in quotes, of XML 1.0 and HTML.
///
/// Threads  a plain function.

#include <string>
#include <string_view>

namespace stadion {

/// Escapes &, <, > and both quotes. Characters that XML cannot hold are replaced: control characters by
/// blanks, invalid UTF-8 and invalid characters by U+FFFD. Names of files and nodes may contain anything.
std::string markupText(std::string_view text);

}  // namespace stadion
