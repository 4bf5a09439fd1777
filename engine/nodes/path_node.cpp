#include "engine/nodes/path_node.h"

#include "engine/build/lint.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/core/shared_rows.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/scene/scene.h"
#include "engine/script/declaration_check.h"

#include <algorithm>

#include <fmt/format.h>

namespace stadion {
namespace {

/// The tangent at key k by finite differences over the neighbours' own times.
Vec3 tangent(const std::vector<Keyframe>& keys, std::size_t k) {
  const std::size_t before = k == 0 ? k : k - 1, after = std::min(k + 1, keys.size() - 1);
  return (keys[after].X_PN.p - keys[before].X_PN.p) / (keys[after].time - keys[before].time);
}

Vec3 hermite(const std::vector<Keyframe>& keys, std::size_t k, double s) {
  const double h = keys[k + 1].time - keys[k].time;
  const double s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * keys[k].X_PN.p + (s3 - 2 * s2 + s) * h * tangent(keys, k) +
         (-2 * s3 + 3 * s2) * keys[k + 1].X_PN.p + (s3 - s2) * h * tangent(keys, k + 1);
}

}  // namespace

Pose PathNode::poseAt(double seconds) const {
  if (keys_.size() == 1 || seconds <= keys_.front().time) return keys_.front().X_PN;
  if (seconds >= keys_.back().time) return keys_.back().X_PN;
  const auto after = std::upper_bound(keys_.begin(), keys_.end(), seconds,
                                      [](double t, const Keyframe& key) { return t < key.time; });
  const auto k = static_cast<std::size_t>(after - keys_.begin()) - 1;
  const double s = (seconds - keys_[k].time) / (keys_[k + 1].time - keys_[k].time);
  Pose X = det::interpolate(keys_[k].X_PN, keys_[k + 1].X_PN, s);
  if (smooth_) X.p = hermite(keys_, k, s);
  return X;
}

/// Whether it is ever anything but straight ways.
bool PathNode::bends() const {
  const auto turned = [&](const Keyframe& key) {
    return key.X_PN.q.coeffs() != keys_.front().X_PN.q.coeffs();
  };
  return smooth_ || std::ranges::any_of(keys_, turned);
}

/// What it moves; null if that is not there or moves itself.
PlacedNode* PathNode::target(Scene& scene) {
  Node* node = target_.valid() ? scene.find(target_) : this;
  PlacedNode* placed = node ? node->placed() : nullptr;
  return placed && !placed->isMovedFromOutside() ? placed : nullptr;
}

/// Reports the target's motion from since_ on to the nodes that watch it.
void PathNode::trace(Nanoseconds to, FrameContext& frame) {
  const PlacedNode* placed = target(frame.scene);
  const Placements& placements = frame.scene.placements();
  // In its first frame it reports always: watchers may not have registered yet.
  if (!placed || to <= since_ || (putAt_ && !placements.watchedBelow(placed->placement()))) return;
  const PlacementId id = placed->placement(), up = placements.parent(id);
  const auto at = [&](Nanoseconds time, double seconds) {
    const Pose X_WP = frame.scene.poseTracks().at(up, time, placements);
    return poseOf(withScale(X_WP, placements.world(up)) * toAffine(poseAt(seconds)));
  };
  const Pose begin = at(since_, toSeconds(elapsed_));
  const bool goesOn = putAt_ == since_;
  PoseTrack& way =
      frame.scene.poseTracks().of(id, {frame.start(), goesOn ? begin : poseOf(placements.world(id)), false});
  const Nanoseconds pass = std::max<Nanoseconds>(length(), 1);
  // Makes up for missed frames without the turns. After a restart of the path it jumps to the start.
  if (since_ < frame.start()) {
    const Nanoseconds end = elapsed_ + (to - since_);
    const bool again = loop_ && end >= pass;
    way.push_back({to, at(to, toSeconds(loop_ ? end % pass : end)), again || to == frame.start()});
    return;
  }
  if (!goesOn) way.push_back({since_, begin, true});
  // Where it may turn: on the grid, at keys, and where a pass ends.
  std::vector<Nanoseconds>& passed = passed_;
  passed.clear();
  const Nanoseconds span = loop_ ? to - since_ : std::min(to - since_, length() - elapsed_);
  const bool bends = bends_ || frame.scene.poseTracks().bends(up, placements);
  if (bends)
    for (Nanoseconds t = (since_ / kChord + 1) * kChord - since_; t < span; t += kChord) passed.push_back(t);
  for (Nanoseconds base = -elapsed_; base < span; base += pass) {
    auto key =
        std::ranges::upper_bound(keys_, -base, {}, [](const Keyframe& k) { return fromSeconds(k.time); });
    for (; key != keys_.end() && base + fromSeconds(key->time) < span; ++key)
      passed.push_back(base + fromSeconds(key->time));
    if (!loop_) break;
  }
  if (bends) {
    std::vector<Nanoseconds> knots;
    frame.scene.poseTracks().addKnots(up, placements, knots);
    for (const Nanoseconds t : knots)
      if (t > since_ && t - since_ < span) passed.push_back(t - since_);
  }
  passed.push_back(span);
  std::ranges::sort(passed);
  passed.erase(std::unique(passed.begin(), passed.end()), passed.end());
  const auto inPass = [&](Nanoseconds t) { return (elapsed_ + t - 1) % pass + 1; };  // its end included
  const auto after = [&](Nanoseconds t) {
    return at(since_ + t, toSeconds(loop_ ? inPass(t) : elapsed_ + t));
  };
  Nanoseconds before = 0;
  for (const Nanoseconds t : passed) {
    const bool curved = bends && !frame.scene.poseTracks().jumps(up, since_ + before, since_ + t, placements);
    way.push_back({since_ + t, after(t), false, curved ? poseBetween(before, t, after) : std::nullopt});
    if (loop_ && inPass(t) == pass) way.push_back({since_ + t, at(since_ + t, 0), true});
    before = t;
  }
}

/// It is put where the path is now.
void PathNode::jump(Nanoseconds when, FrameContext& frame) {
  const PlacedNode* placed = target(frame.scene);
  if (!placed) return;
  const Placements& placements = frame.scene.placements();
  PoseTrack* way = nullptr;
  if (placements.watchedBelow(placed->placement()))
    way = &frame.scene.poseTracks().of(placed->placement(),
                                       {frame.start(), poseOf(placements.world(placed->placement())), false});
  putTarget(frame.scene);
  if (way) way->push_back({when, poseOf(placements.world(placed->placement())), true});
}

void PathNode::putTarget(Scene& scene) {
  if (PlacedNode* placed = target(scene)) {
    const PlacementId up = scene.placements().parent(placed->placement());
    Affine X_PN = toAffine(poseAt(toSeconds(elapsed_)));
    X_PN.linear() = X_PN.linear() * placed->attributes().X_PN.linear().colwise().norm().asDiagonal();
    placed->place(scene, scene.placements().world(up) * X_PN);
    putAt_ = since_;
  }
}

void PathNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  since_ = scene.now();
}

void PathNode::restUntil(Nanoseconds time) {
  if (since_ >= time) return;
  if (putAt_ == since_) putAt_ = time;
  since_ = time;
}

// Reports each pass that it has missed; time that does not count has none.
bool PathNode::resume(Scene& scene) {
  const Nanoseconds now = scene.now();
  if (elapsed_ < 0 || elapsed_ > length() || since_ < 0 || since_ > now) return false;
  const bool repeats = loop_ && switch_.on() && scheduleState().missed != Missed::Time;
  return !repeats || (now - since_) / std::max<Nanoseconds>(length(), 1) <= kMostPasses;
}

void PathNode::advanceTo(Nanoseconds time, FrameContext& frame) {
  if (frame.rested) restUntil(frame.start());
  if (switch_.on()) {
    trace(time, frame);
    elapsed_ += time - since_;
  }
  since_ = time;
  if (!switch_.on() || elapsed_ < length()) return;
  if (loop_) {
    for (; elapsed_ >= length(); elapsed_ -= length()) raise("finished", time - (elapsed_ - length()));
    return;
  }
  raise("finished", time - (elapsed_ - length()));
  elapsed_ = length();
  switch_.set(false);
}

void PathNode::receive(const Message& m, FrameContext& frame) {
  PlacedNode::receive(m, frame);
  // What has passed up to the command still counts.
  const bool moved = switch_.on();
  advanceTo(frame.effective(m), frame);
  const bool before = switch_.on();
  if (switch_.apply(m)) {
    const bool again = !before && switch_.on() && elapsed_ >= length();
    if (again || m.command == CommandId::Reset) elapsed_ = 0;
  }
  // Once it is off, no other call places the target where it is at this time.
  if (m.command == CommandId::Reset)
    jump(frame.effective(m), frame);
  else if (moved && !switch_.on())
    putTarget(frame.scene);
}

void PathNode::simulate(FrameContext& frame) {
  PlacedNode::simulate(frame);
  if (!switch_.on()) return;
  advanceTo(frame.now.time, frame);
  putTarget(frame.scene);
}

template <class Self, class Fields>
void PathNode::fields(Self& self, Fields& f) {
  PlacedNode::fields(self, f);
  f("switch", self.switch_), f("elapsed", self.elapsed_), f("since", self.since_);
  f.unhashed("put", self.putAt_);
}

void PathNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void PathNode::state(StateFields& f) {
  fields(*this, f);
}

namespace {

std::unique_ptr<Node> makePath(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  std::vector<Keyframe> keys;
  for (const PathKey& k : d.keys()) {
    const Vec3 turn = k.orientation * kDegree;
    keys.push_back({k.time, {k.position, det::fromEuler(turn.x(), turn.y(), turn.z())}});
  }
  const auto target = d.reference("target");
  return std::make_unique<PathNode>(r.self, r.name, r.place, target ? r.resolve(*target) : NodeRef{},
                                    std::move(keys), d.flag("loop"), d.flag("smooth"), d.flag("initstate"));
}

/// Keys follow each other in time.
void checkPath(DeclarationCheck& check) {
  constexpr double kShortestPass = 0.001;  // of a looping path, which tells the end of each pass [s]
  const auto keys = check.declaration().keys();
  const auto places = check.places("key");
  if (places.size() != keys.size()) return;  // a key was wrong by itself
  for (std::size_t i = 1; i < keys.size(); ++i)
    if (!(keys[i].time > keys[i - 1].time))
      return check.errorAt(places[i], fmt::format("the times of keys must increase, but {} follows {}",
                                                  keys[i].time, keys[i - 1].time));
  if (!keys.empty() && keys.back().time > 0 && keys.back().time < kShortestPass &&
      check.declaration().flag("loop"))
    check.errorAt(places.back(), fmt::format("a path that loops must last at least {} s", kShortestPass));
}

/// From key to key a path turns the shorter way round.
void lintTurns(const Declaration& node, LintScope& scope) {
  const auto keys = node.keys();
  for (std::size_t i = 1; i < keys.size(); ++i) {
    const double turn = (keys[i].orientation - keys[i - 1].orientation).cwiseAbs().maxCoeff();
    if (turn < 180) continue;
    scope.warn(
        node, "key",
        fmt::format("from {} s to {} s the keys turn by {:g} degrees, but a path turns the shorter way from "
                    "key to key: put keys between them, less than 180 degrees apart",
                    keys[i - 1].time, keys[i].time, turn));
    return;
  }
}

void lintPath(const Declaration& node, LintScope& scope) {
  lintTargets(node, scope);
  lintTurns(node, scope);
  scope.warnNeverOn(node);
}

constexpr AttributeSpec kPathRows[] = {
    {.name = "target",
     .kind = ValueKind::Reference,
     .help = "the node to move; without it, the path moves the nodes that have it as parent",
     .targets = kPlacedOrRig,
     .acts = true},
    {.name = "key",
     .kind = ValueKind::Key,
     .help = "time, position, orientation; times must increase",
     .unit = "s, m, degrees",
     .range = kPlaceRange,
     .required = true,
     .repeatable = true},
    {.name = "loop",
     .kind = ValueKind::Flag,
     .help = "whether it starts again at its end",
     .standard = "off"},
    {.name = "smooth",
     .kind = ValueKind::Flag,
     .help = "whether it passes the keys in a curve rather than in straight lines",
     .standard = "off"},
    kInitStateRow,
};

constexpr EventSpec kPathEvents[] = {
    {"finished",
     "the path has reached its last key, the sound its end; told at the end of each pass if it loops"}};

}  // namespace

constinit const NodeType kPathType{
    .name = "path",
    .help = "moves a node along keys given in advance",
    .attributes = kPathRows,
    .events = kPathEvents,
    .traits = {Trait::Placed, Trait::Switched, Trait::Parent, Trait::Level, Trait::Moves, Trait::Degradable},
    .make = makePath,
    .check = checkPath,
    .lint = lintPath,
};

namespace node_types {

void addPathNode(NodeRegistrar& types) {
  types.add(kPathType);
}

}  // namespace node_types

}  // namespace stadion
