#pragma once
/// Whether a path written in a script stays below the show's folders, judged by its letters alone.

#include <optional>
#include <string>
#include <string_view>

namespace stadion {

/// Returns the fault of a path; nothing if it is acceptable. The text ends a sentence that begins with the
/// path. Acceptable paths are relative, use "/", and lead neither out of the script's folder nor out of
/// `../assets`.
std::optional<std::string> faultOfPath(std::string_view path);

/// The ending in small letters without the dot: "obj"; empty if there is none.
std::string endingOf(std::string_view path);

}  // namespace stadion
