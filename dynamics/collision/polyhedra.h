#pragma once
/// Meshes, and bounded planes, against each other.
///
/// Method   steps that our own motion bounds prove safe, so none skips a thin wall. Each step needs the gap
///          between the meshes. With a limit, both triangle trees are searched up to that distance. Without
///          one, FCL's oriented boxes with swept spheres find it. FCL is never asked for a time.
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
/// Returns the gap of two meshes that are nearer than `limit` [m]; else an infinite distance.
Gap meshesGapWithin(const TriangleTree& a, const Pose& X_WA, const TriangleTree& b, const Pose& X_WB,
                    double limit);

}  // namespace stadion
