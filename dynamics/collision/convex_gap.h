#pragma once
/// How far two convex bodies are apart, or how deep they overlap.
///
/// Method   where the point of one that reaches lowest over a face of the other lies over that face: no more
///          is needed. Else while they are clearly apart: coreDistance. Near a contact its normal is lost in
///          rounding, but the separating plane is then square to a face of one, or to an edge of each: the
///          widest gap over those directions is exact, and goes on smoothly below zero. Where features are
///          round, one body is held off along the normal found so far and the distance taken again: that
///          draws the normal to the true one. Deep overlap: with both made thinner first.

#include "dynamics/collision/gjk.h"

namespace stadion {

struct ConvexGap {
  double distance = 1e300;                      ///< distance of the rounded bodies; negative: overlap [m]
  Vec3 normal = Vec3::UnitZ();                  ///< from b to a, unit
  Vec3 onA = Vec3::Zero(), onB = Vec3::Zero();  ///< points of the surfaces that are nearest
};

/// `guess`: about the direction from b to a. `accuracy`: relative, while they are apart.
ConvexGap convexGap(const ConvexCore& a, const ConvexCore& b, const Vec3& guess, double accuracy = 1e-12);

/// The case of a face of b and the point of a that comes nearest to it. False if that point does not lie over
/// the face, unless it is more than `beside` off its plane: then the gap is that to the plane, a lower bound.
bool gapOverFace(const ConvexCore& a, const ConvexCore& b, double beside, ConvexGap& g);

/// The gap between the planes square to n that support the two: never more than their distance.
double separationAlong(const Vec3& n, const ConvexCore& a, const ConvexCore& b);

}  // namespace stadion
