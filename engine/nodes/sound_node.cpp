#include "engine/nodes/sound_node.h"

#include "engine/build/lint.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/core/shared_rows.h"
#include "engine/scene/scene.h"
#include "engine/script/file_path.h"

#include <algorithm>

#include <fmt/format.h>

namespace stadion {

SoundNode::SoundNode(NodeRef self, std::string name, PlaceAttributes place, Attributes a, bool on)
    : PlacedNode(kSoundType, self, std::move(name), std::move(place)), attributes_(std::move(a)),
      switch_(on) {
  if (attributes_.loop) attributes_.length = std::max(attributes_.length, kShortestPass);
}

void SoundNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  handle_ = scene.sounds().add(placement());
  if (switch_.on()) startAt(scene.now(), scene);
}

void SoundNode::onLeave(Scene& scene) {
  scene.sounds().remove(handle_);
  PlacedNode::onLeave(scene);
}

void SoundNode::startAt(Nanoseconds when, Scene& scene) {
  since_ = when;
  due_ = when + attributes_.length;
  scene.schedule().wakeAt(due_, self());
  publish(scene);
}

void SoundNode::publish(Scene& scene) {
  heard_ = switch_.on();
  setSource(scene);
}

bool SoundNode::resume(Scene& scene) {
  if (!scene.sounds().isAt(handle_, placement())) return false;
  // Reports each pass that it has missed.
  const bool repeats = switch_.on() && attributes_.loop;
  if (since_ < 0 || due_ < 0) return false;
  if (repeats && (scene.now() - due_) / attributes_.length > kMostPasses) return false;
  setSource(scene);
  return true;
}

void SoundNode::setSource(Scene& scene) const {
  scene.sounds().set(handle_, heard_,
                     {self(), attributes_.file, Vec3::Zero(), attributes_.gain, attributes_.range,
                      attributes_.loop, since_});
}

void SoundNode::endPasses(Nanoseconds time) {
  while (switch_.on() && due_ <= time) {
    raise("finished", due_);
    if (attributes_.loop)
      due_ += attributes_.length;
    else
      switch_.set(false);
  }
}

void SoundNode::receive(const Message& m, FrameContext& frame) {
  PlacedNode::receive(m, frame);
  endPasses(frame.effective(m));  // what has passed up to the command still counts
  if (switch_.apply(m) && switch_.on()) startAt(frame.effective(m), frame.scene);
}

void SoundNode::simulate(FrameContext& frame) {
  PlacedNode::simulate(frame);
  endPasses(frame.now.time);
  if (switch_.on()) frame.scene.schedule().wakeAt(due_, self());
  if (heard_ != switch_.on()) publish(frame.scene);
}

template <class Self, class Fields>
void SoundNode::fields(Self& self, Fields& f) {
  PlacedNode::fields(self, f);
  f("switch", self.switch_), f("since", self.since_), f("due", self.due_);
  f.unhashed("handle", self.handle_), f.unhashed("heard", self.heard_);
}

void SoundNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void SoundNode::state(StateFields& f) {
  fields(*this, f);
}

namespace {

std::unique_ptr<Node> makeSound(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  SoundNode::Attributes a;
  a.file = std::string(d.text("file"));
  a.length = r.soundLength;
  a.gain = d.number("gain");
  a.range = d.optionalNumber("range").value_or(0);
  a.loop = d.flag("loop");
  return std::make_unique<SoundNode>(r.self, r.name, r.place, std::move(a), d.flag("initstate"));
}

constexpr std::string_view kSoundEndings[] = {"wav", "aiff", "aif", "flac", "ogg"};

void lintSound(const Declaration& node, LintScope& scope) {
  const std::string ending = endingOf(node.text("file"));
  if (std::find(std::begin(kSoundEndings), std::end(kSoundEndings), ending) == std::end(kSoundEndings))
    scope.warn(
        node, "file",
        fmt::format("\"{}\" is not in a format that is read (.wav, .aiff, .flac, .ogg)", node.text("file")));
  if (node.number("gain") == 0) scope.warn(node, "gain", "a sound of gain 0 is never heard");
  scope.warnNeverOn(node);
}

constexpr AttributeSpec kSoundRows[] = {
    {.name = "file",
     .kind = ValueKind::File,
     .help = "what is heard: .wav, .aiff, .flac or .ogg (Vorbis)",
     .required = true},
    {.name = "gain",
     .kind = ValueKind::Number,
     .help = "how loud it is: 1 as the file has it",
     .standard = "1",
     .range = kUnitInterval},
    {.name = "range",
     .kind = ValueKind::Number,
     .help = "how far from its place it is heard; without it, it is heard everywhere alike",
     .unit = "m",
     .range = kLengthRange},
    {.name = "loop",
     .kind = ValueKind::Flag,
     .help = "whether it starts again at its end",
     .standard = "off"},
    kInitStateRow,
};

constexpr EventSpec kSoundEvents[] = {
    {"finished",
     "the path has reached its last key, the sound its end; told at the end of each pass if it loops"}};

}  // namespace

constinit const NodeType kSoundType{
    .name = "sound",
    .help = "something that is heard, from its place or from everywhere",
    .attributes = kSoundRows,
    .events = kSoundEvents,
    .traits = {Trait::Placed, Trait::Switched, Trait::Sound},
    .make = makeSound,
    .lint = lintSound,
};

namespace node_types {

void addSoundNode(NodeRegistrar& types) {
  types.add(kSoundType);
}

}  // namespace node_types

}  // namespace stadion
