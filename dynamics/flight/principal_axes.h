#pragma once
/// Along which directions a surface is spread, exactly and as the paper samples it.
///
/// Source   second moments of area over triangles, E = sum A/12 (a a' + b b' + c c' + 9 m m'), m = (a+b+c)/3.

#include "engine/asset/mesh.h"
#include "engine/maths/maths.h"

#include <cstdint>

namespace stadion {

struct PrincipalAxes {
  Vec3 centre = Vec3::Zero();    ///< middle of the surface, in N [m]
  Vec3 variance = Vec3::Ones();  ///< l1 >= l2 >= l3 [m2]
  Quat q_NP = Quat::Identity();  ///< x along l1, z along l3, right-handed
  Vec3 skewness = Vec3::Zero();  ///< third moments along the three axes [m3]

  /// Below 2 % difference there is no direction to speak of.
  bool round() const { return !(variance.x() - variance.z() > 0.02 * variance.x()); }
};

/// Returns the principal axes of the surface, weighted by area. Exact but for rounding. A mesh without area
/// gives unit axes and no variance.
PrincipalAxes surfaceAxes(const Mesh& mesh);

/// The paper's: of `samples` vertices drawn at random, each with equal chance. It depends on how the mesh is
/// cut, and does not converge to the surface's. The same seed draws the same vertices.
PrincipalAxes sampledAxes(const Mesh& mesh, std::size_t samples, std::uint64_t seed = 1);

}  // namespace stadion
