#include "engine/nodes/trigger_node.h"

#include "engine/scene/scene.h"

#include <algorithm>
#include <cmath>

namespace stadion {

bool Region::contains(const Vec3& p) const {
  if (form == Form::Sphere) return (p - centre).squaredNorm() <= radius * radius;
  return ((p - centre).cwiseAbs().array() <= halfSize.array()).all();
}

double Region::crossing(const Vec3& a, const Vec3& b) const {
  const Vec3 d = b - a;
  if (form == Form::Sphere) {
    // |a - c + s d|^2 = r^2; the smaller root on the way in, the larger one on the way out.
    const Vec3 m = a - centre;
    const double A = d.squaredNorm(), B = m.dot(d), C = m.squaredNorm() - radius * radius;
    const double root = std::sqrt(std::max(0.0, B * B - A * C));
    return std::clamp((C > 0 ? -B - root : -B + root) / A, 0.0, 1.0);
  }
  double in = 0, out = 1;
  for (int i = 0; i < 3; ++i) {
    if (d[i] == 0) continue;
    const double s0 = (centre[i] - halfSize[i] - a[i]) / d[i], s1 = (centre[i] + halfSize[i] - a[i]) / d[i];
    in = std::max(in, std::min(s0, s1));
    out = std::min(out, std::max(s0, s1));
  }
  return std::clamp(contains(a) ? out : in, 0.0, 1.0);
}

std::optional<Vec3> TriggerNode::visitor(const FrameContext& frame) const {
  Vec3 p_W;
  if (tracker_ == "head") {
    p_W = frame.scene.rigPose() * frame.scene.headInRig(frame.input).p;
  } else {
    const std::optional<Pose> X_WT = frame.scene.trackerInWorld(tracker_, frame.input);
    if (!X_WT) return std::nullopt;
    p_W = X_WT->p;
  }
  return frame.scene.placements().world(placement()).inverse() * p_W;
}

void TriggerNode::receive(const Message& m, FrameContext& frame) {
  PlacedNode::receive(m, frame);
  const bool before = switch_.on();
  if (switch_.obey(m) && (!before || m.verb == Verb::Reset)) inside_ = looked_ = false;
}

void TriggerNode::simulate(FrameContext& frame) {
  PlacedNode::simulate(frame);
  if (!switch_.on()) return;
  const std::optional<Vec3> p = visitor(frame);
  if (!p) return;
  const bool inside = region_.contains(*p);
  if (inside != inside_) {
    const double s = looked_ ? region_.crossing(last_, *p) : 1.0;
    const auto back = static_cast<Nanoseconds>((1.0 - s) * static_cast<double>(frame.now.step));
    raise(inside ? Event::Enter : Event::Exit, frame.now.time - back);
  }
  inside_ = inside;
  last_ = *p;
  looked_ = true;
  watchButtons(frame);
}

void TriggerNode::watchButtons(const FrameContext& frame) {
  const TrackerSample* t = frame.input.find(tracker_);
  if (kind() != NodeKind::WandTrigger || !t) return;
  constexpr Event pressed[] = {Event::Button1, Event::Button2, Event::Button3, Event::Button4};
  for (std::uint32_t b = 0; b < 4; ++b)
    if (inside_ && (t->buttons & ~buttons_ & (1U << b))) raise(pressed[b], frame.now.time);
  buttons_ = t->buttons;
}

void TriggerNode::hash(StateHash& h) const {
  PlacedNode::hash(h);
  switch_.hash(h);
  h.add(inside_), h.add(looked_), h.add(last_), h.add(buttons_);
}

}  // namespace stadion
