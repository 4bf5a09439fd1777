#include "engine/scene/object_node.h"

#include "engine/scene/scene.h"

#include <charconv>

#include <fmt/format.h>

namespace stadion {
namespace {

constexpr CommandId kTint = commandNamed("tint"), kEmit = commandNamed("emit"),
                    kOpacity = commandNamed("opacity");

/// The numbers of a message, from 0 to 1. Returns false if there are others.
bool readShares(const Message& m, std::span<double> shares) {
  if (m.arguments.size() != shares.size()) return false;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const std::string& word = m.arguments[i];
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), shares[i]);
    if (fault != std::errc() || end != word.data() + word.size()) return false;
    if (!(shares[i] >= 0 && shares[i] <= 1)) return false;
    shares[i] += 0.0;  // no negative zero
  }
  return true;
}

/// Changes the paint as the message says. Returns false if it says nothing about paint.
bool apply(const Message& m, Paint& paint) {
  if (m.command == kOpacity) return readShares(m, {&paint.opacity, 1});
  if (m.command == kTint) return readShares(m, {paint.tint.data(), 3});
  return m.command == kEmit && readShares(m, {paint.emit.data(), 3});
}

}  // namespace

void ObjectNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  instance_ = scene.instances().add(placement(), appearance_.mesh, appearance_.drawn, self());
  paint_.reset();
  paintNumber_ = 0;
  paint(appearance_.paint, scene);
}

bool ObjectNode::resume(Scene& scene) {
  if (!scene.instances().owns(instance_, self())) return false;
  if (!paint_) return paintNumber_ == 0;
  if (!paint_->isValid() || paint_->isNeutral()) return false;
  return paintNumber_ == 0 || scene.paints().holds(paintNumber_, *paint_);
}

void ObjectNode::onLeave(Scene& scene) {
  scene.paints().remove(paintNumber_);
  scene.instances().remove(instance_);
  PlacedNode::onLeave(scene);
}

void ObjectNode::receive(const Message& m, FrameContext& frame) {
  PlacedNode::receive(m, frame);
  if (m.command == CommandId::Reset) return paint(appearance_.paint, frame.scene);
  Paint changed = paint_.value_or(Paint());
  if (apply(m, changed)) paint(changed, frame.scene);
}

void ObjectNode::paint(const Paint& paint, Scene& scene) {
  if (paint == paint_.value_or(Paint())) return;
  scene.paints().remove(std::exchange(paintNumber_, 0));
  paint_.reset();
  if (!paint.isNeutral()) {
    paint_ = paint;
    paintNumber_ = scene.paints().add(paint);
    if (paintNumber_ == 0)
      scene.warn(*this, fmt::format("more than {} paints are there; this model keeps its own", kMostPaints));
  }
  scene.instances().setPaint(instance_, paintNumber_, paint.opacity);
}

void ObjectNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

}  // namespace stadion
