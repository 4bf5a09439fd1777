#pragma once
/// The inside of World, shared by its source files: world.cpp (interface), world_frame.cpp (one frame),
/// world_arcs.cpp (new arcs), world_impact.cpp (touches), world_contact.cpp (lasting contact).

#include "dynamics/ball_motion.h"
#include "dynamics/contact_events.h"
#include "dynamics/contact_solver.h"
#include "dynamics/rigid_body.h"
#include "dynamics/touch.h"
#include "dynamics/world.h"

#include <algorithm>
#include <map>
#include <queue>
#include <set>

namespace stadion {

class World::Core {
public:
  struct ShapeEntry {
    Shape shape;
    Sphere bound;
    std::uint32_t uses = 0;
  };
  struct FieldEntry {
    ForceField field;
    bool on = false;
    bool changed = false;  ///< its push may differ from the last frame's
    std::uint32_t activation = 0;
  };
  struct Command {
    enum class Kind : std::uint8_t { Switch, Expire, Hook, Unhook };
    Nanoseconds when = 0;
    std::uint64_t order = 0;
    Kind kind = Kind::Switch;
    FieldId field = 0;
    BodyId body = 0;
    bool on = false;
    std::uint32_t activation = 0;
  };
  struct Event {
    enum class Kind : std::uint8_t { Command, Touch, Horizon, Tick };
    double tau = 0;
    std::uint64_t order = 0;
    Kind kind = Kind::Touch;
    Party a, b;
    std::uint32_t versionA = 0, versionB = 0;
    std::uint32_t detail = 0;  ///< index into touches_, or the tick's number
    bool operator<(const Event& o) const {
      return tau != o.tau ? tau > o.tau : order > o.order;
    }  // a min-heap
  };

  // --- state
  std::map<ShapeId, ShapeEntry> shapes;
  std::map<BodyId, RigidBody> bodies;
  std::map<ColliderId, Collider> colliders;
  std::map<FieldId, FieldEntry> fields;
  std::vector<BodyId> bodyIds;
  std::set<std::pair<Party, Party>> ignored;
  std::vector<Command> commands;  ///< in the order of (when, order)
  ContactMemory memory;
  Nanoseconds t0 = 0, t1 = 0;
  double length = 0;  ///< of the frame [s]
  bool started = false, bodiesCollide = true;
  bool foresee = false;  ///< predictions are wanted: only while events run
  std::uint64_t nextOrder = 0, frame = 0;
  std::uint32_t nextShape = 1, nextBody = 1, nextCollider = 1, nextField = 1;
  Counters counters;
  mutable std::vector<PairState> pairList;

  // --- one frame (world_frame.cpp)
  void standStill();  ///< between frames: changes take effect at the end of the last one
  void advance(Nanoseconds from, Nanoseconds to, bool continues);
  void beginFrame();
  std::vector<Party> arrivals() const;
  void settleFresh();
  void wakeWithin(Party arrived);
  void runEvents();
  void endFrame();
  void partCarried();
  static bool bothCarried(const Side& a, const Side& b);
  void reportReleases();
  void insert(Command c);
  void execute(const Command& c, double tau);
  void predict(RigidBody& b, double tau, bool onlyGreater = false);
  void predictPair(const Side& a, const Side& b, double tau);
  void pushHorizon(const RigidBody& b);
  bool mayTouch(const Side& a, const Side& b) const;
  std::uint32_t versionOf(Party p) const;
  Nanoseconds timeAt(double tau) const;

  // --- arcs (world_arcs.cpp)
  Vec3 accelerationAt(const RigidBody& b, const Vec3& p, const Vec3& v, double tau) const;
  bool uniformFor(const RigidBody& b) const;
  void setArc(RigidBody& b, double tau, const Path& path, const Spin& spin, double horizon, BodyMode mode);
  void startFlight(RigidBody& b, double tau, const Vec3& p, const Vec3& v, const Quat& q, const Vec3& L);
  void startOnFace(RigidBody& b, double tau, const BallStart& s, bool gripped, bool stopped);
  void restart(RigidBody& b, double tau);
  void freeze(RigidBody& b, double tau);
  void quarantine(RigidBody& b, double tau, std::string why);
  void reachHorizon(RigidBody& b, double tau);
  bool crossEdge(RigidBody& b, double tau);

  // --- touches (world_impact.cpp)
  void onTouch(const Touch& touch, Party a, Party b, double tau);
  bool supportFor(const RigidBody& ball, const Collider& c, const Gap& gap, double tau, Support& out) const;
  void afterImpulse(RigidBody& b, const Mobile& m, double tau, bool lasting);

  // --- lasting contact (world_contact.cpp)
  struct Found {
    SolverContact contact;
    Party a, b;
    PairSurface surface;
    Gap gap;
    std::uint64_t key = 0;
  };
  void enterContact(RigidBody& b, double tau);
  void wake(RigidBody& b, double tau);
  void wakeOnto(Party gone, double tau);
  void scheduleTick(double tau);
  void tick(double tau);
  void findContacts(RigidBody& b, double tau, std::vector<Found>& found, double reachTime);
  bool solveTick(std::vector<RigidBody*>& set, std::vector<Found>& found, double tau, double h);
  void concludeTick(RigidBody& b, const Mobile& before, const Mobile& after, bool touches, double tau,
                    double h);
  std::map<std::uint64_t, std::pair<double, Vec3>> warm;  ///< impulses of the last step by contact
  std::uint32_t tickNumber = 0;
  double tickAt = -1;  ///< [s] tau of the scheduled one

  RigidBody* body(BodyId id) {
    const auto at = bodies.find(id);
    return at == bodies.end() ? nullptr : &at->second;
  }
  const RigidBody* body(BodyId id) const {
    const auto at = bodies.find(id);
    return at == bodies.end() ? nullptr : &at->second;
  }
  Collider* collider(ColliderId id) {
    const auto at = colliders.find(id);
    return at == colliders.end() ? nullptr : &at->second;
  }
  std::optional<Side> side(Party p) const {
    if (p.isBody) {
      const auto at = bodies.find(p.id);
      return at == bodies.end() || !at->second.enabled ? std::nullopt : std::optional(Side::of(at->second));
    }
    const auto at = colliders.find(p.id);
    return at == colliders.end() || !at->second.enabled ? std::nullopt : std::optional(Side::of(at->second));
  }
  const Surface& surfaceOf(Party p) const {
    return p.isBody ? bodies.at(p.id).surface : colliders.at(p.id).surface;
  }

private:
  /// Bodies by the low x of their swept boxes at the start of the frame (sort and sweep); those that left
  /// theirs apart.
  struct Filed {
    double low;
    RigidBody* body;
  };
  std::vector<Filed> order_;
  std::vector<RigidBody*> strayed_;
  double widest_ = 0;
  void fileBodies();
  /// Calls f for every body whose swept box overlaps `box`, in a fixed order.
  template <class F>
  void eachNear(const Aabb& box, F f) {
    const auto before = [](const Filed& a, double x) { return a.low < x; };
    for (auto i = std::lower_bound(order_.begin(), order_.end(), box.lo.x() - widest_, before);
         i != order_.end() && i->low <= box.hi.x(); ++i)
      if (!i->body->strayed && i->body->swept.overlaps(box)) f(*i->body);
    for (RigidBody* b : strayed_)
      if (b->swept.overlaps(box)) f(*b);
  }

  std::priority_queue<Event> queue_;
  std::vector<Touch> touches_;
  void post(Event e) {
    e.order = nextOrder++;
    queue_.push(e);
  }
};

}  // namespace stadion
