#include "dynamics/world/world_core.h"

namespace stadion {

/// Notes the body's way from now on, for others or for its own partings, or no longer.
void World::Core::trace(RigidBody& b, bool traced, bool awaited, double tau) {
  const bool before = b.traced || b.awaited;
  b.traced = traced, b.awaited = awaited;
  if (before == (traced || awaited)) return;
  b.trace.clear();
  if (before) {
    std::erase(tracedBodies, &b);
  } else {
    tracedBodies.push_back(&b);
    noteWay(b, tau);
  }
}

void World::Core::addPart(RigidBody& b, WayPart part) {
  part.jump = std::exchange(b.put, false);
  // What lasts for no time is no part of a way.
  if (!b.trace.empty() && !(b.trace.back().from < part.from)) {
    part.from = b.trace.back().from, part.jump = part.jump || b.trace.back().jump;
    b.trace.back() = part;
  } else {
    b.trace.push_back(part);
  }
}

/// The body follows the arc that it has now from tau on.
void World::Core::noteWay(RigidBody& b, double tau) {
  if (!b.traced && !b.awaited) return;
  if (b.mode == BodyMode::Held) return noteHeld(b, tau);
  WayPart part;
  part.from = time_.instantAt(tau);
  part.pathAge = b.age(tau), part.spinAge = b.spinAge(tau);
  part.path = b.path, part.spin = b.spin, part.X_CN = b.X_CN;
  addPart(b, part);
}

/// The way of a held body from tau on, in this part of a frame.
void World::Core::noteHeld(RigidBody& b, double tau) {
  if (!b.traced && !b.awaited) return;
  if (!b.held.guided()) {
    const Kinematics k = b.held.at(tau);
    return addPart(b, WayPart::straight(time_.instantAt(tau), k.pose, k.v, k.omega));
  }
  for (std::size_t i = b.held.partAfter(tau); i < b.held.way.size() && b.held.way[i].tau < time_.now(); ++i) {
    WayPart part = b.held.way[i];
    const double early = tau - part.tau;
    if (early > 0) part.from = time_.instantAt(tau), part.pathAge += early, part.spinAge += early;
    addPart(b, part);
  }
}

/// A frame begins, or goes on after the world has stood still.
void World::Core::beginTraces(bool continues) {
  const bool goesOn = continues && !std::exchange(stoodStill, false);
  stoodStill = false;
  findTraced(goesOn);
  if (goesOn) return;
  for (RigidBody* b : tracedBodies) {
    if (!continues) b->trace.clear();
    noteWay(*b, time_.from());
  }
}

/// Bodies that are traced for others, and those of a pair that could part in this part of a frame; if it goes
/// on, besides those of its first part. What is dashed away meanwhile is noted from then on.
void World::Core::findTraced(bool goesOn) {
  constexpr double kUsualPull = 10;  // [m/s2]
  const double span = 2 * (time_.now() - time_.from()) + 0.02;
  if (!goesOn)
    for (RigidBody* b : tracedBodies) b->awaited = false;
  const auto mayGo = [&](const RigidBody* b) {
    if (!b || standsStill(b->mode)) return 0.0;
    if (b->mode == BodyMode::Held) return 1e300;
    const MotionBound bound = b->boundOver(time_.from(), time_.from());
    return (bound.speedAt(b->reach) + std::max(kUsualPull, bound.acceleration) * span) * span;
  };
  for (const ContactMemory::Waiting& w : memory.waiting()) {
    RigidBody *a = w.pair.first.isBody ? body(w.pair.first.id) : nullptr, *b = body(w.pair.second);
    if (mayGo(a) + mayGo(b) < w.slack) continue;
    for (RigidBody* one : {a, b}) {
      if (!one || one->awaited) continue;
      one->awaited = true;
      if (one->traced || !one->trace.empty()) continue;
      tracedBodies.push_back(one);
      if (goesOn) noteWay(*one, time_.from());
    }
  }
  std::erase_if(tracedBodies, [](RigidBody* b) {
    if (b->traced || b->awaited) return false;
    b->trace.clear();
    return true;
  });
}

/// From t1 on all stand where they are.
void World::Core::pauseTraces(bool continues) {
  stoodStill = true;
  for (RigidBody* b : tracedBodies) {
    if (!continues) b->trace.clear();
    addPart(*b, WayPart::straight(Instant{time_.t1(), 0}, b->pose, Vec3::Zero(), Vec3::Zero()));
  }
}

}  // namespace stadion
