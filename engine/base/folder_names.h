#pragma once
/// What lies in a folder.

#include <string>
#include <vector>

namespace stadion {

/// The names of all entries but "." and "..", in no order; none if the folder cannot be read. Where memory is
/// short it throws, unlike the iterators of the standard library, which end the program there.
std::vector<std::string> namesIn(const std::string& folder);

}  // namespace stadion
