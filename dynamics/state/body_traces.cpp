#include "dynamics/state/body_traces.h"

#include <algorithm>
#include <utility>

namespace stadion {

/// Notes the body's way from now on, for others or for its own partings, or no longer.
void BodyTraces::trace(RigidBody& b, bool traced, bool awaited, double tau) {
  const bool before = b.trace.traced || b.trace.awaited;
  b.trace.traced = traced;
  b.trace.awaited = awaited;
  if (before == (traced || awaited)) return;
  b.trace.arcs.clear();
  if (before) {
    std::erase(list_, &b);
  } else {
    list_.push_back(&b);
    note(b, tau);
  }
}

/// When the frame began the body stood or was slow, so that nothing noted its way.
void BodyTraces::expectPartings(RigidBody& b, double tau) {
  if (b.trace.awaited || memory_.waiting().empty()) return;
  bool waits = false;
  memory_.eachWith({true, b.id},
                   [&](const ContactMemory::Key& pair) { waits = waits || memory_.waitingOf(pair); });
  if (waits) trace(b, b.trace.traced, true, tau);
}

void BodyTraces::addPart(RigidBody& b, ArcPiece part) {
  part.jump = std::exchange(b.trace.put, false);
  // What lasts for no time is no part of a way.
  if (!b.trace.arcs.empty() && !(b.trace.arcs.back().from < part.from)) {
    part.from = b.trace.arcs.back().from;
    part.jump = part.jump || b.trace.arcs.back().jump;
    b.trace.arcs.back() = part;
  } else {
    b.trace.arcs.push_back(part);
  }
}

/// The body follows the arc that it has now from tau on.
void BodyTraces::note(RigidBody& b, double tau) {
  if (!b.trace.traced && !b.trace.awaited) return;
  if (b.mode == BodyMode::Held) return noteHeld(b, tau);
  ArcPiece part;
  part.from = time_.instantAt(tau);
  part.pathAge = b.age(tau);
  part.spinAge = b.spinAge(tau);
  part.path = b.path;
  part.spin = b.spin;
  part.X_CN = b.X_CN;
  addPart(b, part);
}

/// The way of a held body from tau on, in this part of a frame.
void BodyTraces::noteHeld(RigidBody& b, double tau) {
  if (!b.trace.traced && !b.trace.awaited) return;
  if (!b.grip.held.guided()) {
    const Kinematics k = b.grip.held.at(tau);
    return addPart(b, ArcPiece::straight(time_.instantAt(tau), k.pose, k.v, k.omega));
  }
  for (std::size_t i = b.grip.held.partAfter(tau);
       i < b.grip.held.arcs.size() && b.grip.held.arcs[i].tau < time_.partEnd(); ++i) {
    ArcPiece part = b.grip.held.arcs[i];
    const double early = tau - part.tau;
    if (early > 0) {
      part.from = time_.instantAt(tau);
      part.pathAge += early;
      part.spinAge += early;
    }
    addPart(b, part);
  }
}

/// A frame begins, or goes on after the world has stood still.
void BodyTraces::begin(bool continues) {
  const bool goesOn = continues && !std::exchange(stoodStill_, false);
  stoodStill_ = false;
  find(goesOn);
  if (goesOn) return;
  for (RigidBody* b : list_) {
    if (!continues) b->trace.arcs.clear();
    note(*b, time_.partStart());
  }
}

/// Bodies that are traced for others, and those of a pair that could part in this part of a frame; if it goes
/// on, besides those of its first part. A body that is hit meanwhile is noted from then on.
void BodyTraces::find(bool goesOn) {
  constexpr double kUsualPull = 10;  // [m/s2]
  const double span = 2 * (time_.partEnd() - time_.partStart()) + 0.02;
  if (!goesOn)
    for (RigidBody* b : list_) b->trace.awaited = false;
  const auto mayGo = [&](const RigidBody* b) {
    if (!b || standsStill(b->mode)) return 0.0;
    if (b->mode == BodyMode::Held) return 1e300;
    const MotionBound bound = b->boundOver(time_.partStart(), time_.partStart());
    return (bound.speedAt(b->reach) + std::max(kUsualPull, bound.acceleration) * span) * span;
  };
  for (const ContactMemory::Waiting& w : memory_.waiting()) {
    RigidBody *a = w.pair.first.isBody ? objects_.body(w.pair.first.id) : nullptr,
              *b = objects_.body(w.pair.second);
    const double way = mayGo(a) + mayGo(b);
    if (way == 0 || way < w.slackAt(time_.t0())) continue;
    for (RigidBody* one : {a, b}) {
      if (!one || one->trace.awaited) continue;
      one->trace.awaited = true;
      if (one->trace.traced || !one->trace.arcs.empty()) continue;
      list_.push_back(one);
      if (goesOn) note(*one, time_.partStart());
    }
  }
  std::erase_if(list_, [](RigidBody* b) {
    if (b->trace.traced || b->trace.awaited) return false;
    b->trace.arcs.clear();
    return true;
  });
}

/// From t1 on all stand where they are.
void BodyTraces::pause(bool continues) {
  stoodStill_ = true;
  for (RigidBody* b : list_) {
    if (!continues) b->trace.arcs.clear();
    addPart(*b, ArcPiece::straight(Instant{time_.t1(), 0}, b->pose, Vec3::Zero(), Vec3::Zero()));
  }
}

}  // namespace stadion
