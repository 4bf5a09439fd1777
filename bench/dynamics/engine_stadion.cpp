/// Stadion's own world behind the cases' interface.
///
/// Frames   the cases have y up, Stadion has z up: (x, y, z) there is (x, -z, y) here, for places,
///          directions, the bodies' own axes and the vector part of quaternions. A rotation, so nothing is
///          mirrored.
/// Time     Stadion's clock counts nanoseconds and a sixtieth of a second is no whole number of them. The
///          world advances to the nearest one; what is read is carried on (or back) for the remaining half
///          nanosecond at most by the velocity, which leaves an error below 1e-17 m.

#include "bench/dynamics/engine.h"
#include "dynamics/world/world.h"

#include <algorithm>
#include <limits>

namespace stadion::bench {
namespace {

Vec3 zUp(V3 a) {
  return {a.x, -a.z, a.y};
}
V3 yUp(const Vec3& a) {
  return {a.x(), a.z(), -a.y()};
}
Quat zUp(Q4 q) {
  return {q.w, q.x, -q.z, q.y};
}
Q4 yUp(const Quat& q) {
  return {q.w(), q.x(), q.z(), -q.y()};
}
/// Extents and moments have no sign.
Vec3 zUpSize(V3 a) {
  return {a.x, a.z, a.y};
}

/// Turned by omega for a time so short that nothing beyond the first order is left.
Q4 turned(Q4 q, V3 omega, double seconds) {
  const V3 half = (0.5 * seconds) * omega;
  return Q4{1, half.x, half.y, half.z} * q;
}

/// The variants of the contact scheme: "stadion", and "stadion-paper-TOLERANCE" with the tolerance in metres.
struct EngineVariant {
  const char* name;
  ImpactScheme impacts;
};

constexpr EngineVariant kVariants[] = {{"stadion", {}},
                                       {"stadion-paper-1e-3", {ImpactScheme::Kind::Paper, 1e-3}},
                                       {"stadion-paper-1e-5", {ImpactScheme::Kind::Paper, 1e-5}},
                                       {"stadion-paper-1e-7", {ImpactScheme::Kind::Paper, 1e-7}}};

class StadionEngine final : public Engine {
public:
  explicit StadionEngine(const ImpactScheme& impacts) { world_.setImpactScheme(impacts); }

  void create(const WorldSpec& world) override {
    spec_ = world;
    if (norm(world.gravity) == 0) return;
    ForceField gravity;
    gravity.law = LinearField{zUp(world.gravity), LinearField::Unit::Acceleration};
    gravity_ = world_.addField(gravity, true);
  }

  int addBody(const BodySpec& b) override {
    const Surface surface{b.friction, b.restitution, 0.0};
    const ShapeId shape = addShape(b);
    if (b.fixed) {
      world_.addCollider({shape, {zUp(b.p), zUp(b.q)}, surface});
      return -1;
    }
    stadion::BodyDef def;
    def.shape = shape;
    def.pose = {zUp(b.p), zUp(b.q)};
    def.v = zUp(b.v);
    def.omega = zUp(b.omega);
    def.mass.mass = b.mass;
    def.mass.inertia = zUpSize(b.inertia());
    def.surface = surface;
    def.dragArea = 2 * b.mass;
    def.releaseDistance = std::numeric_limits<double>::infinity();  // nor do the others watch for that
    const BodyId id = world_.addBody(def);
    if (gravity_) world_.hook(id, gravity_, 0);
    bodies_.push_back({id, b.inertia()});
    return static_cast<int>(bodies_.size()) - 1;
  }

  void addGround(double restitution, double friction) override {
    world_.addCollider({world_.addShape(PlaneShape{}), {}, {friction, restitution, 0.0}});
  }

  bool addMesh(const MeshSpec& spec) override {
    Mesh mesh;
    for (const V3& point : spec.points) {
      const Vec3 p = zUp(point);
      mesh.positions.push_back(
          {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
    }
    for (const auto& t : spec.triangles)
      for (const int corner : t) mesh.indices.push_back(static_cast<std::uint32_t>(corner));
    world_.addCollider(
        {world_.addShape(MeshShape(TriangleTree(mesh))), {}, {spec.friction, spec.restitution, 0.0}});
    return true;
  }

  State state(int body) override {
    const Member& b = bodies_[static_cast<std::size_t>(body)];
    const BodyState s = world_.state(b.id);
    const double rest = static_cast<double>(elapsed_ - 1e-9L * static_cast<long double>(now_));
    State r{yUp(s.p), yUp(s.v), yUp(s.omega), yUp(s.pose.q)};
    r.p = r.p + rest * r.v;
    r.q = turned(r.q, r.omega, rest);
    if (s.mode != BodyMode::Flight) return r;
    // Nothing touches it: what its velocities do in the meantime is known.
    r.v = r.v + rest * (spec_.gravity - (b.drag * norm(r.v)) * r.v);
    const V3 L = rotate(conj(r.q), yUp(s.L));
    r.omega = rotate(r.q, {L.x / b.inertia.x, L.y / b.inertia.y, L.z / b.inertia.z});
    return r;
  }

  void force(int body, V3 newtons) override {
    Member& b = bodies_[static_cast<std::size_t>(body)];
    b.force = b.force + newtons;
    pushed_ = true;
  }

  /// A medium of density k around bodies whose drag area is twice their mass: k = rho A / 2 m.
  bool quadraticDrag(int body, double k) override {
    if (!medium_) {
      ForceField air;
      air.law = MediumField{.density = k};
      medium_ = world_.addField(air, true);
      density_ = k;
    }
    Member& b = bodies_[static_cast<std::size_t>(body)];
    b.drag = k;
    return k == density_ && world_.hook(b.id, medium_, 0);
  }

  void step(double h) override {
    if (pushed_) push(h);
    elapsed_ += h;
    const auto end = static_cast<Nanoseconds>(elapsed_ * 1e9L + 0.5L);
    world_.advance(now_, end);
    now_ = end;
  }

private:
  struct Member {
    BodyId id;
    V3 inertia;
    V3 force{};  ///< for the coming step
    double drag = 0;
  };

  ShapeId addShape(const BodySpec& b) {
    if (b.form == Form::Box) return world_.addShape(BoxShape{{}, zUpSize(b.half)});
    if (b.form == Form::Cylinder) return world_.addShape(CylinderShape{{}, b.half.x, b.half.y});
    return world_.addShape(BallShape{Vec3::Zero(), b.half.x});
  }

  void push(double h) {
    for (Member& b : bodies_) {
      if (b.force.x == 0 && b.force.y == 0 && b.force.z == 0) continue;
      world_.push(b.id, zUp(h * b.force), world_.state(b.id).p);
      b.force = {};
    }
    pushed_ = false;
  }

  World world_;
  WorldSpec spec_;
  FieldId gravity_ = 0, medium_ = 0;
  double density_ = 0;
  std::vector<Member> bodies_;
  bool pushed_ = false;
  long double elapsed_ = 0;  ///< [s]
  Nanoseconds now_ = 0;
};

}  // namespace

std::vector<std::string> engineVariants() {
  std::vector<std::string> names;
  for (const EngineVariant& r : kVariants) names.emplace_back(r.name);
  return names;
}

std::unique_ptr<Engine> makeEngine(const std::string& variant) {
  return std::make_unique<StadionEngine>(
      std::ranges::find(kVariants, variant, &EngineVariant::name)->impacts);
}

}  // namespace stadion::bench
