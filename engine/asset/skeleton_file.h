#pragma once
/// A skeleton as bytes, within the bytes of its mesh (mesh_file.h).
///
/// Errors  readSkeleton() trusts nothing: every number is finite, every index in range, parents come before
///         their children, times ascend, and counts are within the limits.

#include "engine/base/value_reader.h"
#include "engine/base/value_writer.h"
#include "engine/figure/skeleton.h"

#include <optional>
#include <string>

namespace stadion {

/// Long names are cut to `kLongestName` bytes.
void putName(ValueWriter& out, const std::string& text);
bool getName(ValueReader& in, std::string& text);
constexpr std::uint32_t kLongestName = 1024;

void writeSkeleton(const Skeleton& skeleton, ValueWriter& out);
/// Nothing if the bytes are damaged. Its reach is to be made (mesh_checks.h).
std::optional<Skeleton> readSkeleton(ValueReader& in, const SkeletonLimits& limits);

}  // namespace stadion
