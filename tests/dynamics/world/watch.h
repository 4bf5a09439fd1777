#pragma once
/// What must hold of every scene, however hard, looked at after each frame.

#include "tests/dynamics/world/scenes.h"

#include <random>
#include <utility>

namespace stadion::scenes {

/// Numbers in [-1, 1] and what is made of them; the same for the same seed.
struct Chance {
  std::mt19937 generator;
  explicit Chance(unsigned seed) : generator(seed) {}
  double signedUnit() { return 2 * static_cast<double>(generator()) / 4294967295.0 - 1; }
  double between(double lo, double hi) { return lo + (hi - lo) * 0.5 * (signedUnit() + 1); }
  /// Evenly on a logarithmic scale.
  double scale(double lo, double hi) { return lo * std::pow(hi / lo, 0.5 * (signedUnit() + 1)); }
  Vec3 vector() {
    const double x = signedUnit(), y = signedUnit();
    return {x, y, signedUnit()};
  }
  Vec3 direction() {
    Vec3 d = vector();
    while (!(d.squaredNorm() > 0.01)) d = vector();
    return d.normalized();
  }
  Quat turn() {
    const Vec3 d = direction();
    const double angle = between(0, M_PI);
    return Quat(Eigen::AngleAxisd(angle, d));
  }
};

/// Momenta and energy of bodies; angular momentum about a point.
struct Balance {
  Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
  double kinetic = 0, potential = 0;
  double energy() const { return kinetic + potential; }
};

inline Balance balanceOf(const World& w, const std::vector<BodyId>& bodies, const Vec3& gravity,
                         const Vec3& about = Vec3::Zero()) {
  Balance sum;
  for (const BodyId b : bodies) {
    const BodyState s = w.state(b);
    const double m = w.mass(b);
    sum.momentum += m * s.v;
    sum.angular += s.L + m * (s.p - about).cross(s.v);
    sum.kinetic += w.kineticEnergy(b);
    sum.potential -= m * gravity.dot(s.p - about);
  }
  return sum;
}

class Watch {
public:
  Watch(const World& world, std::vector<BodyId> bodies, const Vec3& gravity = Vec3(0, 0, -kG),
        const Vec3& about = Vec3::Zero())
      : world_(world), bodies_(std::move(bodies)), gravity_(gravity), about_(about) {
    first = last = balanceOf(world_, bodies_, gravity_, about_).energy();
  }

  void look() {
    for (const BodyId b : bodies_) {
      const BodyState s = world_.state(b);
      const bool sane = world_.pose(b).finite() && s.v.allFinite() && s.omega.allFinite() && s.L.allFinite();
      finite = finite && sane && s.mode != BodyMode::Quarantined;
      fastest = std::max(fastest, s.v.norm());
    }
    const double e = balanceOf(world_, bodies_, gravity_, about_).energy();
    greatestRise = std::max(greatestRise, e - last);
    greatestGain = std::max(greatestGain, e - first);
    last = e;
    const World::Counters& c = world_.counters();
    limited += c.limited;
    busiest = std::max(busiest, c.arcs + c.impacts + c.contactSteps);
  }
  bool asleep() const {
    return std::all_of(bodies_.begin(), bodies_.end(), [&](BodyId b) { return world_.state(b).asleep(); });
  }

  bool finite = true;          ///< no state was undefined, no body was put in quarantine
  double fastest = 0;          ///< [m/s]
  double first = 0, last = 0;  ///< energy at the start and now [J]
  double greatestRise = 0;     ///< of the energy from one frame to the next [J]
  double greatestGain = 0;     ///< of the energy over that at the start [J]
  std::uint64_t limited = 0;   ///< frames whose events did not end
  std::uint64_t busiest = 0;   ///< arcs, impacts and steps of the busiest frame

private:
  const World& world_;
  std::vector<BodyId> bodies_;
  Vec3 gravity_, about_;
};

/// Plays and looks after each frame.
inline void play(World& w, double seconds, Watch& watch, double rate = 60) {
  play(w, seconds, rate, [&](double) { watch.look(); });
}

/// Any solid, by what it is: for scenes that take them in turn.
enum class Solid { Ball, Box, Capsule, Cylinder, Convex, Mesh };
inline constexpr std::array kSolids{Solid::Ball,     Solid::Box,    Solid::Capsule,
                                    Solid::Cylinder, Solid::Convex, Solid::Mesh};

inline MassProperties massOfRound(double radius, double half, double mass) {
  MassProperties m;
  m.mass = mass;
  const double across = mass * (3 * radius * radius + 4 * half * half) / 12;
  m.inertia = {across, across, 0.5 * mass * radius * radius};
  return m;
}

/// About `size` from its middle to its surface.
inline BodyDef solidBody(World& w, Solid kind, double size, double mass) {
  BodyDef d;
  const Vec3 half = size * Vec3(1, 0.8, 0.6);
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back(half.x() * (i & 1 ? 1 : -1), half.y() * (i & 2 ? 1 : -1),
                         half.z() * (i & 4 ? 1 : -1));
  switch (kind) {
  case Solid::Ball:
    d.shape = w.addShape(BallShape{Vec3::Zero(), size});
    d.mass = massOfSphere(Vec3::Zero(), size, 1).withMass(mass);
    break;
  case Solid::Box:
    d.shape = w.addShape(BoxShape{{}, half}), d.mass = massOfBox({}, half, 1).withMass(mass);
    break;
  case Solid::Capsule:
    d.shape = w.addShape(CapsuleShape{{}, 0.5 * size, 0.5 * size});
    d.mass = massOfRound(0.5 * size, 0.8 * size, mass);
    break;
  case Solid::Cylinder:
    d.shape = w.addShape(CylinderShape{{}, size, 0.3 * size});
    d.mass = massOfRound(size, 0.3 * size, mass);
    break;
  case Solid::Convex:
    d.shape = w.addShape(*convexHull(corners)), d.mass = massOfBox({}, half, 1).withMass(mass);
    break;
  case Solid::Mesh:
    d.shape = w.addShape(MeshShape(TriangleTree(boxMesh(half))));
    d.mass = massOfBox({}, half, 1).withMass(mass);
    break;
  }
  return d;
}

inline BodyId addSolid(World& w, FieldId gravity, const BodyDef& d) {
  const BodyId id = w.addBody(d);
  if (gravity) w.hook(id, gravity, 0);
  return id;
}

inline const char* nameOf(Solid kind) {
  static constexpr std::array names{"ball", "box", "capsule", "cylinder", "convex", "mesh"};
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace stadion::scenes
