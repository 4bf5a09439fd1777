#include "engine/nodes/rig_drive.h"

#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kLargestTurn = 0.25;  ///< of one part of the quadrature [rad]
constexpr int kMostParts = 4096;

Vec3 turned(double angle, const Vec3& v) {
  const det::SinCos t = det::sincos(angle);
  return {t.cos * v.x() - t.sin * v.y(), t.sin * v.x() + t.cos * v.y(), v.z()};
}

/// z x v.
Vec3 quarterTurned(const Vec3& v) {
  return {-v.y(), v.x(), 0};
}

/// The mean of turned(f * angle, v) over f from 0 to 1.
Vec3 meanTurned(double angle, const Vec3& v) {
  const double squared = angle * angle;
  double along = 1 - squared / 6 * (1 - squared / 20),
         across = angle / 2 * (1 - squared / 12 * (1 - squared / 30));
  if (std::fabs(angle) > 1e-2) {
    const det::SinCos t = det::sincos(0.5 * angle);
    along = 2 * t.sin * t.cos / angle;
    across = 2 * t.sin * t.sin / angle;
  }
  return {along * v.x() - across * v.y(), across * v.x() + along * v.y(), v.z()};
}

}  // namespace

/// Unit, or zero where the wand points straight up in walk mode. In World axes, at the rig's orientation.
Vec3 RigDrive::ahead(const Pose& X_WR, const Quat& q_RT) const {
  Vec3 d = X_WR.q * (q_RT * Vec3::UnitY());
  if (!fly) d.z() = 0;
  const double length = d.norm();
  return length > 1e-6 ? Vec3(d / length) : Vec3(Vec3::Zero());
}

Vec3 RigDrive::alongArc(const Pose& X_WR, const End& e) const {
  const double angle = -e.turn * turnRate * duration;
  const Vec3 u = X_WR.q * e.p_RH;
  return u - turned(angle, u) + e.forward * speed * duration * meanTurned(angle, ahead(X_WR, e.q_RT));
}

Vec3 RigDrive::alongWay(const Pose& X_WR, const End& first, const End& last) const {
  // Gauss-Legendre with four points, on [0, 1].
  constexpr double kAt[] = {0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                            0.93056815579702629};
  constexpr double kWeight[] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                0.17392742256872693};
  const double w0 = -first.turn * turnRate, w1 = -last.turn * turnRate;
  const double most = std::max(std::fabs(w0), std::fabs(w1)) * duration;
  const double pointing = det::logRotation(first.q_RT.conjugate() * last.q_RT).norm();
  const int parts = static_cast<int>(std::min((most + pointing) / kLargestTurn, kMostParts - 1.0)) + 1;
  Vec3 sum = Vec3::Zero();
  for (int part = 0; part < parts; ++part)
    for (int i = 0; i < 4; ++i) {
      const double s = (part + kAt[i]) / parts, t = s * duration;
      const double w = w0 + s * (w1 - w0), angle = t * (w0 + 0.5 * s * (w1 - w0));
      const Vec3 u = X_WR.q * (first.p_RH + s * (last.p_RH - first.p_RH));
      const double v = speed * (first.forward + s * (last.forward - first.forward));
      const Vec3 d = ahead(X_WR, det::slerp(first.q_RT, last.q_RT, s));
      sum += kWeight[i] * turned(angle, v * d - w * quarterTurned(u));
    }
  return sum * (duration / parts);
}

Pose RigDrive::moved(const Pose& X_WR, const End& first, const End& last) const {
  const bool same = first.turn == last.turn && first.forward == last.forward && first.p_RH == last.p_RH &&
                    first.q_RT.coeffs() == last.q_RT.coeffs();
  Pose X = X_WR;
  X.p += same ? alongArc(X_WR, first) : alongWay(X_WR, first, last);
  const double angle = -0.5 * (first.turn + last.turn) * turnRate * duration;
  X.q = (det::expRotation(Vec3(0, 0, angle)) * X_WR.q).normalized();
  return X;
}

}  // namespace stadion
