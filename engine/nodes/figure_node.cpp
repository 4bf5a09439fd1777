#include "engine/nodes/figure_node.h"

#include "engine/build/lint.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/nodes/clip_words.h"
#include "engine/nodes/object_node.h"
#include "engine/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace stadion {
namespace {

constexpr CommandId kPlay = commandNamed("play"), kPause = commandNamed("pause"),
                    kStop = commandNamed("stop"), kPose = commandNamed("pose");

/// A figure whose clips turn more often in a frame is followed on the grid of chords alone.
constexpr std::size_t kMostTurns = 512;

/// As near as a motion of at most 1000 m/s and 1000 rad/s comes within a nanosecond.
bool isNear(const Pose& a, const Pose& b) {
  return (a.p - b.p).norm() < 1e-6 && std::fabs(a.q.dot(b.q)) > 1 - 1e-12;
}

std::string_view wordsOf(const Message& m) {
  return m.arguments.empty() ? std::string_view() : m.arguments[0];
}

}  // namespace

FigureNode::FigureNode(NodeRef self, std::string name, PlaceAttributes place, Appearance appearance,
                       std::shared_ptr<const Skeleton> skeleton, ClipPlayer::Start standard,
                       Beginning beginning)
    : ObjectNode(kFigureType, self, std::move(name), std::move(place), std::move(appearance)),
      skeleton_(std::move(skeleton)), standard_(standard), beginning_(beginning) {}

void FigureNode::onEnter(Scene& scene) {
  ObjectNode::onEnter(scene);
  if (!skeleton_) return;
  number_ = scene.figures().add();
  if (number_ == 0)
    scene.warn(*this, fmt::format("more than {} figures are there; this one stands at rest", kMostFigures));
  scene.instances().setFigure(instance(), number_);
  begin(scene.now());
  show(scene.now(), scene);
}

void FigureNode::onLeave(Scene& scene) {
  scene.figures().remove(number_);
  ObjectNode::onLeave(scene);
}

void FigureNode::begin(Nanoseconds when) {
  player_.stop();
  if (beginning_) player_.play(*beginning_, when);
}

bool FigureNode::resume(Scene& scene) {
  if (!ObjectNode::resume(scene)) return false;
  if (!skeleton_) return true;
  if (number_ != 0 && !scene.figures().has(number_)) return false;
  if (!player_.fits(skeleton_->clips.size())) return false;
  // It reports each end that it has missed.
  if (player_.endsUpTo(scene.now()) > static_cast<double>(kMostPasses)) return false;
  show(scene.now(), scene);
  return true;
}

void FigureNode::receive(const Message& m, FrameContext& frame) {
  ObjectNode::receive(m, frame);
  if (!skeleton_) return;
  const Nanoseconds when = frame.effective(m);
  endClips(when);  // what has ended up to the command still counts
  if (!carried_.empty()) past_.push_back({when, player_});
  if (m.command == kPlay) play(wordsOf(m), when, frame.scene);
  if (m.command == kPose) pose(wordsOf(m), when, frame.scene);
  if (m.command == kPause) player_.pause(when);
  if (m.command == kStop) player_.stop();
  if (m.command == CommandId::Reset) begin(when);
}

void FigureNode::play(std::string_view words, Nanoseconds when, Scene& scene) {
  if (words.empty()) return player_.resume(when);
  const ClipWords read = readPlay(words, *skeleton_, standard_);
  if (!read.start) return scene.warn(*this, "play: " + read.fault);
  player_.play(*read.start, when);
}

void FigureNode::pose(std::string_view words, Nanoseconds when, Scene& scene) {
  const ClipWords read = readPose(words, *skeleton_);
  if (!read.start) return scene.warn(*this, "pose: " + read.fault);
  player_.play(*read.start, when);
}

void FigureNode::endClips(Nanoseconds time) {
  while (const auto end = player_.takeEnd(time)) {
    if (end->loops)
      raise("looped", end->when);
    else
      raise("finished", end->when);
  }
}

void FigureNode::simulate(FrameContext& frame) {
  ObjectNode::simulate(frame);
  if (!skeleton_) return;
  const Nanoseconds now = frame.now.time;
  endClips(now);
  traceCarried(frame);
  past_.clear();
  player_.forget(now);
  show(now, frame.scene);
}

void FigureNode::carry(NodeRef node, std::uint32_t bone) {
  letGo(node);
  carried_.push_back({node, bone});
}

void FigureNode::letGo(NodeRef node) {
  std::erase_if(carried_, [&](const Carried& c) { return c.node == node; });
}

/// Null if it is not there, or a tracker or a dynamics node moves it.
PlacedNode* FigureNode::carriedNode(NodeRef node, Scene& scene) const {
  Node* found = scene.find(node);
  PlacedNode* placed = found ? found->placed() : nullptr;
  return placed && !placed->isMovedFromOutside() ? placed : nullptr;
}

void FigureNode::placeCarried(Nanoseconds time, Scene& scene) {
  if (carried_.empty()) return;
  pose_.set(*skeleton_, player_.at(time));
  const Affine X_WN = scene.placements().world(placement());
  for (const Carried& c : carried_)
    if (PlacedNode* node = carriedNode(c.node, scene))
      node->place(scene, X_WN * pose_.bone(c.bone) * node->attributes().X_PN);
}

FigureRecord FigureNode::playedAt(Nanoseconds time) const {
  const auto past = std::ranges::upper_bound(past_, time, {}, &Past::until);
  return (past == past_.end() ? player_ : past->player).at(time);
}

/// Reports the motion within the frame to nodes that watch: curves between the times at which it may bend.
void FigureNode::traceCarried(FrameContext& frame) {
  const Placements& placements = frame.scene.placements();
  PoseTracks& tracks = frame.scene.poseTracks();
  const Nanoseconds from = frame.start(), to = frame.now.time;
  std::vector<std::pair<PlacedNode*, std::uint32_t>> watched;
  for (const Carried& c : carried_)
    if (PlacedNode* node = carriedNode(c.node, frame.scene);
        node && placements.watchedBelow(node->placement()))
      watched.emplace_back(node, c.bone);
  if (watched.empty() || from >= to) return;

  std::vector<Nanoseconds> grid{to}, times;
  for (Nanoseconds t = (from / kChord + 1) * kChord; t < to; t += kChord) grid.push_back(t);
  Nanoseconds since = from;
  for (const Past& past : past_) {
    past.player.turns(*skeleton_, since, past.until, times);
    if (past.until > from && past.until <= to) times.push_back(past.until);
    since = past.until;
  }
  player_.turns(*skeleton_, since, to, times);
  const auto sort = [&] {
    std::ranges::sort(times);
    times.erase(std::unique(times.begin(), times.end()), times.end());
  };
  sort();
  if (times.size() > kMostTurns) times.clear();
  times.insert(times.end(), grid.begin(), grid.end());
  sort();

  const Affine X_WN = placements.world(placement());
  const auto posesAt = [&](Nanoseconds t) {
    pose_.set(*skeleton_, playedAt(t));
    const Affine X = withScale(tracks.at(placement(), t, placements), X_WN);
    std::vector<Pose> poses;
    for (const auto& [node, bone] : watched)
      poses.push_back(poseOf(X * pose_.bone(bone) * node->attributes().X_PN));
    return poses;
  };
  for (const auto& [node, bone] : watched)
    tracks.of(node->placement(), {from, poseOf(placements.world(node->placement())), false});
  Nanoseconds before = from;
  for (const Nanoseconds t : times) {
    std::array<std::vector<Pose>, 3> between;
    const bool curved = poseBetween(before, t, [&, k = between.begin()](Nanoseconds time) mutable {
                          *k++ = posesAt(time);
                          return Pose{};
                        }).has_value();
    // One moment before: a clip may jump at t.
    const std::vector<Pose> last = posesAt(t - 1), now = posesAt(t);
    for (std::size_t i = 0; i < watched.size(); ++i) {
      PoseTrack& track = tracks.of(watched[i].first->placement(), {});
      std::optional<CurvePoses> curve;
      if (curved) curve = CurvePoses{between[0][i], between[1][i], between[2][i]};
      const bool jumps = !isNear(last[i], now[i]);
      track.push_back({t, jumps ? last[i] : now[i], false, curve});
      if (jumps) track.push_back({t, now[i], true});
    }
    before = t;
  }
}

void FigureNode::show(Nanoseconds time, Scene& scene) {
  scene.figures().set(number_, player_.at(time));
  placeCarried(time, scene);
  moves_ = player_.moves(time);
}

template <class Self, class Fields>
void FigureNode::fields(Self& whole, Fields& f) {
  auto& self = partOf<FigureNode>(whole);
  ObjectNode::fields(self, f);
  f("player", self.player_);
  f.unhashed("figure", self.number_), f.unhashed("moves", self.moves_);
}

void FigureNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void FigureNode::state(StateFields& f) {
  fields(*this, f);
}

namespace {

/// The model's clip `clip=`; reports one that is not there.
FigureNode::Beginning beginningOf(const NodeRequest& r, const Skeleton& skeleton, ClipPlayer::Start start) {
  const Declaration& d = r.declaration;
  const std::string_view name = d.text("clip");
  if (name.empty()) return {};
  const auto clip = clipNamed(skeleton, name);
  if (!clip) {
    r.findings.error(d.where("clip"),
                     skeleton.clips.empty() ? fmt::format("\"{}\" has no clips", d.text("file"))
                                            : fmt::format("\"{}\" has no clip \"{}\"; there are {}",
                                                          d.text("file"), name, clipNames(skeleton)),
                     d.excerpt("clip"));
    return {};
  }
  start.clip = *clip;
  start.length = skeleton.clips[*clip].length;
  start.at = d.number("phase");
  if (!start.loop) start.at = std::min(start.at, start.length);
  if (start.loop && start.length > 0) start.at -= std::floor(start.at / start.length) * start.length;
  return start;
}

std::unique_ptr<Node> makeFigure(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  ClipPlayer::Start standard;
  standard.speed = d.number("speed");
  standard.loop = d.flag("loop");
  const std::shared_ptr<const Skeleton> skeleton = r.mesh ? r.mesh->skeleton : nullptr;
  const FigureNode::Beginning beginning =
      skeleton ? beginningOf(r, *skeleton, standard) : FigureNode::Beginning();
  standard.fade = fromSeconds(d.number("fade"));
  return std::make_unique<FigureNode>(r.self, r.name, r.place, r.appearance, skeleton, standard, beginning);
}

constexpr AttributeSpec kFigureRows[] = {
    {.name = "file",
     .kind = ValueKind::File,
     .help = "the model: .gltf, .glb, .fbx or .dae",
     .required = true},
    {.name = "clip", .kind = ValueKind::Words, .help = "what it plays from the start; at rest if not stated"},
    {.name = "speed",
     .kind = ValueKind::Number,
     .help = "seconds of a clip that it plays in a second; negative: backwards",
     .standard = "1",
     .range = {-1000, 1000}},
    {.name = "phase",
     .kind = ValueKind::Number,
     .help = "time of the clip at which it begins",
     .standard = "0",
     .unit = "s",
     .range = {0, kLong}},
    {.name = "loop",
     .kind = ValueKind::Flag,
     .help = "whether a clip repeats; if not, it stays in its last pose",
     .standard = "on"},
    {.name = "fade",
     .kind = ValueKind::Number,
     .help = "how long a clip that `play` names takes to replace the one before",
     .standard = "0.2",
     .unit = "s",
     .range = {0, kLong}},
    {.name = "draw", .kind = ValueKind::Flag, .help = "whether it is visible", .standard = "on"},
    kObjectUnit,
    kObjectUp,
};

constexpr EventSpec kFigureEvents[] = {
    {"finished", "a clip that does not repeat has reached its end"},
    {"looped", "a clip that repeats has reached its end and restarts"},
};

constexpr CommandSpec kFigureCommands[] = {
    {"play", ArgumentKind::Words, "play [CLIP [OPTION ...]]",
     "plays a clip of the model, with the options fade SECONDS, speed FACTOR, from SECONDS, once or loop; "
     "without a name it goes on after a pause"},
    {"pause", ArgumentKind::None, "pause", "stands still in its present pose"},
    {"stop", ArgumentKind::None, "stop", "returns to its pose at rest"},
    {"pose", ArgumentKind::Words, "pose CLIP SECONDS", "stands still as at that time of a clip"},
};

}  // namespace

constinit const NodeType kFigureType{
    .name = "figure",
    .help = "a model with bones that plays its clips; it is drawn, and nothing collides with it",
    .attributes = kFigureRows,
    .events = kFigureEvents,
    .commands = kFigureCommands,
    .traits = {Trait::Placed, Trait::Parent, Trait::Level, Trait::Figure},
    .make = makeFigure,
    .lint = lintModel,
};

namespace node_types {

void addFigureNode(NodeRegistrar& types) {
  types.add(kFigureType);
}

}  // namespace node_types

}  // namespace stadion
