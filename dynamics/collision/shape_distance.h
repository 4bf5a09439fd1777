#pragma once
/// How far a simple shape and the mesh that it stands for are from each other, both ways.
///
/// One way alone is no measure: every corner of a doorway lies on the box around it. So points of the mesh's
/// faces are held against the shape's surface, and points of the shape's surface against the mesh's faces
/// that look the same way: what the shape closes is far from any. Of closed meshes the volumes are compared,
/// too.
///
/// Frames   both in the node's coordinates; metres.

#include "dynamics/shapes/shape.h"

namespace stadion {

/// The greatest distance either way, and the volumes' difference spread over the shape's surface. Exact of
/// what is flat; of a curved side, between points about a twentieth of its size apart. Stops looking beyond
/// `limit`: then it only says that it is more.
double distanceBetween(const Shape& shape, const TriangleTree& tree,
                       double limit = std::numeric_limits<double>::infinity());

}  // namespace stadion
