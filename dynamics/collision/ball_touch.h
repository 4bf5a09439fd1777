#pragma once
/// Two balls whose centres follow paths of their own: how they turn does not matter.
///
/// Formula  under the same pull one flies straight past the other: |d + u t| = R is a quadratic equation.

#include "dynamics/collision/touch.h"

namespace stadion {

/// Returns true if the side is a ball about its own centre of mass that is not held, or one that stands
/// still.
inline bool isFreeBall(const Side& s) {
  return s.body ? s.body->centred && s.body->mode != BodyMode::Held
                : std::holds_alternative<BallShape>(*s.shape) && !s.collider->motion.moving;
}

/// Functions firstTouch() and gapBetween() for two free balls.
std::optional<Touch> ballsTouch(const Side& a, const Side& b, double from, double to, std::uint64_t& count);
Gap ballsGap(const Side& a, const Side& b, double tau);

}  // namespace stadion
