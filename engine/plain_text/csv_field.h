#pragma once
/// Text as a field of a table of values separated by commas (RFC 4180).
///
/// Threads  a plain function.

#include <string>
#include <string_view>

namespace stadion {

/// As it is; in quotes, with its own quotes doubled, if a comma, a quote or a line's end is in it.
inline std::string csvField(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + '"';
}

}  // namespace stadion
