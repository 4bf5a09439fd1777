#pragma once
/// One step of a small island: a closed-form glide, or the exact contact solver (contact/contact_solver.h).
///
/// Threads  one at a time, as the world that it belongs to (world.h).

#include "dynamics/contact/contact_area.h"
#include "dynamics/contact/contact_solver.h"
#include "dynamics/world/contact_finder.h"
#include "dynamics/world/release_watch.h"
#include "dynamics/world/waking.h"

#include <vector>

namespace stadion {

inline constexpr double kIslandSlop = 1e-5;  ///< overlap that an island leaves alone [m]

/// Two flat faces on each other. The points that carry them leave friction to their area.
struct FlatPatch {
  SolverContact contact;
  FlatContact flat;
  std::uint64_t key = 0;
  std::vector<std::size_t> points;  ///< indices of contacts
  std::vector<Vec3> places;         ///< their places on the side that carries the area

  /// Arms and a basis in which the area does not turn, if its sides lie like this.
  void place(const SolverBody& a, const SolverBody& b, const Mat3& turnA, const Mat3& turnB, const Vec3& pA,
             const Vec3& pB, Mat3& basis, Vec3& armA, Vec3& armB) const;
};

/// Bodies that lean on each other, by id, and what they lean on.
struct ContactIsland {
  std::vector<RigidBody*> set;
  std::vector<FoundContact> found;
  std::vector<FlatPatch> flats;
  std::vector<SolverBody> start, end;  ///< sides of the contacts: the bodies of `set`, then the fixed sides
  std::vector<ContactSide> fixed;      ///< the sides that no contact moves
  std::vector<Vec3> pull;              ///< by body of `set`: acceleration by fields in this step [m/s2]
  std::vector<SolverBody> free;        ///< `end` as it would be without contacts
  bool carried = false;                ///< one of the fixed sides moves
  bool wedged = false;                 ///< no velocities suit all: contacts with external motion yield
  std::vector<ContactSide> way;        ///< pieces of a surface that a glide comes to
  bool glides = false;                 ///< the step is a glide in closed form
};

class IslandStep {
public:
  IslandStep(const WorldTime& time, const WorldObjects& objects, const FieldSet& fields,
             ContactMemory& memory, ReleaseWatch& releases, BodyArcs& arcs, FlushSurfaces& surfaces,
             Waking& waking, ContactFinder& finder)
      : time_(time), objects_(objects), fields_(fields), memory_(memory), releases_(releases), arcs_(arcs),
        surfaces_(surfaces), waking_(waking), finder_(finder) {}

  /// Advances the island by h seconds from tau, or by less if its motion asks for it.
  void advance(ContactIsland& island, double tau, double h);

private:
  static constexpr double kForGood = 1e300;  ///< a glide without end [s]

  void begin(ContactIsland& island, double tau) const;
  void findFlats(ContactIsland& island, double tau) const;
  std::vector<Side> surfaceUnder(const FoundContact& f) const;
  bool isDriven(ContactSide p) const;
  bool solveIsland(ContactIsland& island, std::vector<SolverBody>& solverBodies,
                   std::vector<SolverContact>& contacts, Effort effort) const;
  void stopApproaches(ContactIsland& island, double tau);
  void recordImpacts(const ContactIsland& island, const std::vector<SolverContact>& hits,
                     const std::vector<std::int32_t>& hitOf, const std::vector<double>& closing, double tau);
  bool solveStep(ContactIsland& island, double tau, double h, Effort effort) const;
  void moveFreely(ContactIsland& island, const std::vector<SolverBody>& guess, double tau, double h,
                  bool first) const;
  double glide(ContactIsland& island, double tau, double h);
  double glideOf(const ContactIsland& island, double probe, std::vector<ContactSide>& way);
  double glideAt(const ContactIsland& island, const FoundContact& f, double probe, double most,
                 std::vector<ContactSide>& way);
  double stepOf(const ContactIsland& island, double tau, double h) const;
  double untilNextCorner(const ContactIsland& island, double tau, double h) const;
  void holdRims(ContactIsland& island, const std::vector<SolverBody>& solved) const;
  void conclude(ContactIsland& island, double tau, double h);
  void concludeFreely(RigidBody& b, const SolverBody& start, double tau);
  void noteQuiet(RigidBody& b, const SolverBody& start, const SolverBody& end, double tau, double h) const;
  bool settleOnFace(RigidBody& b, const FoundContact& only, double tau);
  bool isMesh(ContactSide p) const;

  const WorldTime& time_;
  const WorldObjects& objects_;
  const FieldSet& fields_;
  ContactMemory& memory_;
  ReleaseWatch& releases_;
  BodyArcs& arcs_;
  FlushSurfaces& surfaces_;
  Waking& waking_;
  ContactFinder& finder_;
};

}  // namespace stadion
