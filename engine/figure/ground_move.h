#pragma once
/// How a bone moves along the ground: its way in x and y, and its turn about z. Height and tilt do not count.
///
/// The turn is that of the bone's axes against those at rest: of the turn between them, the part about z
/// (swing-twist decomposition). It is 0 where that part is undefined: the bone is upside down.
///
/// Frames   N: the mesh's, +Z up. A move maps N to N: p' = Rz(turn) p + (x, y, 0).
/// Bits     equal on every machine (engine/maths/functions.h).
/// Threads  pure.

#include "engine/maths/maths.h"

#include <cstdint>

namespace stadion {

struct GroundMove {
  double x = 0, y = 0;  ///< [m]
  double turn = 0;      ///< [rad]

  GroundMove operator*(const GroundMove& b) const;
  GroundMove inverse() const;
  Pose pose() const;
};

/// The move that takes a bone from where it is at rest to where it is, as far as the ground has it.
GroundMove groundMoveOf(const Affine& X_NB, const Affine& atRest);

/// What comes after `a` to make `b`, with a turn of half a turn at most.
GroundMove groundMoveBetween(const GroundMove& a, const GroundMove& b);

/// A move so many times. Depends on `times` alone, not on how it was reached: no drift.
GroundMove groundMovePower(const GroundMove& move, std::int64_t times);

}  // namespace stadion
