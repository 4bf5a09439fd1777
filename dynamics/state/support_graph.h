#pragma once
/// Which bodies lean on what, so that a body wakes when its support changes.

#include "dynamics/state/world_objects.h"

#include <set>
#include <utility>
#include <vector>

namespace stadion {

/// Returns true if the body slides, rolls or rests on `p`, or touches it in lasting contact.
bool leansOn(const RigidBody& b, ContactSide p);

class SupportGraph {
public:
  explicit SupportGraph(const WorldObjects& objects) : objects_(objects) {}

  /// Notes what the body leans on. Entries may be out of date, but none is missing.
  void note(const RigidBody& b);
  bool bears(ContactSide p) const;
  /// Appends the bodies that may lean on p, by id.
  void leanersOf(ContactSide p, std::vector<BodyId>& out) const;
  void drop(ContactSide p, BodyId leaner) { leaners_.erase({p, leaner}); }
  void forgetBody(BodyId id);

  template <class Fields>
  void state(Fields& f) {
    f("leaners", leaners_), f("leaners to prune", pruneAt_);
  }

private:
  const WorldObjects& objects_;
  std::set<std::pair<ContactSide, BodyId>> leaners_;
  std::size_t pruneAt_ = 64;  ///< number of entries at which those out of date are removed
};

}  // namespace stadion
