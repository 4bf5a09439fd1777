#include "dynamics/collision/ball_flight.h"

#include <cmath>

namespace stadion {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// When u t + b t^2 / 2 first rises to g >= 0.
double riseTime(double g, double u, double b) {
  if (u <= 0) return b > 0 ? (std::sqrt(u * u + 2 * b * g) - u) / b : kNever;
  const double d = u * u + 2 * b * g;
  return d < 0 ? kNever : 2 * g / (u + std::sqrt(d));
}

/// When a height h over a surface, that changes at the rate u, falls to zero under b; 0 if it has, infinity
/// if it does not within `most`, as of what goes along the surface.
double ballFallTime(double h, double u, double b, double most) {
  constexpr double kLeaves = 1e-9;  ///< so deep it has just bounced [m]
  constexpr double kAlong = 1e-12;  ///< slower it does not come nearer [m/s]
  if (h <= 0 && h > -kLeaves && u > -kAlong && b >= 0) return kNever;
  if (h <= 0 && !(u > 0 && h > -kLeaves)) return 0;
  h = std::max(h, 0.0);
  const double d = u * u - 2 * b * h;
  if (d < 0 || (u >= 0 && b >= 0)) return kNever;
  const double time = u < 0 ? 2 * h / (std::sqrt(d) - u) : (u + std::sqrt(d)) / -b;
  return time <= most ? time : kNever;
}

}  // namespace

Aabb BallFlight::around(double s, double t) const {
  const Vec3 from = at(s), to = at(t);
  Aabb box{from.cwiseMin(to), from.cwiseMax(to)};
  for (int i = 0; i < 3; ++i) {
    const double turn = -v[i] / a[i];
    if (!(turn > s && turn < t)) continue;
    const double x = p[i] + 0.5 * turn * v[i];
    box.lo[i] = std::min(box.lo[i], x);
    box.hi[i] = std::max(box.hi[i], x);
  }
  const double margin = radius + 1e-9;
  box.lo.array() -= margin;
  box.hi.array() += margin;
  return box;
}

double BallFlight::timeToPlane(const Triangle& t, double most) const {
  double h = t.normal.dot(p - t.v[0]), u = t.normal.dot(v), b = t.normal.dot(a);
  if (h < 0) {
    h = -h;
    u = -u;
    b = -b;
  }
  return ballFallTime(h - radius, u, b, most);
}

BallFlight::Entry BallFlight::timeToBox(const BoxShape& box, double most) const {
  const BallFlight f = seenFrom(box.pose);
  Entry entry;
  int face = -1;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      // While it is outside of one face's plane it is outside of all.
      const double h = side * f.p[axis] - box.half[axis] - radius;
      const double time = ballFallTime(h, side * f.v[axis], side * f.a[axis], most);
      if (time > entry.time) {
        entry.time = time;
        face = axis;
      }
    }
  if (face < 0 || !(entry.time < kNever)) return entry;
  const Vec3 room = box.half - f.at(entry.time).cwiseAbs();
  entry.hit = room[(face + 1) % 3] >= 0 && room[(face + 2) % 3] >= 0;
  return entry;
}

BallFlight::Stay BallFlight::stayNear(const BoxShape& box, double far) const {
  const BallFlight f = seenFrom(box.pose);
  int face = 0;
  (f.p.cwiseAbs() - box.half).maxCoeff(&face);
  Stay stay{kNever, true, -1};
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const double room = box.half[axis] + (axis == face ? far + radius : 0) - side * f.p[axis];
      if (!(room > 0)) return {};
      const double time = riseTime(room, side * f.v[axis], side * f.a[axis]);
      if (time < stay.seconds) {
        stay.seconds = time;
        stay.sure = axis == face;
      }
    }
  return stay;
}

BallFlight::Stay BallFlight::stayNear(const Vec3& on, const Vec3& normal, double far) const {
  const double room = far + radius - normal.dot(p - on);
  if (!(room > 0)) return {};
  return {riseTime(room, normal.dot(v), normal.dot(a)), true, -1};
}

BallFlight::Stay BallFlight::stayNear(const TriangleTree& tree, std::int32_t triangle, double far) const {
  constexpr int kMostFaces = 32;
  constexpr double kBeside = 1e-9;  ///< so far beside a face counts as over it [m]
  Stay stay{0, false, triangle};
  for (int i = 0; i < kMostFaces; ++i) {
    const Triangle& face = tree.triangles()[static_cast<std::size_t>(stay.triangle)];
    const Vec3 x = at(stay.seconds), u = v + stay.seconds * a;
    const double h = face.normal.dot(x - face.v[0]), hu = face.normal.dot(u), hb = face.normal.dot(a),
                 room = far + radius;
    if (!(std::fabs(h) < room)) return stay;
    double least = std::min(riseTime(room - h, hu, hb), riseTime(room + h, -hu, -hb));
    int edge = -1;
    for (int k = 0; k < 3; ++k) {
      const Vec3& from = face.v[static_cast<std::size_t>(k)];
      const Vec3 out = (face.v[static_cast<std::size_t>((k + 1) % 3)] - from).cross(face.normal);
      const double beside = out.dot(x - from);
      if (beside > 0 && beside * beside > kBeside * kBeside * out.squaredNorm()) return stay;
      const double time = riseTime(std::max(-beside, 0.0), out.dot(u), out.dot(a));
      if (time < least) {
        least = time;
        edge = k;
      }
    }
    stay.seconds += least;
    if (edge < 0) {
      stay.sure = true;
      return stay;
    }
    const std::int32_t next = face.next[static_cast<std::size_t>(edge)];
    if (next < 0) return stay;
    stay.triangle = next;
  }
  return stay;
}

std::optional<BallFlight> flightOf(const Side& ball, double tau) {
  const RigidBody* b = ball.body;
  if (!b || b->mode == BodyMode::Held || !b->path.isParabola() || !b->centred) return {};
  const double age = b->age(tau);
  const auto& c = b->path.c;
  return BallFlight{c[0] + age * (c[1] + age * c[2]), c[1] + age * (2 * c[2]), 2 * c[2], b->radius()};
}

}  // namespace stadion
