#pragma once
/// Files that a foreign configuration names: they lie beside it, or in folders below.
///
/// Threads  one at a time.
/// Errors   are sentences with the name of the file.

#include "engine/base/diagnostic.h"

#include <functional>
#include <string>

namespace stadion {

/// Returns the content of the file of that name, of at most `limit` bytes.
using NeighbourFiles = std::function<Result<std::string>(const std::string& name, std::size_t limit)>;

/// Files in the folder of `configuration`. Names that are absolute or lead upwards are refused.
NeighbourFiles neighboursOf(const std::string& configuration);

}  // namespace stadion
