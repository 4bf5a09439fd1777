#include "dynamics/nodes/grips.h"

#include "engine/core/state_fields.h"
#include "engine/scene/scene.h"

#include <algorithm>

namespace stadion {

const Grip* Grips::grab(BodyId body, NodeRef node, const std::string& tracker, PoseTrack way,
                        Nanoseconds when) {
  if (!world_.holdBody(body)) return nullptr;
  const Pose X_WT = poseOn(way, when, Limit::After);
  Grip& grip = grips_.emplace_back();
  grip.body = body;
  grip.node = node;
  grip.tracker = tracker;
  grip.X_TN = X_WT.inverse() * world_.pose(body);
  grip.hand.put(when, X_WT);
  grip.track = std::move(way);
  return &grip;
}

std::optional<Grip> Grips::open(BodyId body) {
  const auto at = std::ranges::find(grips_, body, &Grip::body);
  if (at == grips_.end()) return std::nullopt;
  std::optional<Grip> opened = std::move(*at);
  grips_.erase(at);
  return opened;
}

void Grips::forget(BodyId body) {
  std::erase_if(grips_, [body](const Grip& g) { return g.body == body; });
}

void Grips::follow(FrameContext& frame, std::vector<Nanoseconds>& cuts) {
  for (Grip& grip : grips_) {
    const PoseTrack* way = frame.scene.feed().poseTrackOf(grip.tracker, frame);
    grip.track = way ? *way : PoseTrack{};
    for (const PoseKnot& k : grip.track) cuts.push_back(k.time);
  }
}

void Grips::jump(Nanoseconds time) {
  for (Grip& grip : grips_) {
    if (!jumpsAt(grip.track, time)) continue;
    const Pose X_WT = poseOn(grip.track, time, Limit::After);
    world_.moveHeld(grip.body, X_WT * grip.X_TN, true);
    grip.hand.put(time, X_WT);
    grip.jumped = time;
  }
}

void Grips::move(Nanoseconds from, Nanoseconds to, bool jump) {
  for (Grip& grip : grips_) {
    if (grip.silentBefore(to) || from == to) continue;
    const Pose X_WT = poseOn(grip.track, to, Limit::Before);
    world_.moveHeld(grip.body, X_WT * grip.X_TN, jump);
    grip.hand.go(to, X_WT);
  }
}

void Grips::hash(StateHash& h) const {
  for (const Grip& g : grips_) {
    h.add(g.body);
    h.add(std::string_view(g.tracker));
    h.add(g.X_TN);
    for (const PoseKnot& k : g.hand.way()) {
      h.add(k.time);
      h.add(k.X);
    }
    h.add(world_.accumulatedVelocity(g.body));
  }
}

void Grips::state(StateFields& f) {
  f("grips", grips_);
}

}  // namespace stadion
