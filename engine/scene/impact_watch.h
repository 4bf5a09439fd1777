#pragma once
/// The impacts of this frame, and the nodes that wait for those of a body.
///
/// Ownership  borrows the schedule.
/// Threads    App only.
/// Errors     none.

#include "engine/core/state_fields.h"
#include "engine/scene/impact.h"
#include "engine/scene/node_schedule.h"

#include <algorithm>
#include <map>
#include <vector>

namespace stadion {

class ImpactWatch {
public:
  explicit ImpactWatch(NodeSchedule& schedule) : schedule_(schedule) {}

  /// Wakes `watcher` in the frame in which `body` touches something or comes to its end.
  void watch(NodeRef body, NodeRef watcher) { watchers_.insert({body, watcher}); }
  void unwatch(NodeRef body, NodeRef watcher) {
    const auto [first, last] = watchers_.equal_range(body);
    const auto at = std::find_if(first, last, [&](const auto& w) { return w.second == watcher; });
    if (at != last) watchers_.erase(at);
  }
  /// Returns true if an impact may be of interest in this frame. If not, dynamics need not note any.
  bool wanted() const { return !watchers_.empty() || mayBegin_; }
  void note(const Impact& impact) {
    bool watched = false;
    for (const NodeRef body : {impact.body, impact.other}) {
      const auto [first, last] = watchers_.equal_range(body);
      for (auto w = first; w != last; ++w) schedule_.wakeNow(w->second);
      watched |= first != last;
    }
    if (watched || mayBegin_) impacts_.push_back(impact);
  }
  /// The impacts of this frame, in the order in which they were noted.
  const std::vector<Impact>& impacts() const { return impacts_; }

  // For the scene.

  void beginFrame() { impacts_.clear(); }
  /// Says whether a node may begin to watch in this frame.
  void setMayBegin(bool may) { mayBegin_ = may; }
  void state(StateFields& f) { f("impact watchers", watchers_); }

private:
  NodeSchedule& schedule_;
  std::multimap<NodeRef, NodeRef> watchers_;  ///< by the body that is watched
  bool mayBegin_ = false;
  std::vector<Impact> impacts_;
};

}  // namespace stadion
