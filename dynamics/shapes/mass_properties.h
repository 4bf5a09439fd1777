#pragma once
/// How much matter a body has and how it is spread.
///
/// Source   volume, centre and second moments as signed sums over the surface's triangles (divergence
///          theorem);
///          Mirtich, Fast and Accurate Computation of Polyhedral Mass Properties, 1996.

#include "engine/asset/mesh.h"
#include "engine/base/diagnostic.h"
#include "engine/maths/maths.h"

namespace stadion {

struct MassProperties {
  double mass = 1;                     ///< [kg]
  Vec3 centre = Vec3::Zero();          ///< centre of mass C in the node's coordinates N [m]
  Quat axes = Quat::Identity();        ///< q_NC: principal axes, C to N
  Vec3 inertia = Vec3::Constant(0.4);  ///< principal moments about C [kg m2], positive

  bool valid() const;
  /// Returns these properties for another mass of the same shape.
  MassProperties withMass(double kg) const;
};

/// Volume [m3], centre [m] and inertia about the centre per unit density [m5] in mesh coordinates.
struct VolumeIntegral {
  double volume = 0;
  Vec3 centre = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
};

/// Integrates over a closed mesh whose triangles face outwards. Otherwise returns the reason (open, flipped,
/// flat, not finite).
Result<VolumeIntegral> integrateVolume(const Mesh& mesh);

/// Returns the mass properties of a closed mesh filled with `density` [kg/m3].
Result<MassProperties> massOfMesh(const Mesh& mesh, double density);
MassProperties massOfSphere(const Vec3& centre, double radius, double density);
/// `half` extents along the axes of `pose`.
MassProperties massOfBox(const Pose& pose, const Vec3& half, double density);

/// Diagonalises a symmetric matrix: `axes` columns are right-handed, moments rise. Jacobi's method.
void principalAxes(const Mat3& symmetric, Vec3& moments, Quat& axes);

}  // namespace stadion
