/// ODE in double precision (libode-dev): its iterative solver (QuickStep, 20 iterations) and its direct one.

#include "bench/dynamics/engine.h"

#include <algorithm>
#include <deque>
#include <ode/ode.h>

namespace stadion::bench {
namespace {

struct ContactProperties {
  double restitution, friction;
};

/// The library's own state, set up once in a process.
void startLibrary() {
  static const bool once = dInitODE2(0) != 0;
  static_cast<void>(once);
  dAllocateODEDataForThread(dAllocateMaskAll);
}

class OdeEngine final : public Engine {
public:
  explicit OdeEngine(bool quick) : quick_(quick) {
    startLibrary();
    world_ = dWorldCreate();
    space_ = dHashSpaceCreate(nullptr);
    contacts_ = dJointGroupCreate(0);
  }

  ~OdeEngine() override {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }

  void create(const WorldSpec& world) override {
    dWorldSetGravity(world_, world.gravity.x, world.gravity.y, world.gravity.z);
    dWorldSetAutoDisableFlag(world_, 0);
    dWorldSetQuickStepNumIterations(world_, 20);
    dWorldSetMaxAngularSpeed(world_, dInfinity);
    dWorldSetContactSurfaceLayer(world_, 1e-4);
  }

  int addBody(const BodySpec& b) override {
    const dGeomID geometry = geometryOf(b);
    setMaterial(geometry, b.restitution, b.friction);
    const dQuaternion q{b.q.w, b.q.x, b.q.y, b.q.z};
    if (b.fixed) {
      dGeomSetPosition(geometry, b.p.x, b.p.y, b.p.z);
      dGeomSetQuaternion(geometry, q);
      return -1;
    }
    const dBodyID body = dBodyCreate(world_);
    const V3 inertia = b.inertia();
    dMass mass;
    dMassSetParameters(&mass, b.mass, 0, 0, 0, inertia.x, inertia.y, inertia.z, 0, 0, 0);
    dBodySetMass(body, &mass);
    dBodySetPosition(body, b.p.x, b.p.y, b.p.z);
    dBodySetQuaternion(body, q);
    dBodySetLinearVel(body, b.v.x, b.v.y, b.v.z);
    dBodySetAngularVel(body, b.omega.x, b.omega.y, b.omega.z);
    dGeomSetBody(geometry, body);
    if (b.form == Form::Cylinder) {  // the library's cylinders stand along z
      const dQuaternion upright{std::sqrt(0.5), -std::sqrt(0.5), 0, 0};
      dGeomSetOffsetQuaternion(geometry, upright);
    }
    bodies_.push_back(body);
    return static_cast<int>(bodies_.size()) - 1;
  }

  void addGround(double restitution, double friction) override {
    setMaterial(dCreatePlane(space_, 0, 1, 0, 0), restitution, friction);
  }

  bool addMesh(const MeshSpec& mesh) override {
    std::vector<double>& points = points_.emplace_back();
    std::vector<dTriIndex>& corners = corners_.emplace_back();
    for (const V3& p : mesh.points) points.insert(points.end(), {p.x, p.y, p.z});
    for (const auto& t : mesh.triangles)
      for (const int corner : t) corners.push_back(static_cast<dTriIndex>(corner));
    const dTriMeshDataID data = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(data, points.data(), 3 * sizeof(double), static_cast<int>(mesh.points.size()),
                                corners.data(), static_cast<int>(corners.size()), 3 * sizeof(dTriIndex));
    setMaterial(dCreateTriMesh(space_, data, nullptr, nullptr, nullptr), mesh.restitution, mesh.friction);
    return true;
  }

  State state(int i) override {
    const dReal* p = dBodyGetPosition(at(i));
    const dReal* v = dBodyGetLinearVel(at(i));
    const dReal* w = dBodyGetAngularVel(at(i));
    const dReal* q = dBodyGetQuaternion(at(i));
    return {{p[0], p[1], p[2]}, {v[0], v[1], v[2]}, {w[0], w[1], w[2]}, {q[0], q[1], q[2], q[3]}};
  }

  void force(int i, V3 newtons) override { dBodyAddForce(at(i), newtons.x, newtons.y, newtons.z); }

  void step(double h) override {
    dSpaceCollide(space_, this, collide);
    if (quick_)
      dWorldQuickStep(world_, h);
    else
      dWorldStep(world_, h);
    dJointGroupEmpty(contacts_);
  }

private:
  dBodyID at(int i) const { return bodies_[static_cast<std::size_t>(i)]; }

  dGeomID geometryOf(const BodySpec& b) {
    if (b.form == Form::Sphere) return dCreateSphere(space_, b.half.x);
    if (b.form == Form::Box) return dCreateBox(space_, 2 * b.half.x, 2 * b.half.y, 2 * b.half.z);
    return dCreateCylinder(space_, b.half.x, 2 * b.half.y);
  }

  void setMaterial(dGeomID geometry, double restitution, double friction) {
    dGeomSetData(geometry, &materials_.emplace_back(ContactProperties{restitution, friction}));
  }

  static void collide(void* self, dGeomID a, dGeomID b) { static_cast<OdeEngine*>(self)->collide(a, b); }

  void collide(dGeomID a, dGeomID b) {
    const dBodyID bodyA = dGeomGetBody(a), bodyB = dGeomGetBody(b);
    if (!bodyA && !bodyB) return;
    constexpr int kMost = 16;
    dContact found[kMost];
    const int n = dCollide(a, b, kMost, &found[0].geom, sizeof(dContact));
    const auto& one = *static_cast<const ContactProperties*>(dGeomGetData(a));
    const auto& other = *static_cast<const ContactProperties*>(dGeomGetData(b));
    const double e = std::max(one.restitution, other.restitution);
    for (int i = 0; i < n; ++i) {
      dSurfaceParameters& surface = found[i].surface;
      surface.mode = dContactApprox1 | (e > 0 ? dContactBounce : 0);
      surface.mu = std::sqrt(one.friction * other.friction);
      surface.bounce = e;
      surface.bounce_vel = 0;
      dJointAttach(dJointCreateContact(world_, contacts_, &found[i]), bodyA, bodyB);
    }
  }

  bool quick_;
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID contacts_;
  std::vector<dBodyID> bodies_;
  std::deque<ContactProperties> materials_;  // what the library points into must not move
  std::deque<std::vector<double>> points_;
  std::deque<std::vector<dTriIndex>> corners_;
};

}  // namespace

std::vector<std::string> engineVariants() {
  return {"ode-quick", "ode-lcp"};
}

std::unique_ptr<Engine> makeEngine(const std::string& variant) {
  return std::make_unique<OdeEngine>(variant == "ode-quick");
}

}  // namespace stadion::bench
