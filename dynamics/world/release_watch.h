#pragma once
/// Watches pairs whose impact has been reported until they part, and reports the release at its exact time.
///
/// Threads  one at a time, as the world that it belongs to (world.h).

#include "dynamics/state/body_traces.h"
#include "dynamics/state/contact_events.h"
#include "dynamics/state/world_objects.h"
#include "dynamics/state/world_time.h"

#include <optional>

namespace stadion {

/// The first moment in [from, to] at which two sides are farther apart than `far`; nothing if there is none.
/// Expects that each side follows one arc meanwhile.
std::optional<double> firstBeyond(const Side& a, const Side& b, double far, double from, double to);

class ReleaseWatch {
public:
  ReleaseWatch(const WorldTime& time, const WorldObjects& objects, ContactMemory& memory, BodyTraces& traces)
      : time_(time), objects_(objects), memory_(memory), traces_(traces) {}

  /// An impact at tau has been resolved: decides when the pair must be looked at first.
  void foreseeRelease(ContactMemory::Waiting& w, double tau, std::int32_t triangle);
  /// The pair meets again at tau: reports a release before that.
  void releaseBefore(const ContactMemory::Key& pair, double tau);
  /// An impulse acts on the body at tau.
  void expectPartings(RigidBody& b, double tau) { traces_.expectPartings(b, tau); }
  /// Reports the releases of this part of the frame.
  void reportReleases();
  /// A jump of `p` makes all its pairs due.
  void forgetSlack(ContactSide p);

private:
  void release(const ContactMemory::Key& pair, Nanoseconds time);
  void awaitRelease(ContactMemory::Waiting& w, const Side& a, const Side& b, double distance,
                    double tau) const;
  bool noPartNearer(const ContactMemory::Waiting& w, const Side& a, const Side& b) const;
  std::optional<Nanoseconds> whenParted(const ContactMemory::Waiting& w, double tau) const;
  double wayLength(const Side& s, double from, double tau) const;
  void passSkippedFrames(ContactMemory::Waiting& w) const;
  bool stillNear(ContactMemory::Waiting& w, double tau) const;

  const WorldTime& time_;
  const WorldObjects& objects_;
  ContactMemory& memory_;
  BodyTraces& traces_;
};

}  // namespace stadion
