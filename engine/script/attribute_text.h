#pragma once
/// How the rows of node types are described in words: in error messages, the language reference and editor
/// files.

#include "engine/core/node_registry.h"

#include <string>
#include <string_view>
#include <vector>

namespace stadion {

/// How a value of this attribute is written, for messages and the reference: `three numbers "x, y, z"`.
std::string formOf(const AttributeSpec& spec);
/// "at least 0", "greater than 0 m", "from 0 to 1"; empty if every number is allowed.
std::string describe(const NumberRange& range, std::string_view unit);
/// "a", "a or b", "a, b or c".
std::string joinWithOr(const std::vector<std::string>& words);
/// The names of the types that match.
std::string describe(const NodeRegistry& types, const NodeFilter& filter);

}  // namespace stadion
