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

#include "dynamics/collision/touch.h"

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

/// Returns true if the contact `gap` of a body with a piece at X_WN is hidden by the surface `on` that it
/// touches as well.
bool isHidden(const Gap& gap, const Shape& piece, const Pose& X_WN, const Bearing& on);

/// Which points of one body the surfaces at others hide, one flag each; empty if none. What only hidden ones
/// hide counts as not hidden: something must carry the body.
std::vector<char> hiddenAmong(const std::vector<Bearing>& points);

}  // namespace stadion
