#pragma once
/// Meshes against each other.
///
/// Method   FCL's oriented boxes with swept spheres for the gap, and motion bounds of our own around it, so
/// that a thin wall cannot be skipped. FCL is never asked for a time.
/// Errors   an exception or a non-finite answer from the library counts as "unknown": the bodies keep their
/// last free pose.

#include "dynamics/rigid_body.h"

namespace stadion {

struct Side;
struct Gap;
struct Touch;

std::optional<Touch> meshesTouch(const Side& a, const Side& b, double from, double to,
                                 std::uint64_t& iterations);
Gap meshesGap(const MeshShape& a, const Pose& X_WA, const MeshShape& b, const Pose& X_WB);

}  // namespace stadion
