#include "pipeline/loop/head_latch.h"

#include "engine/maths/functions.h"

#include <algorithm>

namespace stadion {

using std::chrono::nanoseconds;

void HeadLatch::latch(const WallViews& wall, TimePoint seen, DrawList& list) {
  if (wall.camera || list.viewCount == 0) return;
  const Taken taken = take(list, seen);
  if (!taken.X_RH) return;
  list.viewer.set(list.viewer.rig(), *taken.X_RH);
  list.ticket.posed = taken.measured;
  const Presentation& shown = list.ticket.presentation;
  PlacedViews placed = place(list.viewer, wall, {shown.eyeSeparation, shown.swapEyes});
  placed.origin = list.origin;  // what is in the list lies around it
  placed.setUp(list);
}

HeadLatch::Taken HeadLatch::take(const DrawList& list, TimePoint seen) {
  const std::lock_guard lock(mutex_);
  if (taken_.frame == list.ticket.began) return taken_;
  taken_ = {list.ticket.began, {}, {}};
  const TimePoint now = std::chrono::steady_clock::now();
  const auto head = input_.headSoon(std::max<Nanoseconds>(0, nanoseconds(seen - now).count()));
  if (!head || !head->X_RH.finite()) return taken_;
  const Pose sampled = list.viewer.head();
  const double way = (head->X_RH.p - sampled.p).norm();
  const double turn = det::logRotation(head->X_RH.q * sampled.q.conjugate()).norm();
  ++counts_.latched;
  if (way > reach_.metres || turn > reach_.radians) ++counts_.beyond;
  counts_.farthest = std::max(counts_.farthest, way);
  counts_.widest = std::max(counts_.widest, turn);
  taken_.X_RH = reach_.within(sampled, head->X_RH);
  taken_.measured = head->measured > 0 ? TimePoint(nanoseconds(head->measured)) : now;
  return taken_;
}

}  // namespace stadion
