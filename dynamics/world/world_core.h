#pragma once
/// The inside of World, shared by its source files: world.cpp (interface), world_frame.cpp (one frame),
/// world_foresight.cpp (what will touch), world_arcs.cpp (new arcs), world_impact.cpp (touches),
/// world_air.cpp (flight in air), world_release.cpp (who has parted),
/// world_way_out.cpp (out of what a hand has put a body into), world_seams.cpp (surfaces of several pieces),
/// world_contact.cpp (lasting contact: who with whom), world_island.cpp (one island), world_crowd.cpp and
/// world_crowd_contacts.cpp (heaps).
///
/// Time     runs in windows of 128 ms to 1 s on a grid of show time. tau is seconds since the window's start.
/// What will happen is foreseen to the window's end, once for each arc; a frame only lets happen what is due
/// and looks where everybody is. What moves from outside is known to the end of the frame only.

#include "dynamics/body/ball_motion.h"
#include "dynamics/body/id_table.h"
#include "dynamics/body/rigid_body.h"
#include "dynamics/collision/broad_phase.h"
#include "dynamics/collision/manifold.h"
#include "dynamics/collision/touch.h"
#include "dynamics/collision/touch_seams.h"
#include "dynamics/contact/contact_area.h"
#include "dynamics/contact/contact_solver.h"
#include "dynamics/contact/patch_impact.h"
#include "dynamics/contact/way_out.h"
#include "dynamics/motion/coupled_step.h"
#include "dynamics/state/body_traces.h"
#include "dynamics/state/event_queue.h"
#include "dynamics/state/field_commands.h"
#include "dynamics/state/step_grid.h"
#include "dynamics/state/support_graph.h"
#include "dynamics/state/swept_boxes.h"
#include "dynamics/world/world.h"

#include <algorithm>
#include <deque>
#include <map>
#include <queue>
#include <set>

namespace stadion {

constexpr double kDue = 1e-9;  ///< times as near as this are the same [s]

/// Names a contact point of a pair.
inline std::uint64_t pairKey(Party a, Party b, std::uint32_t feature) {
  std::uint64_t h = 1469598103934665603ULL;
  for (const std::uint64_t x : {std::uint64_t{a.isBody}, std::uint64_t{a.id}, std::uint64_t{b.isBody},
                                std::uint64_t{b.id}, std::uint64_t{feature}})
    h = (h ^ x) * 1099511628211ULL;
  return h;
}

class World::Core {
public:
  // --- state
  std::vector<BodyId> comingOut;  ///< bodies with ways out, in the order in which they were let go
  WorldTime time_;
  StepGrid grid_;
  EventQueue queue_;
  WorldObjects objects_;
  FieldSet fields_{time_};
  ContactMemory memory_;
  ActiveBodies active_;
  ChangedMotions changes_;
  SweptBoxes boxes_{time_, objects_};
  SupportGraph supports_{objects_};
  BodyTraces traces_{time_, objects_, memory_};
  HeldBodies held_{time_, objects_, fields_, memory_};
  FieldCommands commands_{time_, queue_, objects_, fields_, held_};
  bool jerking = false;  ///< a body has come whose bias turns it once a frame
  Counters counters;

  // --- one frame (world_frame.cpp)
  void start(Nanoseconds at);
  void forgetBody(RigidBody& b);
  void newFrame();
  void advance(Nanoseconds from, Nanoseconds to, bool continues);
  void pause(Nanoseconds to, bool continues);
  void beginFrame();
  void restartStirred(double tau);
  std::vector<Party> arrivals() const;
  void settleFresh(const std::vector<Party>& arrived);
  void settle(RigidBody& b, const std::vector<std::pair<Side, Gap>>& touching);
  void wakeWithin(Party arrived);
  void runEvents(double until);
  void fetchNext() const;
  void expel(RigidBody& b);
  void sample(RigidBody& b);
  void endFrame();
  bool putBody(RigidBody& b, const Pose& X_WN, const Vec3& v, const Vec3& omega);

  // --- what will touch (world_foresight.cpp)
  struct Looks {
    std::size_t looks = 0, colliders = 0, bodies = 0;  ///< and how much was near
  };
  Looks looks;  ///< in this window
  Nanoseconds nextWindow() const;
  bool solidsMayMeet() const;
  void beginWindow(Nanoseconds at);
  void openWindow(Nanoseconds at);
  void foreseeMarked(double tau);
  void lookAhead(RigidBody& b, double tau, bool onlyGreater);
  void lookAtOnly(RigidBody& b, double tau);
  void predict(RigidBody& b, double tau, bool onlyGreater = false);
  void awaitHorizon(RigidBody& b);
  void flyOnLazily(RigidBody& b);
  /// From now on its arc is the one that it follows at tau.
  void catchUp(RigidBody& b, double tau) {
    while (b.lazy && b.until <= tau) flyOnLazily(b);
  }
  void comeNear(RigidBody& b, double tau);
  template <class F>
  void eachBodyNear(const Aabb& box, double tau, F f) {
    boxes_.eachBody(box, [&](RigidBody& o) { catchUp(o, tau), f(o); });
  }
  void predictPair(const Side& a, const Side& b, double tau);
  void pushHorizon(const RigidBody& b);
  void pushTurn(Party p, const GuidedMotion& motion, double tau);
  void turn(RigidBody& b, double tau);
  void turn(Collider& c, double tau);
  double knownUntil(const Side& s) const;

  // --- arcs (world_arcs.cpp)
  double restLasts(const RigidBody& b, const BallStart& s, double tau) const;
  void setArc(RigidBody& b, double tau, const Path& path, const Spin& spin, double horizon, BodyMode mode);
  void setPath(RigidBody& b, double tau, const Path& path, double horizon, BodyMode mode);
  void fly(RigidBody& b, double tau, const Vec3& p, const Vec3& v);
  bool resist(RigidBody& b, double tau, const Vec3& p, const Vec3& v);
  void continueFlight(RigidBody& b, double tau, const Vec3& p, const Vec3& v, bool pullsAsBefore);
  void startFlight(RigidBody& b, double tau, const Vec3& p, const Vec3& v, const Quat& q, const Vec3& L);
  BallArc arcOnFace(const RigidBody& b, double tau, const BallStart& s, bool gripped, bool stopped) const;
  void startOnFace(RigidBody& b, double tau, const BallStart& s, bool gripped, bool stopped);
  void restart(RigidBody& b, double tau);
  void freeze(RigidBody& b, double tau);
  void quarantine(RigidBody& b, double tau, std::string why);
  bool flyOn(RigidBody& b, double tau);
  void reachHorizon(RigidBody& b, double tau);
  bool crossEdge(RigidBody& b, double tau, double& lift);
  bool crossFold(RigidBody& b, double tau) const;

  // --- flight in air (world_air.cpp)
  bool flyInAir(RigidBody& b, double tau, const CoupledState& s);
  Spin spinFrom(const RigidBody& b, double tau, const CoupledState& s) const;
  void turnByFrame();
  void setSpin(RigidBody& b, double tau, const Spin& spin);

  // --- surfaces of several pieces (world_seams.cpp)
  /// A collider that a body touches, or comes to, without a contact of its own.
  struct Beside {
    BodyId body = 0;
    Party piece;
    bool touches = false;
    auto operator<=>(const Beside&) const = default;
  };
  std::vector<Beside> beside;  ///< in this tick, by body
  std::span<const Beside> besideOf(BodyId id) const;
  template <class F>
  void eachColliderAt(const RigidBody& b, double tau, F f) const;
  std::vector<Bearing> bearingsOf(const RigidBody& b, double tau, const Collider& but) const;
  bool isHiddenTouch(const Side& a, const Side& b, const Touch& touch) const;
  std::optional<Touch> firstRealTouch(const Side& a, const Side& b, double from, double to);
  bool crossSeam(RigidBody& b, double tau, double& lift);
  std::vector<PatchSide> struckBeside(const RigidBody& b, const Collider& but, double tau, bool ends) const;

  // --- touches (world_impact.cpp)
  void countImpact(RigidBody& b, double tau) const;
  void onTouch(const Touch& touch, Party a, Party b, double tau);
  bool sticksIn(const RigidBody& b, const Vec3& x, const Vec3& n, double closing, double tau) const;
  void stick(RigidBody& b, Party in, const Vec3& v, double tau);
  static bool carries(const RigidBody& ball, const Collider& c, const Gap& gap);
  bool supportFor(const RigidBody& ball, const Collider& c, const Gap& gap, Support& out) const;
  void strikeInCrowd(RigidBody& b, const Mobile& m, double tau);
  void afterImpulse(RigidBody& b, const Mobile& m, double tau, bool lasting);

  // --- who has parted (world_release.cpp)
  static constexpr double kCarriedApart =
      1e-5;  ///< what is moved from outside touches while it is nearer [m]
  std::optional<double> firstBeyond(const Side& a, const Side& b, double far, double from, double to) const;
  void reportReleases();
  bool nobodyNearer(const ContactMemory::Waiting& w, const Side& a, const Side& b) const;
  void foreseeRelease(ContactMemory::Waiting& w, double tau, std::int32_t triangle);
  std::optional<Nanoseconds> whenParted(const ContactMemory::Waiting& w, double tau) const;
  double wayLength(const Side& s, double from, double tau) const;
  bool stillNear(ContactMemory::Waiting& w, double tau) const;
  void forgetSlack(Party p);
  void release(const ContactMemory::Key& pair, Nanoseconds time);
  void releaseBefore(const ContactMemory::Key& pair, double tau);
  void awaitRelease(ContactMemory::Waiting& w, const Side& a, const Side& b, double distance,
                    double tau) const;
  Nanoseconds soonest(const Side& a, const Side& b, double distance, double tau) const;

  // --- out of what a hand has put a body into (world_way_out.cpp)
  void noteFreePlaces();
  void findWaysOut(RigidBody& b);
  void forgetWaysOut(RigidBody& b, double tau) const;
  static bool comesOutOf(const RigidBody& b, ColliderId id);

  // --- lasting contact (world_contact.cpp)
  struct Found {
    SolverContact contact;
    Party a, b;
    PairSurface surface;
    Gap gap;
    std::uint64_t key = 0;
    Carrier carrier = Carrier::None;
    Rounding rounding;
  };
  /// Two flat faces on each other; points that carry them leave friction to their area.
  struct FoundFlat {
    SolverContact contact;
    FlatContact flat;
    std::uint64_t key = 0;
    std::vector<std::size_t> points;  ///< among those found
    std::vector<Vec3> places;         ///< where those are on the side that carries it

    /// Arms and a basis, in which the area does not turn, when its sides lie like this.
    void place(const Mobile& a, const Mobile& b, const Mat3& turnA, const Mat3& turnB, const Vec3& pA,
               const Vec3& pB, Mat3& basis, Vec3& armA, Vec3& armB) const;
  };
  /// Bodies that lean on each other, by id, and what they lean on.
  struct Island {
    std::vector<RigidBody*> set;
    std::vector<Found> found;
    std::vector<FoundFlat> flats;
    std::vector<Mobile> start, end;  ///< the set's, then those of the parties that nothing moves
    std::vector<Party> fixed;        ///< the latter
    std::vector<Vec3> pull;          ///< on the set in this step [m/s2]
    std::vector<Mobile> free;        ///< what `end` would be without contacts
    bool carried = false;            ///< one of them moves
    bool wedged = false;             ///< no velocities suit all: what moves from outside gives way
    std::vector<Party> way;          ///< pieces that a glide comes to
    bool glides = false;             ///< in closed form: it stops when it stops, however slow
  };
  void enterContact(RigidBody& b, double tau);
  void wake(RigidBody& b, double tau);
  void wakeOnto(Party gone, double tau);
  void hurry(RigidBody& b, double tau);
  void cutStep(RigidBody& b, double tau);
  void scheduleDue(double tau);
  void tick(double tau);
  std::size_t thickness(const RigidBody& b, double tau);
  bool isCrowd(const std::vector<RigidBody*>& island, double tau);
  static bool isSlender(const std::vector<RigidBody*>& island, const std::vector<Found>& found);
  void findContacts(RigidBody& b, double tau, std::vector<Found>& found, std::vector<RigidBody*>& set);
  void chooseWayOut(const RigidBody& b, std::size_t first, std::vector<Found>& found) const;
  void dropHidden(const RigidBody& b, double tau, std::size_t first, std::vector<Found>& found);
  void joinFlush(const RigidBody& b, std::size_t first, std::vector<Found>& found);
  double timeCarried(const RigidBody& b, const Found& f, const Vec3& u, const Vec3& a, double most,
                     std::vector<Party>& way) const;
  bool wakeTouched(const std::vector<Found>& found, double tau);
  void remember(RigidBody& b, const std::vector<Party>& near);
  // --- many bodies in one heap (world_crowd.cpp)
  static constexpr std::size_t kMostInLine = 64;   ///< towers of more are a crowd, too
  static constexpr std::size_t kCrowd = 16;        ///< islands with so many bodies become one
  static constexpr std::size_t kRestless = 5;      ///< the same if they are not solved exactly
  static constexpr std::size_t kCrowdOfBalls = 5;  ///< the same if they are balls
  struct CrowdStep;
  double untilCrowdStep(double tau) const;
  void advanceCrowd(double tau);
  void dissolveCrowd(const std::vector<RigidBody*>& due, double tau);
  void joinCrowd(RigidBody& b, CrowdStep& step);
  static std::vector<char> calmInCrowd(const CrowdStep& step);
  bool noteNeighbours(const CrowdStep& step, std::size_t i, std::span<const std::uint32_t> list,
                      std::vector<Party>& near);
  void followCrowd(const CrowdStep& step, std::size_t i);
  void concludeCrowd(CrowdStep& step);
  // (world_crowd_contacts.cpp)
  void addCrowdContact(const RigidBody& b, Party other, const Surface& surface, const Gap& gap,
                       std::uint32_t feature, CrowdStep& step);
  void findCrowdColliders(const RigidBody& b, const Aabb& box, double margin, CrowdStep& step);
  void meetInCrowd(RigidBody& b, RigidBody& o, double margin, CrowdStep& step);
  void findCrowdContacts(RigidBody& b, CrowdStep& step);
  std::vector<Vec3> placesOfFriction(const CrowdStep& step) const;
  void linkCrowdContacts(CrowdStep& step);
  // --- one island (world_island.cpp)
  void advanceIsland(Island& island, double tau, double h);
  void begin(Island& island, double tau) const;
  bool isDriven(Party p) const;
  bool solveIsland(Island& island, std::vector<Mobile>& mobiles, std::vector<SolverContact>& contacts,
                   Effort effort) const;
  std::vector<Side> surfaceUnder(const Found& f) const;
  void findFlats(Island& island, double tau) const;
  void stopApproaches(Island& island) const;
  static double pushOutOf(const std::vector<Found>& found, std::size_t i);
  static bool staysWedged(const Island& island);
  bool solveStep(Island& island, double tau, double h, Effort effort) const;
  double glide(Island& island, double tau, double h);
  double stepOf(const Island& island, double tau, double h) const;
  static void boundStep(Island& island, double h);
  void resistRolling(Island& island) const;
  void holdRims(Island& island, const std::vector<Mobile>& solved) const;
  void conclude(Island& island, double tau, double h);
  void concludeFreely(RigidBody& b, const Mobile& start, double tau);
  void noteQuiet(RigidBody& b, const Mobile& start, const Mobile& end, double tau, double h) const;
  bool inFold(const RigidBody& b, const Collider& c, const Support& face, double tau) const;
  bool settleOnFace(RigidBody& b, const Found& only, double tau);

  std::vector<BodyId> changed_;  ///< bodies that have been active in this frame

  // --- the state (world_state.cpp)
  void visit(StateFields& f);
};

}  // namespace stadion
