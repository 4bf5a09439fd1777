#pragma once
/// URIs as glTF files use them: names of files, and data in the text.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stadion::importer {

/// The name with its %20 and the like as characters. A wrong escape stays as it is.
std::string percentDecoded(std::string_view text);

bool isDataUri(std::string_view uri);

/// The bytes of `data:...;base64,...`; nothing if they are not base64.
std::optional<std::vector<std::uint8_t>> dataOf(std::string_view uri);

}  // namespace stadion::importer
