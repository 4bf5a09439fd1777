#pragma once
/// Angles are radians everywhere, except where people read or write them.

namespace stadion {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kDegree = kPi / 180;  ///< [rad]

}  // namespace stadion
