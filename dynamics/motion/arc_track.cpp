#include "dynamics/motion/arc_track.h"

#include "engine/maths/functions.h"

#include <algorithm>

namespace stadion {

ArcPiece ArcPiece::straight(const Instant& from, const Pose& X_WN, const Vec3& v, const Vec3& omega) {
  ArcPiece part;
  part.from = from;
  part.path = v.isZero(0) ? Path::still(X_WN.p) : Path::parabola(X_WN.p, v, Vec3::Zero());
  part.spin = omega.isZero(0) ? Spin::still(X_WN.q) : Spin::driven(X_WN.q, omega, Vec3::Zero(), 1);
  return part;
}

ArcPiece ArcPiece::curved(const Instant& from, double seconds, const PoseCurve& curve) {
  ArcPiece part;
  part.from = from;
  part.path.degree = 4;
  double scale = 1;
  for (std::size_t k = 0; k < curve.p.size(); ++k, scale /= seconds) part.path.c[k] = scale * curve.p[k];
  part.path.boundAcceleration(seconds);
  const bool turns =
      std::any_of(curve.q.begin() + 1, curve.q.end(), [](const Eigen::Vector4d& c) { return !c.isZero(0); });
  const auto end = [&](double s) {
    const PoseCurve::Turning turning = curve.turningAt(s);
    return Spin::End{curve.at(s).q, turning.omega / seconds, turning.alpha / (seconds * seconds)};
  };
  // With moments of inertia of 1, the angular momentum is the angular velocity.
  part.spin = turns ? Spin::steered(end(0), end(1), seconds, Vec3::Ones()) : Spin::still(curve.at(0).q);
  return part;
}

Kinematics ArcPiece::at(double when) const {
  const double s = when - tau;
  const Pose X_WC{path.position(pathAge + s), spin.orientation(spinAge + s)};
  Kinematics k;
  k.pose = X_WC * X_CN;
  k.p = k.pose.p;
  k.omega = spin.angularVelocity(spinAge + s, X_WC.q);
  k.v = path.velocity(pathAge + s) + k.omega.cross(k.p - X_WC.p);
  return k;
}

MotionBound ArcPiece::boundOver(double start, double end) const {
  return boundOf(path, pathAge + start - tau, pathAge + end - tau, spin, spinAge + end - tau)
      .seenFrom(X_CN.p.norm());
}

bool ArcPiece::stands() const {
  return path.isParabola() && path.c[1].isZero(0) && path.c[2].isZero(0) && spin.kind == Spin::Kind::Still;
}

bool ArcPiece::straight() const {
  return path.isParabola() && path.c[2].isZero(0) && spin.kind == Spin::Kind::Still;
}

Pose poseOn(const ArcTrack& arcs, Nanoseconds time, Limit limit) {
  std::size_t i = 0;
  while (i + 1 < arcs.size() && arcs[i + 1].begins() <= time &&
         !(limit == Limit::Before && arcs[i + 1].jump && arcs[i + 1].begins() == time))
    ++i;
  return arcs[i].poseAfter(std::max(0.0, Instant{time, 0}.since(arcs[i].from)));
}

bool jumpsAt(const ArcTrack& arcs, Nanoseconds time) {
  return std::ranges::any_of(arcs, [&](const ArcPiece& p) { return p.jump && p.begins() == time; });
}

ArcTrack arcsOf(const PoseTrack& track) {
  ArcTrack arcs;
  for (std::size_t i = 0; i + 1 < track.size(); ++i) {
    const PoseKnot &from = track[i], &to = track[i + 1];
    if (to.time == from.time) continue;  // what a jump comes from
    const double seconds = toSeconds(to.time - from.time);
    if (to.jump) {
      arcs.push_back(ArcPiece::straight({from.time, 0}, from.X, Vec3::Zero(), Vec3::Zero()));
    } else if (to.between) {
      arcs.push_back(ArcPiece::curved({from.time, 0}, seconds, PoseCurve(from.X, *to.between, to.X)));
    } else {
      const Vec3 turn = from.X.q * det::logRotation(from.X.q.conjugate() * to.X.q);
      arcs.push_back(
          ArcPiece::straight({from.time, 0}, from.X, (to.X.p - from.X.p) / seconds, turn / seconds));
    }
    arcs.back().jump = from.jump;
  }
  arcs.push_back(ArcPiece::straight({track.back().time, 0}, track.back().X, Vec3::Zero(), Vec3::Zero()));
  arcs.back().jump = track.back().jump;
  return arcs;
}

void addChords(const ArcTrack& arcs, Nanoseconds end, PoseTrack& track) {
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const ArcPiece& part = arcs[i];
    const Nanoseconds begins = part.begins(), to = i + 1 < arcs.size() ? arcs[i + 1].begins() : end;
    const auto at = [&](Nanoseconds t) {
      return part.poseAfter(std::max(0.0, Instant{t, 0}.since(part.from)));
    };
    if (part.jump) track.push_back({begins, at(begins), true});
    if (!part.straight())
      for (Nanoseconds t = (begins / kChord + 1) * kChord; t < to; t += kChord)
        track.push_back({t, at(t), false});
    if (to > track.back().time && to <= end) track.push_back({to, at(to), false});
  }
}

}  // namespace stadion
