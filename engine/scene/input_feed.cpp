#include "engine/scene/input_feed.h"

#include "engine/core/state_fields.h"
#include "engine/input/tracker_names.h"

#include <algorithm>

namespace stadion {

Pose InputFeed::rigPose() const {
  if (rigs_.empty()) return freeRig_;
  return poseOf(placements_.world(rigs_.back().placement));  // scale has no meaning for the rig
}

Pose InputFeed::headInRig(const InputSample& input) const {
  const TrackerSample* head = input.find(kHeadTracker);
  if (head && head->valid) return head->X_RT;
  return {Vec3(0, 0, rigs_.empty() ? 1.7 : rigs_.back().eyeHeight), Quat::Identity()};
}

const PoseTrack* InputFeed::poseTrackOf(const std::string& tracker, const FrameContext& frame) {
  const TrackerSample* t = frame.input.find(tracker);
  if (!t || !t->valid) return nullptr;
  // The frame is the scene's: poses from before it are not kept, however long a node's own step is.
  const Nanoseconds start = time_.start, end = frame.now.time;
  PoseTrack& track = tracker_;
  track.clear();
  // Only the tracker can jump: how the rig has moved is known.
  const auto add = [&](Nanoseconds time, const Pose& X_RT, bool jump) {
    track.push_back(
        {time, X_RT, jump || track.empty() || teleported(track.back().X, X_RT, time - track.back().time)});
  };
  if (const TrackerSample* was = lastInput_.find(tracker); was && was->valid && start < end) {
    add(start, was->X_RT, false);
    track.front().jump = false;
  }
  for (const PoseKnot& k : t->knots)
    if (k.X.finite() && k.time >= (track.empty() ? start : track.back().time) && k.time <= end)
      add(k.time, k.X, k.jump);
  if (track.empty() || track.back().time < end) add(end, t->X_RT, false);
  toWorld(track, start, end);
  return &track;
}

/// Converts a pose track from the rig's coordinates to World, while the rig itself may move.
void InputFeed::toWorld(PoseTrack& track, Nanoseconds start, Nanoseconds end) {
  const Pose X_WR = rigPose();
  PoseTrack &rig = rigTrack_, &ridden = ridden_;
  rig.clear();
  ridden.clear();
  if (!rigs_.empty()) {
    rig = poseTracks_.within(rigs_.back().placement, rigStart_, start, end, placements_);
  } else if (X_WR.p != rigStart_.p || X_WR.q.coeffs() != rigStart_.q.coeffs()) {
    rig.push_back({start, rigStart_, false});
    rig.push_back({end, X_WR, false});
  }
  if (rig.empty()) {
    for (PoseKnot& k : track) k.X = X_WR * k.X;
    return;
  }
  const Nanoseconds known = track.front().time;
  const auto add = [&](Nanoseconds time, const Pose& X_RT, bool jump) {
    const bool arrived = time == end && (jump || !rig.back().jump);
    const Pose X = arrived ? rig.back().X : poseOn(rig, time, jump ? Limit::After : Limit::Before);
    ridden.push_back({time, X * X_RT, jump});
  };
  std::size_t next = 0;
  for (const PoseKnot& k : track) {
    for (; next < rig.size() && rig[next].time < k.time; ++next)
      if (rig[next].time > known)
        add(rig[next].time, poseOn(track, rig[next].time, Limit::Before), rig[next].jump);
    add(k.time, k.X, k.jump || jumpsAt(rig, k.time));
    while (next < rig.size() && rig[next].time == k.time) ++next;
  }
  track.swap(ridden);
}

void InputFeed::stateOfRigs(StateFields& f) {
  f("rigs", rigs_), f("rig", freeRig_);
}

void InputFeed::stateOfInput(StateFields& f) {
  f("last input", lastInput_);
}

bool InputFeed::consistent() const {
  for (const Rig& r : rigs_)
    if (!placements_.has(r.placement)) return false;
  for (const TrackerSample& t : lastInput_.trackers)
    if (!t.X_RT.finite() || !std::ranges::all_of(t.knots, &Pose::finite, &PoseKnot::X)) return false;
  return true;
}

}  // namespace stadion
