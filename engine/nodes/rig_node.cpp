#include "engine/nodes/rig_node.h"

#include "engine/maths/functions.h"
#include "engine/scene/scene.h"

#include <cmath>

namespace stadion {

void RigNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  scene.setRig(self(), placement(), eyeHeight_);
}

void RigNode::onLeave(Scene& scene) {
  scene.dropRig(self());
  PlacedNode::onLeave(scene);
}

void NavigatorNode::receive(const Message& m, FrameContext&) {
  switch_.obey(m);
}

void NavigatorNode::simulate(FrameContext& frame) {
  const TrackerSample* t = frame.input.find(attributes_.tracker);
  if (!switch_.on() || !t || !t->valid) return;
  const double turn = t->axes[0], forward = t->axes[1];
  if (turn == 0 && forward == 0) return;
  const double dt = toSeconds(frame.now.step);
  Pose X_WR = frame.scene.rigPose();

  // Turning is about the visitor's head, so that the world turns around them and not they around the room's
  // centre.
  const Vec3 head_W = X_WR * frame.scene.headInRig(frame.input).p;
  const Quat turned = det::expRotation(Vec3(0, 0, -turn * attributes_.turnRate * dt));
  X_WR.p = head_W + turned * (X_WR.p - head_W);
  X_WR.q = (turned * X_WR.q).normalized();

  Vec3 ahead = X_WR.q * (t->X_RT.q * Vec3::UnitY());
  if (!attributes_.fly) ahead.z() = 0;
  const double length = ahead.norm();
  if (length > 1e-6) X_WR.p += ahead / length * (forward * attributes_.speed * dt);
  frame.scene.moveRig(X_WR);
}

}  // namespace stadion
