#include "dynamics/collision/convex_touch.h"

#include "dynamics/collision/convex_manifold.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr int kMostLooks = 400;           ///< by steps that are certain to pass nothing
constexpr int kFallbackSteps = 1000;      ///< parts of the way in which the search continues after that
constexpr int kPatience = 6;              ///< looks until planes that turn are tried
constexpr double kSupportTie = 1e-8;      ///< points that reach as far but for this touch together [m]
constexpr double kGapAccuracy = 1e-5;     ///< accuracy of distances on the way
constexpr double kFaceOnlyBeyond = 0.05;  ///< of the body's reach: farther off a face its plane will do

double reachOf(const Side& s) {
  return s.body ? s.body->reach : s.bound().centre.norm() + s.bound().radius;
}

/// The point that a side's velocity belongs to.
Vec3 placeOf(const Side& s, double tau) {
  return s.body && s.body->mode != BodyMode::Held ? s.body->position(tau) : s.at(tau).p;
}

/// Returns true if the body is round about the axis that it spins freely about.
bool precesses(const Side& s) {
  if (!s.body || s.body->spin.kind != Spin::Kind::Symmetric || s.body->mode == BodyMode::Held) return false;
  const auto* cylinder = std::get_if<CylinderShape>(s.shape);
  const auto* capsule = std::get_if<CapsuleShape>(s.shape);
  if (!cylinder && !capsule) return false;
  const Pose X = s.body->X_CN * (cylinder ? cylinder->pose : capsule->pose);
  const Vec3 along = Vec3::Unit(s.body->spin.axis), own = X.q * Vec3::UnitZ();
  return own.cross(along).norm() <= 1e-9 && X.p.cross(along).norm() <= 1e-9 * s.body->reach;
}

/// One body of a pair at the moment of a look, relative to `origin`.
struct Mover {
  const Side& side;
  ConvexCore core;
  Vec3 p = Vec3::Zero(), v = Vec3::Zero(), omega = Vec3::Zero();
  double reach = 0;         ///< of its points from p [m]
  double drift = 0;         ///< bound on the acceleration of p [m/s2]
  double acceleration = 0;  ///< the same of its points
  bool turning = false;
  bool round = false;  ///< a disc or rod that precesses: what it spins about its axis does not show
  Vec3 precession = Vec3::Zero();  ///< round: steady [rad/s]

  Mover(const Side& s, double from, double to) : side(s), reach(reachOf(s)), round(precesses(s)) {
    if (s.still()) return;
    const MotionBound b = s.boundOver(from, to);
    drift = b.acceleration;
    if (round) {
      const Spin& spin = s.body->spin;
      precession = spin.inverse[(spin.axis + 1) % 3] * spin.L;
      const Vec3 own = spin.q0 * Vec3::Unit(spin.axis);
      turning = own.cross(precession).norm() > 1e-12 * precession.norm();
      if (!turning) precession.setZero();
      acceleration = drift + precession.squaredNorm() * reach;
      return;
    }
    acceleration = b.accelerationAt(reach);
    turning = b.spin > 0 || b.spinChange > 0;
  }
  /// Moves it there; returns X_RN.
  Pose moveTo(double tau, const Vec3& origin) {
    if (!round) {
      const Kinematics k = side.at(tau);
      p = k.p - origin;
      v = k.v;
      omega = k.omega;
      return {k.pose.p - origin, k.pose.q};
    }
    const RigidBody& body = *side.body;
    p = body.position(tau) - origin;
    v = body.velocity(tau);
    omega = precession;
    const Quat q = turning ? det::expRotation(body.spinAge(tau) * precession) * body.spin.q0 : body.spin.q0;
    return Pose{p, q} * body.X_CN;
  }
  Vec3 velocityAt(const Vec3& x) const { return v + omega.cross(x - p); }

  /// The greatest of (n + s w x n) . (x - o + s v_x) over the body without terms of s^2, and its rate of
  /// change; `w x n` is given.
  [[gnu::always_inline]] double farthest(const Vec3& n, const Vec3& tilt, const Vec3& o, double s,
                                         double& rate) const {
    const Vec3 turn = n.cross(omega) + tilt, d = n + s * turn;
    const Vec3 r = core.support(d) - p;
    const double pass = n.dot(v) + tilt.dot(p - o);
    double far = n.dot(p - o) + s * pass + d.dot(r);
    rate = pass + turn.dot(r);
    if (core.radius > 0) {
      const double l = d.norm();
      far += core.radius * l;
      rate += core.radius * d.dot(turn) / l;
    }
    return far;
  }
};

/// f(s) of the header with its slope, for the direction n from b to a that turns with w about o.
struct Lower {
  const Mover& a;
  const Mover* b;  ///< if it turns as seen from n
  Vec3 n;
  double level = 0, rise = 0;  ///< else how far it reaches along n, and the rate of that
  double acceleration, drift;
  Vec3 tilt = Vec3::Zero(), o = Vec3::Zero();

  Lower(const Mover& movingA, const Mover* movingB, const Vec3& normal, double plane, double bound)
      : a(movingA), b(movingB), n(normal), level(plane), acceleration(bound),
        drift(movingA.drift + (movingB ? movingB->drift : 0)) {
    if (!b || b->turning) return;
    level = b->farthest(n, tilt, o, 0, rise);
    b = nullptr;
  }
  /// The same with the direction turning, for no longer than `most`: of the terms of s^2 and above, tilt . v is
  /// bounded by the speeds of all points, and the direction grows a little.
  Lower(const Mover& movingA, const Mover& movingB, const Vec3& normal, double bound, const Vec3& w,
        const Vec3& about)
      : a(movingA), b(&movingB), n(normal), drift(0), tilt(w.cross(normal)), o(about) {
    const double speed = (a.velocityAt(o) - b->velocityAt(o)).norm() +
                         a.omega.norm() * ((a.p - o).norm() + a.reach) +
                         b->omega.norm() * ((b->p - o).norm() + b->reach);
    acceleration = std::sqrt(2.0) * bound + 2 * tilt.norm() * speed;
  }
  double most() const { return 1 / std::max(tilt.norm(), 1e-300); }
  double at(double s, double& slope) const {
    double ra, rb = rise;
    const double near = -a.farthest(-n, -tilt, o, s, ra),
                 far = b ? b->farthest(n, tilt, o, s, rb) : level + s * rise;
    slope = -ra - rb - acceleration * s;
    return near - far - 0.5 * acceleration * s * s;
  }
};

/// When g + u s - A s^2 / 2 reaches zero, `most` if later; g >= 0.
double fallTime(double g, double u, double A, double most) {
  const double root = std::sqrt(u * u + 2 * A * g);
  if (u < 0) return std::min(most, 2 * g / (root - u));
  return A > 0 ? std::min(most, (u + root) / A) : most;
}

/// Seconds in which f, that is `gap` now, does not fall below zero; `most` if it never does until then;
/// `known` if it is no more than that.
double safeTime(const Lower& f, double gap, double most, double known) {
  double slope = 0;
  const double shift = gap - f.at(0, slope);  // no step back for bodies that overlap already
  // Its tangent less A s^2 / 2 lies above a concave function.
  double right = fallTime(gap, slope, f.acceleration, most);
  if (right <= known) return known;
  double value = f.at(right, slope) + shift;
  if (value >= 0) return right;
  for (int i = 0; i < 12; ++i) {  // Newton from beyond the root of a concave function comes down to it
    if (!(slope < 0)) break;
    const double next = right - value / slope;
    if (!(next < right) || !(next > 0)) break;
    const bool done = right - next < 1e-2 * next;
    right = next;
    value = f.at(right, slope) + shift;
    if (value >= 0) return right;
    if (done) break;
  }
  if (gap > 0) return right * gap / (gap - value);  // the chord lies below
  for (const double part : {0.99, 0.9, 0.5, 0.1}) {
    double unused;
    if (f.at(part * right, unused) + shift >= 0) return part * right;
  }
  return 0;
}

/// Returns a safe time, as safeTime() does, for planes that turn with a face of a or b, or with an edge of
/// each.
double turningTime(const Mover& a, const Mover& b, const ConvexGap& g, double gap, double acceleration,
                   double most, double known) {
  const Vec3& n = g.normal;
  std::array<Vec3, 8> turns{a.omega, b.omega};
  std::size_t count = b.turning ? 2 : 1;
  const Directions da = directionsNear(a.core, -n, g.onA), db = directionsNear(b.core, n, g.onB);
  for (int i = 0; i < da.edgeCount; ++i)
    for (int j = 0; j < db.edgeCount && count < turns.size(); ++j) {
      const Vec3 &ea = da.edges[static_cast<std::size_t>(i)], &eb = db.edges[static_cast<std::size_t>(j)];
      const Vec3 across = n.cross(ea);
      const double along = across.dot(eb);
      if (std::fabs(n.dot(ea)) > 1e-4 || std::fabs(n.dot(eb)) > 1e-4 || std::fabs(along) < 0.05) continue;
      turns[count++] = b.omega + eb * ((a.omega - b.omega).dot(across) / along);
    }
  double longest = known;
  for (std::size_t i = 0; i < count; ++i) {
    const Lower f(a, b, n, acceleration, turns[i], g.onB);
    longest = std::max(longest, safeTime(f, gap, std::min(most, f.most()), longest));
  }
  return longest;
}

/// Returns a safe time for bodies that are held to be spheres, turning or not.
double sphereTime(const Lower& f, double most) {
  if (!f.a.turning && !f.b) return 0;
  const double far = f.b ? f.n.dot(f.b->p) + f.b->reach : f.level;
  const double g = f.n.dot(f.a.p) - f.a.reach - far;
  if (!(g > 0)) return 0;
  const double u = f.n.dot(f.a.v) - (f.b ? f.n.dot(f.b->v) : f.rise);
  return fallTime(g, u, f.drift, most);
}

/// The rate at which the gap closes at its fastest point: bodies turn into the contact by a hair.
double closingRate(const Lower& f) {
  const double spin = f.a.omega.norm() + (f.b ? f.b->omega.norm() : 0);
  double slope = 0;
  const double s = spin > 1e-9 ? 1e-9 / spin : 0;
  f.at(s, slope);
  return slope + f.acceleration * s;
}

/// Finds the contact point of a patch that touches all at once: its middle if it comes flat on, else the
/// point that comes fastest.
bool contactPoint(const Mover& a, const Mover* b, const std::vector<ManifoldPoint>& patch, double gap,
                  Vec3& x) {
  const auto rateAt = [&](const ManifoldPoint& p) {
    const Vec3& at = p.gap.point;
    return p.gap.normal.dot(a.velocityAt(at) - (b ? b->velocityAt(at) : Vec3(Vec3::Zero())));
  };
  double least = 1e300, most = -1e300;
  Vec3 sum = Vec3::Zero(), fastest = Vec3::Zero();
  int n = 0;
  for (const ManifoldPoint& p : patch) {
    if (p.gap.distance > gap + 1e-9) continue;
    const double r = rateAt(p);
    if (r < least) {
      least = r;
      fastest = p.gap.point;
    }
    most = std::max(most, r);
    sum += p.gap.point;
    ++n;
  }
  if (n == 0) return false;
  x = most - least <= 1e-9 * (1 + std::fabs(least)) ? Vec3(sum / n) : fastest;
  return true;
}

/// The time between `apart` and `sunk` at which the gap closes.
template <class GapAt>
double closingTime(double apart, double sunk, GapAt gapAt) {
  for (int i = 0; i < 60 && apart < sunk; ++i) {
    const double middle = 0.5 * (apart + sunk);
    if (!(middle > apart && middle < sunk)) break;
    (gapAt(middle) > 0 ? apart : sunk) = middle;
  }
  return sunk;
}

/// Looks until the pair touches. Should the certain steps be too short to come to an end, it goes on in even
/// ones: what is sunk then has touched since the look before. `place(tau)` moves both, `measure(level)` gives
/// their gap relative to the origin and, of a b that stands still, how far it reaches along the normal if
/// that is known anyway.
template <class Place, class Measure, class Patch>
std::optional<Touch> advance(Mover& a, Mover* b, double acceleration, double from, double to,
                             double tolerance, std::uint64_t& count, Place place, Measure measure,
                             Patch patch) {
  double tau = from, apart = from;
  int stalls = 0;
  std::vector<ManifoldPoint> points;
  const auto look = [&](double at, std::optional<double>& level) {
    ++count;
    place(at);
    return measure(level);
  };
  for (int i = 0; i < kMostLooks + 2 * kFallbackSteps; ++i) {
    std::optional<double> level;
    ConvexGap g = look(tau, level);
    if (i > kMostLooks && g.distance < -tolerance && apart < tau) {
      tau = closingTime(apart, tau, [&](double at) { return look(at, level).distance; });
      g = look(tau, level);
    }
    if (g.distance > 0) apart = tau;
    if (!std::isfinite(g.distance) || !g.normal.allFinite()) return {};
    const Lower f(a, level ? nullptr : b, g.normal, level.value_or(0), acceleration);
    double gap = g.distance;
    if (gap <= tolerance) {
      if (closingRate(f) < 0) {
        Vec3 x = g.onB;
        if (!pointed(a.core, g.normal, kSupportTie)) {
          points.clear();
          patch(g, points);
          contactPoint(a, b, points, g.distance, x);
        }
        const double rate = g.normal.dot(a.velocityAt(x) - (b ? b->velocityAt(x) : Vec3(Vec3::Zero())));
        if (rate < 0 || ++stalls > 20) return Touch{tau, {g.distance, x, g.normal, false, -1}, false};
      }
      gap = 0;
    }
    const double left = to - tau;
    const double outside = sphereTime(f, left);
    if (outside >= left) return {};
    double step = safeTime(f, gap, left, outside);
    if (b && i >= kPatience && step < left) step = turningTime(a, *b, g, gap, acceleration, left, step);
    if (step >= left) return {};
    if (i >= kMostLooks) step = std::max(step, std::min(left, (to - from) / kFallbackSteps));
    tau += std::max(step, gap > 0 ? 1e-16 : 1e-9);
    if (!(tau <= to)) return {};
  }
  return {};
}

void toWorld(std::optional<Touch>& t, const Vec3& origin) {
  if (t) t->gap.point += origin;
}

Pose shifted(const Pose& X, const Vec3& origin) {
  return {X.p - origin, X.q};
}

/// Searches for the first touch of a convex body with a face of a mesh.
class FaceSearch {
public:
  FaceSearch(const Side& body, const Side& mesh, double from, double to, std::uint64_t& count)
      : body_(body), meshSide_(mesh), mesh_(std::get<MeshShape>(*mesh.shape)), from_(from), to_(to),
        count_(count), origin_(placeOf(body, from)), a_(body, from, to), b_(mesh, from, to),
        bend_(relativeAcceleration(body, mesh, from, to, (origin_ - mesh.at(from).p).norm())),
        tolerance_(touchTolerance(origin_)) {}

  std::optional<Touch> first() {
    const int pieces = pieceCount();
    for (int piece = 0; piece < pieces && !best_; ++piece)
      searchPiece(from_ + (to_ - from_) * piece / pieces,
                  piece + 1 == pieces ? to_ : from_ + (to_ - from_) * (piece + 1) / pieces);
    toWorld(best_, origin_);
    return best_;
  }

private:
  /// Returns where the body is at tau, in the coordinates of the mesh.
  Vec3 placeInMesh(double tau) const { return meshSide_.at(tau).pose.inverse() * placeOf(body_, tau); }

  /// The path is searched in pieces about as long as the body, so that few triangles are near at a time.
  int pieceCount() const {
    const double way =
        (placeInMesh(to_) - placeInMesh(from_)).norm() + bend_ * (to_ - from_) * (to_ - from_) / 8;
    return static_cast<int>(std::clamp(way / (2 * a_.reach), 1.0, 64.0));
  }

  /// Returns a box around what the body sweeps, in the coordinates of the mesh.
  Aabb sweptBox(double begin, double end) const {
    Aabb box;
    box.include(placeInMesh(begin));
    box.include(placeInMesh(end));
    const double margin = a_.reach + bend_ * (end - begin) * (end - begin) / 8 + 1e-9;
    box.lo.array() -= margin;
    box.hi.array() += margin;
    return box;
  }

  void searchPiece(double begin, double end) {
    double until = end;
    mesh_.tree.eachOverlapping(sweptBox(begin, end), [&](std::uint32_t i) {
      auto t = touchOf(i, begin, until);
      if (!t || (best_ && t->tau >= best_->tau)) return;
      t->gap.triangle = static_cast<std::int32_t>(i);
      best_ = t;
      until = t->tau;
    });
  }

  std::optional<Touch> touchOf(std::uint32_t face, double begin, double until) {
    placed_ = false;
    return advance(
        a_, &b_, a_.acceleration + b_.acceleration, begin, until, tolerance_, count_,
        [&](double tau) { place(face, tau); },
        [&](std::optional<double>& level) { return gapTo(face, level); },
        [&](const ConvexGap& g, std::vector<ManifoldPoint>& points) {
          convexManifold(a_.core, b_.core, g, g.distance + 1e-9, 0, points);
        });
  }

  /// Moves body and face to tau.
  void place(std::uint32_t face, double tau) {
    coreOf(*body_.shape, a_.moveTo(tau, origin_), a_.core);
    if (placed_ && meshSide_.still()) return;
    b_.core = coreOf(mesh_.tree.triangles()[face], b_.moveTo(tau, origin_));
    if (!placed_) guess_ = a_.core.middle() - b_.core.middle();
    placed_ = true;
  }

  ConvexGap gapTo(std::uint32_t face, std::optional<double>& level) {
    ConvexGap g;
    if (gapOverFace(a_.core, b_.core, kFaceOnlyBeyond * a_.reach, g) && g.distance > 1e-6) {
      if (meshSide_.still()) level = g.normal.dot(g.onB);
      return g;
    }
    g = convexGap(a_.core, b_.core, guess_, kGapAccuracy);
    guess_ = g.normal;
    if (g.distance < 1e-6) meshNormal(a_.core, b_.core, mesh_.tree, face, g);
    return g;
  }

  const Side& body_;
  const Side& meshSide_;
  const MeshShape& mesh_;
  const double from_, to_;
  std::uint64_t& count_;
  const Vec3 origin_;
  Mover a_, b_;        ///< the body, and a face of the mesh
  const double bend_;  ///< bound on the acceleration of the body in the mesh [m/s2]
  const double tolerance_;
  Vec3 guess_ = Vec3::UnitZ();  ///< direction in which the present face is likely to be nearest
  bool placed_ = false;         ///< the present face has been placed
  std::optional<Touch> best_;
};

}  // namespace

std::optional<Touch> convexTouch(const Side& sa, const Side& sb, double from, double to,
                                 std::uint64_t& count) {
  const Vec3 origin = placeOf(sa, from);
  Mover a(sa, from, to), b(sb, from, to);
  Vec3 guess = Vec3::UnitZ();
  bool first = true;
  auto t = advance(
      a, &b, a.acceleration + b.acceleration, from, to, touchTolerance(origin), count,
      [&](double tau) {
        coreOf(*sa.shape, a.moveTo(tau, origin), a.core);
        if (!first && sb.still()) return;
        coreOf(*sb.shape, b.moveTo(tau, origin), b.core);
        if (first) guess = a.core.middle() - b.core.middle();
        first = false;
      },
      [&](std::optional<double>& level) {
        ConvexGap g;
        if (gapOverFace(a.core, b.core, kFaceOnlyBeyond * a.reach, g)) {
          if (sb.still()) level = g.normal.dot(g.onB);
          return g;
        }
        g = convexGap(a.core, b.core, guess, kGapAccuracy);
        guess = g.normal;
        return g;
      },
      [&](const ConvexGap& g, std::vector<ManifoldPoint>& points) {
        convexManifold(a.core, b.core, g, g.distance + 1e-9, 0, points);
      });
  toWorld(t, origin);
  return t;
}

std::optional<Touch> planeTouch(const Side& sa, const Side& plane, double from, double to,
                                std::uint64_t& count) {
  const auto& shape = std::get<PlaneShape>(*plane.shape);
  const Vec3 origin = placeOf(sa, from);
  Mover a(sa, from, to);
  double bound = a.acceleration;
  if (!plane.still()) {
    bound = relativeAcceleration(sa, plane, from, to, (origin - plane.at(from).p).norm());
    a.drift = bound;
    a.turning = true;
  }
  Pose X;
  auto t = advance(
      a, nullptr, bound, from, to, touchTolerance(origin), count,
      [&](double tau) {
        const Kinematics o = plane.at(tau);
        coreOf(*sa.shape, a.moveTo(tau, origin), a.core);
        a.v -= o.velocityAt(a.p + origin);
        a.omega -= o.omega;
        X = shifted(o.pose * shape.pose, origin);
      },
      [&](std::optional<double>& level) {
        ConvexGap g;
        g.normal = X.q * Vec3::UnitZ();
        level = g.normal.dot(X.p);
        g.distance = -a.core.extent(-g.normal) - *level;
        g.onA = g.onB = a.core.support(-g.normal) - a.core.radius * g.normal;
        return g;
      },
      [&](const ConvexGap& g, std::vector<ManifoldPoint>& points) {
        planeManifold(a.core, g.normal, g.normal.dot(X.p), g.distance + 1e-9, points);
      });
  if (t) t->gap.face = true;
  toWorld(t, origin);
  return t;
}

std::optional<Touch> meshTouch(const Side& sa, const Side& sm, double from, double to, std::uint64_t& count) {
  return FaceSearch(sa, sm, from, to, count).first();
}

Gap convexGapBetween(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB) {
  ConvexCore ca, cb;
  coreOf(a, shifted(X_WA, X_WB.p), ca);
  coreOf(b, shifted(X_WB, X_WB.p), cb);
  const ConvexGap g = convexGap(ca, cb, ca.middle() - cb.middle());
  return {g.distance, g.onB + X_WB.p, g.normal, false, -1};
}

Gap planeGapBetween(const Shape& a, const Pose& X_WA, const PlaneShape& plane, const Pose& X_WP) {
  const Pose X = X_WP * plane.pose;
  ConvexCore c;
  coreOf(a, shifted(X_WA, X.p), c);
  const Vec3 n = X.q * Vec3::UnitZ(), low = c.support(-n) - c.radius * n;
  return {n.dot(low), low + X.p, n, true, -1};
}

Gap meshGapBetween(const Shape& a, const Pose& X_WA, const MeshShape& mesh, const Pose& X_WM, double limit) {
  ConvexCore c;
  const Pose X = X_WM.inverse() * X_WA;
  coreOf(a, X, c);
  const Vec3 middle = c.middle();
  const Sphere s = boundingSphere(a);
  const double reach = (X * s.centre - middle).norm() + s.radius;
  Gap best;
  mesh.tree.eachWithin(
      middle, [&] { return std::min(limit, std::max(best.distance, 0.0)) + reach; },
      [&](std::uint32_t i) {
        const Triangle& t = mesh.tree.triangles()[i];
        const ConvexCore face = coreOf(t, Pose{});
        ConvexGap g = convexGap(c, face, middle - face.middle());
        if (g.distance < 0) meshNormal(c, face, mesh.tree, i, g);
        if (g.distance < best.distance)
          best = {g.distance, g.onB, g.normal, false, static_cast<std::int32_t>(i)};
      });
  best.point = X_WM * best.point;
  best.normal = X_WM.q * best.normal;
  return best;
}

}  // namespace stadion
