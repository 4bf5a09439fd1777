#pragma once
/// Boxes and meshes against each other.
///
/// Method   corners, edges and faces through FCL's oriented boxes with swept spheres: `distance` for the gap,
/// and motion
///          bounds of our own around it, so that a thin wall cannot be skipped. FCL is never asked for a
///          time.
/// Errors   an exception or a non-finite answer from the library counts as "unknown": the bodies keep their
/// last free pose.

#include "dynamics/rigid_body.h"

#include <functional>

namespace stadion {

struct Side;
struct Gap;
struct Touch;

/// Calls f with every corner of a box or mesh, in N.
void forEachCorner(const Shape& shape, const std::function<void(const Vec3&)>& f);

std::optional<Touch> polyhedraTouch(const Side& a, const Side& b, double from, double to,
                                    std::uint64_t& iterations);
Gap polyhedraGap(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB, double limit);

}  // namespace stadion
