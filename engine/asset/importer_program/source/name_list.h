#pragma once
/// Names out of a model file, in sentences for its author.

#include <string>
#include <string_view>
#include <vector>

namespace stadion::importer {

/// The name between quotation marks; a long one is cut, and what is not printable becomes '?'.
std::string inQuotes(std::string_view name);

/// "2 lights" or "1 light".
std::string counted(std::size_t count, std::string_view one, std::string_view several = {});

/// `2 lights ("sun", "lamp")`: at most three names, then `and 5 more`. Things without a name count only.
std::string listed(const std::vector<std::string>& names, std::string_view one,
                   std::string_view several = {});

/// `"sun", "lamp"`, likewise; empty if none has a name.
std::string nameList(const std::vector<std::string>& names);

}  // namespace stadion::importer
