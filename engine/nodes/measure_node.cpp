#include "engine/nodes/measure_node.h"

#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/core/shared_rows.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace stadion {
namespace {

std::string metres(int centimetres) {
  return fmt::format("{}.{:02} m", centimetres / 100, centimetres % 100);
}

/// What sticks touches and ends at once, to rounding: the touch counts.
Nanoseconds countsAt(const Impact& impact) {
  constexpr Nanoseconds kAtOnce = 1000;
  return impact.ended ? impact.when + kAtOnce : impact.when;
}

}  // namespace

int MeasureResult::centimetres() const {
  constexpr double kFarthest = 1e7;   // [m]
  constexpr double kRounding = 1e-6;  // of a centimetre: 3 m are 300 cm however they were computed
  return foul ? -1 : static_cast<int>(std::floor(100 * std::min(metres, kFarthest) + kRounding));
}

void ThrowMeasureNode::onLeave(Scene& scene) {
  stop(scene);
  PlacedNode::onLeave(scene);
}

void ThrowMeasureNode::start(Nanoseconds when, Scene& scene) {
  stop(scene);
  result_.reset();
  compared_ = written_ = false;
  started_ = when;
  body_ = scene.tree().resolve(attributes_.body, self());
  if (body_.valid()) scene.impacts().watch(body_, self());
  if (body_.valid()) scene.schedule().wakeAt(started_ + attributes_.duration, self());
}

void ThrowMeasureNode::stop(Scene& scene) {
  if (body_.valid()) scene.impacts().unwatch(body_, self());
  body_ = {};
}

void ThrowMeasureNode::receive(const Message& m, FrameContext& frame) {
  PlacedNode::receive(m, frame);
  if (m.command == CommandId::Start) start(frame.effective(m), frame.scene);
  if (m.command == CommandId::Reset) {
    stop(frame.scene);
    result_.reset();
    compared_ = written_ = false;
  }
}

void ThrowMeasureNode::simulate(FrameContext& frame) {
  PlacedNode::simulate(frame);
  if (!body_.valid()) return;
  const auto result = ended(frame.scene, frame.now.time);
  if (!result) return;
  stop(frame.scene);
  result_ = result;
  compared_ = attributes_.against.empty();
  if (result_->foul)
    raise("foul", result_->when);
  else
    raise("measured", result_->when, result_->metres);
}

/// How the throw has ended, if it has by `now`.
std::optional<ThrowMeasureNode::Result> ThrowMeasureNode::ended(const Scene& scene, Nanoseconds now) const {
  const NodeRef ground =
      attributes_.ground.empty() ? NodeRef{} : scene.tree().resolve(attributes_.ground, self());
  const Impact* first = nullptr;
  for (const Impact& i : scene.impacts().impacts()) {
    const bool ours = i.body == body_ || i.other == body_;
    const NodeRef touched = i.body == body_ ? i.other : i.body;
    if (!ours || i.when < started_ || (!i.ended && ground.valid() && touched != ground)) continue;
    if (!first || countsAt(i) < countsAt(*first)) first = &i;
  }
  const Nanoseconds latest = started_ + attributes_.duration;
  if (first && first->when <= latest)
    return first->ended ? Result{0, true, first->when} : resultOf(*first, scene);
  return latest <= now ? std::optional(Result{0, true, latest}) : std::nullopt;
}

ThrowMeasureNode::Result ThrowMeasureNode::resultOf(const Impact& impact, const Scene& scene) const {
  const Vec3 p = poseOf(scene.placements().world(placement())).inverse() * impact.point_W;
  const double reach = std::sqrt(p.x() * p.x() + p.y() * p.y());
  Result r;
  r.when = impact.when;
  r.metres = attributes_.from == MeasureFrom::Line ? p.y() : reach;
  r.foul = !(p.y() > 0) || p.y() < attributes_.cosHalfSector * reach;
  return r;
}

void ThrowMeasureNode::afterSimulation(FrameContext& frame) {
  if (!result_) return;
  if (!written_) write(told(), result_->when, frame.scene);
  written_ = true;
  if (compared_) return;
  const auto* other = dynamic_cast<const ThrowMeasureNode*>(
      frame.scene.find(frame.scene.tree().resolve(attributes_.against, self())));
  if (other && other != this && other->result()) compare(*other, frame);
}

void ThrowMeasureNode::compare(const ThrowMeasureNode& other, FrameContext& frame) {
  compared_ = true;
  const int ours = result_->centimetres(), theirs = other.result()->centimetres();
  const Nanoseconds when = std::max(result_->when, other.result()->when);
  raise(ours > theirs ? Event("won") : ours < theirs ? Event("lost") : Event("drawn"), when);
  std::string verdict = "a draw";
  if (ours != theirs) {
    verdict = (ours > theirs ? called() : other.called()) + " wins";
    if (std::min(ours, theirs) >= 0) verdict += fmt::format(" by {}", metres(std::abs(ours - theirs)));
  }
  write(told() + "\n" + other.told() + "\n" + verdict, when, frame.scene);
}

std::string ThrowMeasureNode::told() const {
  return called() + " " + (result_->foul ? std::string("foul") : metres(result_->centimetres()));
}

std::string ThrowMeasureNode::called() const {
  return attributes_.label.empty() ? name() : attributes_.label;
}

void ThrowMeasureNode::write(const std::string& words, Nanoseconds when, Scene& scene) const {
  if (attributes_.text.empty()) return;
  scene.post(*this, {Event("measured"), attributes_.text, CommandId::Say, {words}, 0}, when);
}

template <class Self, class Fields>
void ThrowMeasureNode::fields(Self& self, Fields& f) {
  PlacedNode::fields(self, f);
  f("body", self.body_.load), f("body", self.body_.position), f("started", self.started_);
  f.hashed(self.result_.has_value()), f("compared", self.compared_);
  f("result", self.result_);
  f.unhashed("written", self.written_);
}

void ThrowMeasureNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void ThrowMeasureNode::state(StateFields& f) {
  fields(*this, f);
}

namespace {

std::unique_ptr<Node> makeMeasure(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  const auto named = [&](Attr attr) {
    const auto reference = d.reference(attr);
    return reference ? std::string(reference->name) : std::string();
  };
  ThrowMeasureAttributes a;
  a.body = named("body");
  a.ground = named("ground");
  a.text = named("text");
  a.against = named("against");
  a.label = std::string(d.text("label"));
  a.from = d.choice<MeasureFrom>("from");
  a.duration = fromSeconds(d.number("duration"));
  if (const auto sector = d.optionalNumber("sector")) a.cosHalfSector = det::cos(0.5 * *sector * kDegree);
  return std::make_unique<ThrowMeasureNode>(r.self, r.name, r.place, std::move(a));
}

constexpr std::string_view kOrigins[] = {"line", "point"};
constexpr AttributeSpec kMeasureRows[] = {
    {.name = "body",
     .kind = ValueKind::Reference,
     .help = "what is thrown; its first impact after \"start\" counts",
     .required = true,
     .targets = {{}, {"dynobject"}}},
    {.name = "ground",
     .kind = ValueKind::Reference,
     .help = "only an impact with this counts; any, if not stated",
     .targets = kModelTypes},
    {.name = "from",
     .kind = ValueKind::Choice,
     .help = "square from the node's X axis, or from its place",
     .standard = "line",
     .choices = kOrigins},
    {.name = "sector",
     .kind = ValueKind::Number,
     .help = "full angle about the node's +Y, outside which a throw is a foul; if not stated, only one that "
             "lands behind the line is",
     .unit = "degrees",
     .range = {0, 180, true}},
    {.name = "duration",
     .kind = ValueKind::Number,
     .help = "a throw that has not touched anything so long after its start is a foul",
     .standard = "60",
     .unit = "s",
     .range = {0, 1e6, true}},
    {.name = "label",
     .kind = ValueKind::Words,
     .help = "what the result is called; the node's name if not stated"},
    {.name = "text",
     .kind = ValueKind::Reference,
     .help = "a text node that shows the result",
     .targets = {{}, {"text"}}},
    {.name = "against",
     .kind = ValueKind::Reference,
     .help = "the measure to compare with, once both have a result",
     .targets = {{}, {"measure"}}},
};

constexpr EventSpec kMeasureEvents[] = {
    {"measured", "the throw has been measured"},
    {"foul", "the throw has landed behind the line or outside the sector"},
    {"won", "both throws have a result, and this one is farther, by a centimetre at least"},
    {"lost", "both throws have a result, and the other is farther"},
    {"drawn", "both throws have a result, and neither is farther"}};

constexpr CommandSpec kMeasureCommands[] = {
    {"start", ArgumentKind::None, "start", "the body's next impact is measured"}};

}  // namespace

constinit const NodeType kMeasureType{
    .name = "measure",
    .help = "takes the distance of a throw where the body first touches, from its X axis towards +Y",
    .attributes = kMeasureRows,
    .events = kMeasureEvents,
    .commands = kMeasureCommands,
    .traits = {Trait::Placed},
    .make = makeMeasure,
};

namespace node_types {

void addMeasureNode(NodeRegistrar& types) {
  types.add(kMeasureType);
}

}  // namespace node_types

}  // namespace stadion
