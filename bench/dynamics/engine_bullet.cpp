/// Bullet in double precision (libbullet-dev): default solver, and `tuned`: split impulse at every depth, 30
/// iterations, the ground a box.

#include "bench/dynamics/engine.h"

#include <BulletCollision/CollisionDispatch/btInternalEdgeUtility.h>
#include <algorithm>
#include <btBulletDynamicsCommon.h>

namespace stadion::bench {
namespace {

btScalar largerRestitution(const btCollisionObject* a, const btCollisionObject* b) {
  return btMax(a->getRestitution(), b->getRestitution());
}

btScalar geometricFriction(const btCollisionObject* a, const btCollisionObject* b) {
  return btSqrt(a->getFriction() * b->getFriction());
}

/// Balls do not trip over the edges inside a mesh.
bool smoothEdges(btManifoldPoint& point, const btCollisionObjectWrapper* a, int partA, int indexA,
                 const btCollisionObjectWrapper* b, int partB, int indexB) {
  if (b->getCollisionShape()->getShapeType() == TRIANGLE_SHAPE_PROXYTYPE)
    btAdjustInternalEdgeContacts(point, b, a, partB, indexB);
  else if (a->getCollisionShape()->getShapeType() == TRIANGLE_SHAPE_PROXYTYPE)
    btAdjustInternalEdgeContacts(point, a, b, partA, indexA);
  return true;
}

btVector3 theirs(V3 a) {
  return {a.x, a.y, a.z};
}
V3 ours(const btVector3& a) {
  return {a.x(), a.y(), a.z()};
}

/// A fixed or moving rigid body's properties.
struct Matter {
  double mass = 0;
  V3 inertia, p;
  Q4 q;
  double restitution = 0, friction = 0;
};

class BulletEngine final : public Engine {
public:
  explicit BulletEngine(bool tuned) : tuned_(tuned) {}

  ~BulletEngine() override {
    for (int i = world_.getNumCollisionObjects() - 1; i >= 0; --i)
      world_.removeCollisionObject(world_.getCollisionObjectArray()[i]);
  }

  void create(const WorldSpec& world) override {
    world_.setGravity(theirs(world.gravity));
    btContactSolverInfo& solver = world_.getSolverInfo();
    solver.m_restitutionVelocityThreshold = 0;
    solver.m_numIterations = tuned_ ? 30 : 10;
    if (tuned_) {
      solver.m_splitImpulse = 1;
      solver.m_splitImpulsePenetrationThreshold = 1e10;
    }
    gCalculateCombinedRestitutionCallback = largerRestitution;
    gCalculateCombinedFrictionCallback = geometricFriction;
    gContactAddedCallback = smoothEdges;
  }

  int addBody(const BodySpec& b) override {
    Matter matter{b.mass, b.inertia(), b.p, b.q, b.restitution, b.friction};
    if (b.fixed) {
      matter.mass = 0;
      matter.inertia = {};
    }
    btRigidBody* body = add(shapeOf(b), matter);
    if (b.fixed) return -1;
    body->setLinearVelocity(theirs(b.v));
    body->setAngularVelocity(theirs(b.omega));
    if (b.continuous) {
      const double inner = b.form == Form::Sphere ? b.half.x : std::min(b.half.x, b.half.y);
      body->setCcdMotionThreshold(inner * 0.5);
      body->setCcdSweptSphereRadius(inner * 0.9);
    }
    bodies_.push_back(body);
    return static_cast<int>(bodies_.size()) - 1;
  }

  void addGround(double restitution, double friction) override {
    const V3 under{0, tuned_ ? -5. : 0., 0};
    const Matter matter{0, {}, under, {}, restitution, friction};
    if (tuned_)
      add(own(std::make_unique<btBoxShape>(btVector3(100, 5, 100))), matter);
    else
      add(own(std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), 0)), matter);
  }

  bool addMesh(const MeshSpec& mesh) override {
    triangles_ = std::make_unique<btTriangleMesh>();
    const auto corner = [&mesh](int i) { return theirs(mesh.points[static_cast<std::size_t>(i)]); };
    for (const auto& t : mesh.triangles) triangles_->addTriangle(corner(t[0]), corner(t[1]), corner(t[2]));
    auto shape = std::make_unique<btBvhTriangleMeshShape>(triangles_.get(), true);
    edges_ = std::make_unique<btTriangleInfoMap>();
    btGenerateInternalEdgeInfo(shape.get(), edges_.get());
    btRigidBody* body = add(own(std::move(shape)), {0, {}, {}, {}, mesh.restitution, mesh.friction});
    body->setCollisionFlags(body->getCollisionFlags() | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
    return true;
  }

  State state(int i) override {
    const btRigidBody& b = at(i);
    const btTransform& t = b.getWorldTransform();
    const btQuaternion q = t.getRotation();
    return {ours(t.getOrigin()),
            ours(b.getLinearVelocity()),
            ours(b.getAngularVelocity()),
            {q.w(), q.x(), q.y(), q.z()}};
  }

  void force(int i, V3 newtons) override { at(i).applyCentralForce(theirs(newtons)); }
  void step(double h) override { world_.stepSimulation(h, 0); }

private:
  btRigidBody& at(int i) { return *bodies_[static_cast<std::size_t>(i)]; }

  btCollisionShape* own(std::unique_ptr<btCollisionShape> shape) {
    shapes_.push_back(std::move(shape));
    return shapes_.back().get();
  }

  btCollisionShape* shapeOf(const BodySpec& b) {
    if (b.form == Form::Sphere) return own(std::make_unique<btSphereShape>(b.half.x));
    if (b.form == Form::Box) return own(std::make_unique<btBoxShape>(theirs(b.half)));
    return own(std::make_unique<btCylinderShape>(btVector3(b.half.x, b.half.y, b.half.x)));
  }

  btRigidBody* add(btCollisionShape* shape, const Matter& m) {
    btRigidBody::btRigidBodyConstructionInfo info(m.mass, nullptr, shape, theirs(m.inertia));
    info.m_startWorldTransform = btTransform(btQuaternion(m.q.x, m.q.y, m.q.z, m.q.w), theirs(m.p));
    info.m_restitution = m.restitution;
    info.m_friction = m.friction;
    info.m_linearDamping = info.m_angularDamping = 0;
    owned_.push_back(std::make_unique<btRigidBody>(info));
    owned_.back()->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(owned_.back().get());
    return owned_.back().get();
  }

  bool tuned_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadPhase_;
  btSequentialImpulseConstraintSolver solver_;
  std::unique_ptr<btTriangleMesh> triangles_;
  std::unique_ptr<btTriangleInfoMap> edges_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> owned_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadPhase_, &solver_, &configuration_};
  std::vector<btRigidBody*> bodies_;  ///< those that move
};

}  // namespace

std::vector<std::string> engineVariants() {
  return {"bullet64", "bullet64-tuned"};
}

std::unique_ptr<Engine> makeEngine(const std::string& variant) {
  return std::make_unique<BulletEngine>(variant.ends_with("tuned"));
}

}  // namespace stadion::bench
