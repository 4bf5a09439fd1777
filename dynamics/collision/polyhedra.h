#pragma once
/// Meshes, and bounded planes, against each other.
///
/// Method   steps that motion bounds of our own allow, so that a thin wall cannot be skipped, from gap to
/// gap. While
///          something may be reached the gap is searched in both triangle trees no farther than that; without
///          a limit FCL's oriented boxes with swept spheres find it. FCL is never asked for a time.
/// Errors   an exception or a non-finite answer from the library counts as "unknown": the bodies keep their
///          last free pose.

#include "dynamics/body/rigid_body.h"

namespace stadion {

struct Side;
struct Gap;
struct Touch;

std::optional<Touch> meshesTouch(const Side& a, const Side& b, double from, double to,
                                 std::uint64_t& iterations);
Gap meshesGap(const MeshShape& a, const Pose& X_WA, const MeshShape& b, const Pose& X_WB);
/// The same for meshes nearer than `limit` [m]; an infinite distance if they are not.
Gap meshesGapWithin(const TriangleTree& a, const Pose& X_WA, const TriangleTree& b, const Pose& X_WB,
                    double limit);

}  // namespace stadion
