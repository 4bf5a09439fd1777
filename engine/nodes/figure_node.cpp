#include "engine/nodes/figure_node.h"

#include "engine/build/lint.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/figure/clip_words.h"
#include "engine/figure/figure_bounds.h"
#include "engine/nodes/object_node.h"
#include "engine/scene/scene.h"
#include "engine/script/declaration_check.h"
#include "engine/script/event_message_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stadion {
namespace {

constexpr CommandId kPlay = commandNamed("play"), kPause = commandNamed("pause"),
                    kStop = commandNamed("stop"), kPose = commandNamed("pose"),
                    kLayer = commandNamed("layer"), kUnlayer = commandNamed("unlayer");

constexpr Event kMarker("marker");
constexpr std::size_t kMostMarkers = 256;

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
                       Beginning beginning, FigureExtras extras)
    : ObjectNode(kFigureType, self, std::move(name), std::move(place), std::move(appearance)),
      skeleton_(std::move(skeleton)), standard_(standard), beginning_(beginning), extras_(std::move(extras)) {
  if (skeleton_ && extras_.root) path_.emplace(*skeleton_, *extras_.root);
}

void FigureNode::onEnter(Scene& scene) {
  ObjectNode::onEnter(scene);
  if (!skeleton_) return;
  number_ = scene.figures().add();
  if (number_ == 0)
    scene.warn(*this, fmt::format("more than {} figures are there; this one stands at rest", kMostFigures));
  scene.instances().setFigure(instance(), number_);
  if (path_) fitReach(false, scene);
  begin(scene.now());
  show(scene.now(), scene);
}

void FigureNode::onLeave(Scene& scene) {
  scene.figures().remove(number_);
  ObjectNode::onLeave(scene);
}

void FigureNode::begin(Nanoseconds when) {
  now_.player.stop();
  now_.root.begin(poseOf(attributes().X_PN), when);
  if (beginning_) now_.player.play(*beginning_, when);
}

bool FigureNode::resume(Scene& scene) {
  if (!ObjectNode::resume(scene)) return false;
  if (!skeleton_) return true;
  if (number_ != 0 && !scene.figures().has(number_)) return false;
  if (!now_.player.fits(skeleton_->clips.size()) || !now_.root.fits(scene.now())) return false;
  // It reports each end and marker that it has missed.
  const double missed =
      now_.player.endsUpTo(scene.now()) + now_.player.markersUpTo(extras_.markers, scene.now());
  if (missed > static_cast<double>(kMostPasses)) return false;
  if (path_) fitReach(false, scene);
  show(scene.now(), scene);
  return true;
}

/// Gives the instance the sphere that holds the figure, if it is not that of its mesh.
void FigureNode::fitReach(bool added, Scene& scene) {
  hasAddedReach_ = added;
  std::optional<Sphere> reach;
  if (path_)
    reach = added ? extras_.rootAddedReach : extras_.rootReach;
  else if (added)
    reach = skeleton_->addedReach;
  if (reach && !(reach->radius >= 0)) reach.reset();
  scene.instances().setReach(instance(), reach);
}

void FigureNode::receive(const Message& m, FrameContext& frame) {
  if (!skeleton_) return ObjectNode::receive(m, frame);
  const Nanoseconds when = frame.effective(m);
  endClips(when);  // what has ended up to the command still counts
  const bool wasMovedFromOutside = isMovedFromOutside();
  if (!carried_.empty() || path_) past_.push_back({when, now_});
  ObjectNode::receive(m, frame);
  change(m, when, frame.scene);
  if (!path_ || !wasMovedFromOutside || isMovedFromOutside()) return;
  ownSince_ = when;
  if (m.command != CommandId::Reset) takeRootFrom(when, frame.scene);
}

void FigureNode::change(const Message& m, Nanoseconds when, Scene& scene) {
  if (m.command == CommandId::Reset) return begin(when);
  if (m.command == kLayer || m.command == kUnlayer) return layer(m, when, scene);
  if (m.command != kPlay && m.command != kPose && m.command != kPause && m.command != kStop) return;
  settleRoot(when);
  if (m.command == kPlay) play(wordsOf(m), when, scene);
  if (m.command == kPose) pose(wordsOf(m), when, scene);
  if (m.command == kPause) now_.player.pause(when);
  if (m.command == kStop) now_.player.stop();
}

void FigureNode::play(std::string_view words, Nanoseconds when, Scene& scene) {
  if (words.empty()) return now_.player.resume(when);
  const ClipWords read = readPlay(words, *skeleton_, standard_);
  if (!read.start) return scene.warn(*this, "play: " + read.fault);
  now_.player.play(*read.start, when);
}

void FigureNode::pose(std::string_view words, Nanoseconds when, Scene& scene) {
  const ClipWords read = readPose(words, *skeleton_);
  if (!read.start) return scene.warn(*this, "pose: " + read.fault);
  now_.player.play(*read.start, when);
}

void FigureNode::layer(const Message& m, Nanoseconds when, Scene& scene) {
  if (m.command == kLayer) {
    const ClipWords read = readLayer(wordsOf(m), *skeleton_, standard_);
    if (!read.start) return scene.warn(*this, "layer: " + read.fault);
    return now_.player.addLayer(*read.start, when);
  }
  const LayerWords read = readUnlayer(wordsOf(m), *skeleton_, standard_);
  if (!read.fault.empty()) return scene.warn(*this, "unlayer: " + read.fault);
  now_.player.removeLayers(read.clip, read.fade, when);
}

/// Reports what happens to the clips, in the order of time.
void FigureNode::endClips(Nanoseconds time) {
  while (true) {
    if (const auto passed = now_.player.takeMarker(extras_.markers, time)) {
      raise(extras_.markerEvents[passed->marker], passed->when);
      continue;
    }
    const auto end = now_.player.takeEnd(time);
    if (!end) return;
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
  if (path_) now_.root.forget(now, now_.player, *path_, scaleOf(attributes().X_PN));
  now_.player.forget(now);
  show(now, frame.scene);
}

/// What is played is about to change.
void FigureNode::settleRoot(Nanoseconds when) {
  if (path_) now_.root.settle(when, now_.player, *path_, scaleOf(attributes().X_PN));
}

/// No tracker moves it any more: it goes on from where it is.
void FigureNode::takeRootFrom(Nanoseconds when, Scene& scene) {
  const Placements& placements = scene.placements();
  const PlacementId up = placements.parent(placement());
  const Affine X_WP = withScale(scene.poseTracks().at(up, when, placements), placements.world(up));
  now_.root.begin(poseOf(X_WP.inverse() * placements.world(placement())), when);
}

Affine FigureNode::localAt(const Playing& playing, Nanoseconds time) const {
  const Affine& home = attributes().X_PN;
  return withScale(playing.root.at(time, playing.player, *path_, scaleOf(home)), home);
}

void FigureNode::placeByRoot(Nanoseconds time, Scene& scene) {
  if (movesByRoot()) placeInParent(scene, localAt(now_, time));
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

FigureRecord FigureNode::recordOf(const ClipPlayer& player, Nanoseconds time) const {
  FigureRecord record = player.at(time);
  if (path_) record.root = path_->bone() + 1;
  return record;
}

void FigureNode::placeCarried(Nanoseconds time, Scene& scene) {
  if (carried_.empty()) return;
  pose_.set(*skeleton_, recordOf(now_.player, time));
  const Affine X_WN = scene.placements().world(placement());
  for (const Carried& c : carried_)
    if (PlacedNode* node = carriedNode(c.node, scene))
      node->place(scene, X_WN * pose_.bone(c.bone) * node->attributes().X_PN);
}

const FigureNode::Playing& FigureNode::playingAt(Nanoseconds time) const {
  const auto past = std::ranges::upper_bound(past_, time, {}, &Past::until);
  return past == past_.end() ? now_ : past->playing;
}

/// The nodes whose motion within the frame others want to know.
std::vector<FigureNode::Watched> FigureNode::watchedNodes(Scene& scene) {
  const Placements& placements = scene.placements();
  std::vector<Watched> watched;
  if (movesByRoot() && placements.watchedBelow(placement())) watched.push_back({this, {}});
  for (const Carried& c : carried_)
    if (PlacedNode* node = carriedNode(c.node, scene); node && placements.watchedBelow(node->placement()))
      watched.push_back({node, c.bone});
  return watched;
}

/// A grid, and the times at which the motion may bend or jump.
std::vector<Nanoseconds> FigureNode::turnsWithin(Nanoseconds from, Nanoseconds to) const {
  std::vector<Nanoseconds> grid{to}, times;
  for (Nanoseconds t = (from / kChord + 1) * kChord; t < to; t += kChord) grid.push_back(t);
  Nanoseconds since = from;
  for (const Past& past : past_) {
    past.playing.player.turns(*skeleton_, since, past.until, times);
    if (past.until > from && past.until <= to) times.push_back(past.until);
    since = past.until;
  }
  now_.player.turns(*skeleton_, since, to, times);
  const auto sort = [&] {
    std::ranges::sort(times);
    times.erase(std::unique(times.begin(), times.end()), times.end());
  };
  sort();
  if (times.size() > kMostTurns) times.clear();
  times.insert(times.end(), grid.begin(), grid.end());
  sort();
  return times;
}

/// In World, at a time within the frame.
std::vector<Pose> FigureNode::posesAt(Nanoseconds time, const std::vector<Watched>& watched, Scene& scene) {
  const Placements& placements = scene.placements();
  const PoseTracks& tracks = scene.poseTracks();
  const Playing& playing = playingAt(time);
  Affine X_WN;
  if (movesByRoot() && time >= ownSince_) {
    const PlacementId up = placements.parent(placement());
    X_WN = withScale(tracks.at(up, time, placements), placements.world(up)) * localAt(playing, time);
  } else {
    X_WN = withScale(tracks.at(placement(), time, placements), placements.world(placement()));
  }
  pose_.set(*skeleton_, recordOf(playing.player, time));
  std::vector<Pose> poses;
  for (const Watched& w : watched)
    poses.push_back(poseOf(w.bone ? X_WN * pose_.bone(*w.bone) * w.node->attributes().X_PN : X_WN));
  return poses;
}

std::vector<Pose> FigureNode::posesAt(const QuarterTime& quarter, const std::vector<Watched>& watched,
                                      Scene& scene) {
  std::vector<Pose> poses = posesAt(quarter.time, watched, scene);
  if (quarter.part == 0) return poses;
  const std::vector<Pose> next = posesAt(quarter.time + 1, watched, scene);
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = quarter.between(poses[i], next[i]);
  return poses;
}

/// Reports the motion within the frame to nodes that watch: curves between the times at which it may bend.
void FigureNode::traceCarried(FrameContext& frame) {
  const Placements& placements = frame.scene.placements();
  PoseTracks& tracks = frame.scene.poseTracks();
  const Nanoseconds from = frame.start(), to = frame.now.time;
  const std::vector<Watched> watched = watchedNodes(frame.scene);
  if (watched.empty() || from >= to) return;

  const std::vector<Pose> first = movesByRoot() ? posesAt(from, watched, frame.scene) : std::vector<Pose>();
  for (std::size_t i = 0; i < watched.size(); ++i) {
    const PlacementId id = watched[i].node->placement();
    PoseTrack& track = tracks.of(id, {from, first.empty() ? poseOf(placements.world(id)) : first[i], false});
    // A reset of this frame is part of the player's past.
    if (!watched[i].bone && ownSince_ <= from) track.assign(1, {from, first[i], false});
  }
  Nanoseconds before = from;
  for (const Nanoseconds t : turnsWithin(from, to)) {
    const bool curved = t - before >= kShortestCurve;
    std::array<std::vector<Pose>, 3> between;
    for (std::size_t k = 0; curved && k < between.size(); ++k)
      between[k] = posesAt(QuarterTime::of(before, t, k), watched, frame.scene);
    // One moment before: a clip may jump at t.
    const std::vector<Pose> last = posesAt(t - 1, watched, frame.scene),
                            now = posesAt(t, watched, frame.scene);
    for (std::size_t i = 0; i < watched.size(); ++i) {
      if (!watched[i].bone && t < ownSince_) continue;
      PoseTrack& track = tracks.of(watched[i].node->placement(), {});
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
  const FigureRecord record = recordOf(now_.player, time);
  if ((record.addedCount > 0) != hasAddedReach_) fitReach(record.addedCount > 0, scene);
  scene.figures().set(number_, record);
  placeByRoot(time, scene);
  placeCarried(time, scene);
  moves_ = now_.player.moves(time);
}

template <class Self, class Fields>
void FigureNode::fields(Self& whole, Fields& f) {
  auto& self = partOf<FigureNode>(whole);
  ObjectNode::fields(self, f);
  f("player", self.now_.player);
  if (self.path_) f("root motion", self.now_.root);
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

/// Reports a fault of a marker or of the root bone, where it stands in the script.
void reportAt(const NodeRequest& r, std::string_view text, std::string message) {
  const SourceText& source = r.declaration.document().source();
  const auto offset = static_cast<std::uint32_t>(text.data() - source.text().data());
  r.findings.error(source.position(offset), std::move(message), source.excerpt(offset));
}

/// What checkMarkers() has let through, and whether the model has such clips.
void takeMarkers(const NodeRequest& r, const Skeleton& skeleton, FigureExtras& extras) {
  std::vector<ClipMarkers::Marker> markers;
  for (const std::string_view text : r.declaration.texts("marker")) {
    const MarkerWords words = readMarker(text);
    const auto clip = clipNamed(skeleton, words.clip);
    if (!clip) {
      reportAt(r, text,
               fmt::format("\"{}\" has no clip \"{}\"; there are {}", r.declaration.text("file"), words.clip,
                           clipNames(skeleton)));
    } else if (const double length = skeleton.clips[*clip].length; words.seconds.value_or(0) > length) {
      reportAt(r, text, fmt::format("the clip \"{}\" is {:.6g} s long", words.clip, length));
    } else {
      markers.push_back({*clip, words.seconds.value_or(0)});
      extras.markerEvents.push_back(kMarker.with(words.name));
    }
  }
  extras.markers = ClipMarkers(std::move(markers));
}

void takeRoot(const NodeRequest& r, const Skeleton& skeleton, FigureExtras& extras) {
  const std::string_view name = r.declaration.text("root");
  if (name.empty()) return;
  const auto at = std::ranges::find(skeleton.bones, name, &Bone::name);
  if (at == skeleton.bones.end())
    return reportAt(r, name,
                    fmt::format("\"{}\" has no bone \"{}\"; there are {}", r.declaration.text("file"), name,
                                boneNames(skeleton)));
  extras.root = static_cast<std::uint32_t>(at - skeleton.bones.begin());
  const Mesh& mesh = *r.mesh;
  const auto reach = [&](std::size_t added) {
    return figureReach(skeleton, mesh.positions, mesh.joints, mesh.morphs,
                       {.added = added, .root = extras.root});
  };
  extras.rootReach = reach(0);
  extras.rootAddedReach = reach(FigureRecord::kMostAdded);
}

std::unique_ptr<Node> makeFigure(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  ClipPlayer::Start standard;
  standard.speed = d.number("speed");
  standard.loop = d.flag("loop");
  const std::shared_ptr<const Skeleton> skeleton = r.mesh ? r.mesh->skeleton : nullptr;
  FigureNode::Beginning beginning;
  FigureExtras extras;
  if (skeleton) {
    beginning = beginningOf(r, *skeleton, standard);
    takeMarkers(r, *skeleton, extras);
    takeRoot(r, *skeleton, extras);
  }
  standard.fade = fromSeconds(d.number("fade"));
  return std::make_unique<FigureNode>(r.self, r.name, r.place, r.appearance, skeleton, standard, beginning,
                                      std::move(extras));
}

/// Finds markers that are none, and events of markers that the figure does not have.
void checkMarkers(DeclarationCheck& check) {
  const Declaration& d = check.declaration();
  const auto texts = d.texts("marker");
  const auto places = check.places("marker");
  if (texts.size() > kMostMarkers)
    return check.error("marker", fmt::format("a figure has {} markers at most", kMostMarkers));
  std::map<std::uint32_t, std::string_view> names;
  std::vector<std::string> all;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const MarkerWords words = readMarker(texts[i]);
    if (words.clip.empty() || !words.seconds || words.name.empty() || faultOfName(words.name))
      return check.errorAt(places[i], "marker must be \"CLIP, SECONDS, NAME\", where NAME is one word");
    const auto [at, isNew] = names.try_emplace(hashOfWord(words.name), words.name);
    if (at->second != words.name)
      return check.errorAt(places[i], fmt::format("the names \"{}\" and \"{}\" have the same number; choose "
                                                  "another name",
                                                  at->second, words.name));
    if (isNew) all.emplace_back(words.name);
  }
  for (const EventMessage& m : d.eventMessages()) {
    const auto has = [&](const std::string& name) { return m.event == kMarker.with(name); };
    if (m.event.name() != kMarker.name() || std::ranges::any_of(all, has)) continue;
    check.errorAt(m.where, all.empty() ? "this figure has no markers: add marker=\"CLIP, SECONDS, NAME\""
                                       : fmt::format("this figure has no such marker; it has {}",
                                                     fmt::join(all, ", ")));
  }
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
    {.name = "root",
     .kind = ValueKind::Words,
     .help = "the bone whose way along the ground, with its heading, moves the figure instead"},
    {.name = "marker",
     .kind = ValueKind::Words,
     .help =
         "\"CLIP, SECONDS, NAME\": when the clip passes this time, the figure posts the event `marker NAME`",
     .repeatable = true},
    {.name = "draw", .kind = ValueKind::Flag, .help = "whether it is visible", .standard = "on"},
    kObjectUnit,
    kObjectUp,
};

constexpr EventSpec kFigureEvents[] = {
    {"finished", "a clip that does not repeat has reached its end"},
    {"looped", "a clip that repeats has reached its end and restarts"},
    {kMarker, "a clip has passed this marker", "NAME"},
};

constexpr CommandSpec kFigureCommands[] = {
    {"play", ArgumentKind::Words, "play [CLIP [OPTION ...]]",
     "plays a clip of the model, with the options fade SECONDS, speed FACTOR, from SECONDS, once or loop; "
     "without a name it goes on after a pause"},
    {"layer", ArgumentKind::Words, "layer CLIP [OPTION ...]",
     "adds what a clip changes since its beginning to what is played, with the options of play and weight "
     "SHARE, "
     "from 0 to 1; up to four at a time"},
    {"unlayer", ArgumentKind::Words, "unlayer [CLIP] [fade SECONDS]",
     "fades out the layer of a clip, without a name all of them"},
    {"pause", ArgumentKind::None, "pause", "stands still in its present pose"},
    {"stop", ArgumentKind::None, "stop", "returns to its pose at rest, without layers"},
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
    .check = checkMarkers,
    .lint = lintModel,
};

namespace node_types {

void addFigureNode(NodeRegistrar& types) {
  types.add(kFigureType);
}

}  // namespace node_types

}  // namespace stadion
