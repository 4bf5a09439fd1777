#include "dynamics/state/support_graph.h"

#include <algorithm>

namespace stadion {

bool leansOn(const RigidBody& b, ContactSide p) {
  return (b.support.on.id && b.support.on == p) ||
         std::find(b.contact.touching.begin(), b.contact.touching.end(), p) != b.contact.touching.end();
}

void SupportGraph::note(const RigidBody& b) {
  if (b.support.on.id) leaners_.emplace(b.support.on, b.id);
  for (const ContactSide p : b.contact.touching) leaners_.emplace(p, b.id);
  if (leaners_.size() <= pruneAt_) return;
  std::erase_if(leaners_, [&](const auto& l) {
    const RigidBody* leaner = objects_.body(l.second);
    return !leaner || !leansOn(*leaner, l.first);
  });
  pruneAt_ = 64 + 2 * leaners_.size();
}

bool SupportGraph::bears(ContactSide p) const {
  const auto first = leaners_.lower_bound({p, 0});
  return first != leaners_.end() && first->first == p;
}

void SupportGraph::leanersOf(ContactSide p, std::vector<BodyId>& out) const {
  for (auto at = leaners_.lower_bound({p, 0}); at != leaners_.end() && at->first == p; ++at)
    out.push_back(at->second);
}

void SupportGraph::forgetBody(BodyId id) {
  leaners_.erase(leaners_.lower_bound({{true, id}, 0}), leaners_.lower_bound({{true, id + 1}, 0}));
}

}  // namespace stadion
