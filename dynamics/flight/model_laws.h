#pragma once
/// From the models of a script to the plain numbers that steps are made with. Internal to dynamics/flight/.

#include "dynamics/flight/flight_model.h"
#include "dynamics/flight/laws.h"
#include "engine/maths/angles.h"

namespace stadion {
namespace {

[[gnu::always_inline]] inline V3<double> plain(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
[[gnu::always_inline]] inline Vec3 vec(const V3<double>& v) {
  return {v.x, v.y, v.z};
}

inline RodLaw lawOf(const RodFlight& m) {
  return {m.axialArea, m.crossArea, m.liftArea, m.crossArm, m.liftArm, m.damping};
}
inline PlateLaw lawOf(const PlateFlight& m) {
  return {m.dragArea, m.liftArea, m.liftGrowth, m.stallArea, m.momentVolume, 1 / m.stall, m.damping};
}
inline BallLaw lawOf(const SportsBall& m) {
  return {kPi * m.radius * m.radius, m.dragLow, m.dragDrop, m.criticalSpeed,
          1 / m.criticalWidth,       m.radius,  m.liftMost, 1 / m.liftScale};
}
inline TableLaw<TableFlight::Piece> lawOf(const TableFlight& m) {
  return {m.pieces.data(), static_cast<int>(m.pieces.size())};
}

}  // namespace
}  // namespace stadion
