#include "dynamics/motion/arc_track.h"

#include <algorithm>

namespace stadion {

ArcPiece ArcPiece::straight(const Instant& from, const Pose& X_WN, const Vec3& v, const Vec3& omega) {
  ArcPiece part;
  part.from = from;
  part.path = v.isZero(0) ? Path::still(X_WN.p) : Path::parabola(X_WN.p, v, Vec3::Zero());
  part.spin = omega.isZero(0) ? Spin::still(X_WN.q) : Spin::driven(X_WN.q, omega, Vec3::Zero(), 1);
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
