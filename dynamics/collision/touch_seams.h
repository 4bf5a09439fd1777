#pragma once
/// Contacts that exist only because a surface is made of pieces.
///
/// A body that slides over flush pieces comes to the hidden side of the next piece. Rounding, or the little
/// by which the body has sunk in, makes that side look like a wall, or its upper edge like a ridge.
///
/// Rule     a contact with normal n is hidden by another contact of the same body, with normal m, if
///          1. it lies in the surface that the body touches there, give or take kFlush,
///          2. the touched piece does not go on along n's plane to above that surface, and
///          3. where n and m differ by less than 60 degrees, the surface goes on on the side that n leans to.
///          So steps below kFlush are no edges; a step above it is one.
/// Slopes   if the piece rises from there in a slope, the body meets the slope next. The contact gets its normal.
/// Slits    a corner that comes down between two flush pieces touches an edge of each. Both normals are the
///          body's then. The surface that the pieces make up gives the one normal that counts.

#include "dynamics/collision/touch.h"

#include <optional>
#include <vector>

namespace stadion {

constexpr double kFlush = 1e-4;  ///< pieces make up one surface if their levels differ by no more [m]

/// A point at which a body touches a piece, or nearly.
struct Bearing {
  ContactSide of;
  const Shape* shape = nullptr;
  Pose X_WN;  ///< pose of the shape
  Gap gap;    ///< normal to the body
};

/// Returns true if the contact `own` of a body is hidden by the surface `on` that it touches as well. That
/// surface may go on over the pieces of `others`.
bool isHidden(const Bearing& own, const Bearing& on, const std::vector<Bearing>& others);

/// Returns true if the contact `own`, at an edge, is one more of the surface `on`.
bool isInSurface(const Bearing& own, const Bearing& on);

/// Returns the normal of the slope by which the piece of `own` rises from there above the surface `on`. Expects a
/// contact that is hidden or in the surface. Nothing if the piece does not rise there.
std::optional<Vec3> normalOfRise(const Bearing& own, const Bearing& on);

/// Returns the normal of the slope by which a piece rises from the place `foot` above a plane with normal m. The
/// body is on the side of the slope that `side` leads to. Nothing if the piece does not rise there.
std::optional<Vec3> normalOfSlope(const Shape& piece, const Pose& X, const Vec3& foot, const Vec3& m,
                                  const Vec3& side);

/// Returns true if the normal of this contact is the one of the piece's surface, as it is not at an edge that
/// the body leans over.
bool isSquareToPiece(const Bearing& on);

/// The normal of the surface that pieces make up, if the body touches `a` and one of `others` at a slit between
/// them and neither normal is that of the surface.
std::optional<Vec3> normalOverSlit(const Bearing& a, const std::vector<Bearing>& others);

/// Which points of one body the surfaces at others hide, one flag each; empty if none. What only hidden ones
/// hide counts as not hidden: something must carry the body. Points at a slit get the normal of the surface,
/// and count once. Points at the foot of a slope get its normal.
std::vector<char> hiddenAmong(std::vector<Bearing>& points);

}  // namespace stadion
