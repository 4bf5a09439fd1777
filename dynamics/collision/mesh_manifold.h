#pragma once
/// The points at which two meshes touch or nearly touch.
///
/// Method   corners over faces, from both sides, and edges across edges, found by walking both trees at once.
///          Which side of a face is outside: of a closed mesh its normal says so, of an open one the side on
///          which the other body's middle is. A corner below a face counts only if nothing else of that mesh
///          is nearer to it; edges count if each lies in the wedge of directions that the other's faces leave
///          free.

#include "dynamics/collision/manifold.h"

namespace stadion {

/// The triangles of a side: its mesh, or the sheet that a bounded plane is, built into `sheet`. Null for
/// others.
const TriangleTree* trianglesOf(const Shape& shape, TriangleTree& sheet);

/// Appends points closer than `margin`, at most 8 of them, the deepest and the widest spread. `middleA` and
/// `middleB` are the bodies' middles in World. False if the meshes are farther apart than the margin; they
/// may be nearer without such a point, too.
bool meshesManifold(const TriangleTree& a, const Pose& X_WA, const Vec3& middleA, const TriangleTree& b,
                    const Pose& X_WB, const Vec3& middleB, double margin, std::vector<ManifoldPoint>& points);

/// A corner of a mesh that is over no face of a sheet, but a little beyond its border.
struct CornerBeyond {
  ManifoldPoint point;  ///< on the plane of the sheet
  Vec3 border;          ///< the place of the border that is nearest
  Vec3 inwards;         ///< from the corner to there, along the sheet, unit
};

/// Appends the corners of a that are beyond the border of the sheet b by no more than `margin`. Another piece may
/// begin there and rise: then what has sunk into that piece is still over the sheet.
void cornersBeyondBorder(const TriangleTree& a, const Pose& X_WA, const Vec3& middleA, const TriangleTree& b,
                         const Pose& X_WB, double margin, std::vector<CornerBeyond>& corners);

}  // namespace stadion
