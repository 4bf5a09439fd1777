#pragma once
/// Chooses the simplest shape that stands for a mesh in collisions.
///
/// Frames   in the coordinates of the mesh; metres.

#include "dynamics/shapes/shape.h"

#include <string>

namespace stadion {

/// Greatest deviation of a chosen shape from its mesh, relative to its size.
inline constexpr double kShapeTolerance = 0.02;

struct ShapeChoice {
  Shape shape;
  ShapeKind kind = ShapeKind::Mesh;  ///< never Auto
  double deviation = 0;              ///< greatest distance between shape and mesh, both ways [m]
  std::string remark;                ///< sentence for reports: the shape, and its deviation
};

/// The shape to collide with in place of `mesh`. Auto takes the first of plane, ball, box, capsule, cylinder
/// and convex hull that deviates by at most `tolerance`. The tolerance is relative to the size of a ball, and
/// to the thinner side of all others. If none fits, the mesh itself is taken.
///
/// Both directions count (shape_distance.h): a shape that closes a doorway deviates by the width of the
/// doorway. For round shapes the vertices count; facets between them may cut four times as deep. A kind that
/// is asked for is fitted as well as possible. Fails if the mesh has no usable triangle.
Result<ShapeChoice> chooseShape(const Mesh& mesh, ShapeKind requested = ShapeKind::Auto,
                                double tolerance = kShapeTolerance);

}  // namespace stadion
