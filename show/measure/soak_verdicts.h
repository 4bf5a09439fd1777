#pragma once
/// What a soak showed, as verdicts: growth of memory, handles and threads, time steps, histories of states.
///
/// Threads  plain values.

#include "show/measure/soak_record.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

struct SoakVerdict {
  std::optional<bool> ok;  ///< nothing: it could not be judged
  std::string what;
  bool stays = false;  ///< a failure that more samples might hide: the record keeps it
};

/// `wanted` frames were to be played. `judgesMemory` false: growth is not judged.
std::vector<SoakVerdict> verdictsOf(const SoakRecord& record, std::uint64_t wanted, bool judgesMemory);

/// Returns true if nothing failed. What could not be judged is no failure.
bool isWell(const std::vector<SoakVerdict>& verdicts);

/// Returns the failures that the record is to keep.
std::vector<std::string> failuresToKeep(const std::vector<SoakVerdict>& verdicts);

}  // namespace stadion
