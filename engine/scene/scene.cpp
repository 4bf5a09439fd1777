#include "engine/scene/scene.h"

#include "engine/scene/placed_node.h"

#include <algorithm>
#include <new>
#include <utility>

namespace stadion {

Scene::Scene(SceneLoader& loader, MeshStore& meshes, std::size_t threads)
    : loader_(loader), tree_(*this), requests_(loader), instances_(placements_, meshes, time_),
      lights_(placements_, tree_, loader), sounds_(placements_), feed_(placements_, poseTracks_, time_),
      degradation_(tree_, placements_, instances_, time_), schedule_(tree_, placements_, degradation_),
      impacts_(schedule_),
      publisher_(placements_, instances_, figures_, paints_, lights_, degradation_, feed_),
      workers_(threads) {}

// No node leaves: the scene is no longer looked at, and if a file broke off while it was installed, some of
// its nodes have not entered.
Scene::~Scene() {
  while (!tree_.loads().empty()) {
    std::unique_ptr<LoadedScene> gone = tree_.remove(tree_.loads().rbegin()->first);
    try {
      loader_.dispose(std::move(gone), 0);
    } catch (const std::bad_alloc&) {
      // It is destroyed here and now.
    }
  }
}

bool Scene::open(const std::string& file) {
  requests_.setScript(file);
  const std::uint32_t number = requestLoad(file, {}, 0);
  applyLoads({}, nullptr);
  return tree_.load(number) != nullptr;
}

void Scene::advance(const TimeSignature& now, const InputSample& input, ChangeSet& changes,
                    FrameProbe* probe) {
  counters_ = {};
  events_.clear();
  time_ = {now.frame, now.time, now.time - now.step};
  poseTracks_.clear();
  impacts_.beginFrame();
  applyLoads(now, probe);
  degradation_.apply(now);
  {
    const SpanScope span(probe, Span::Input);
    feed_.beginFrame();
  }
  visit(now, input, probe);
  applyUnloads(now, probe);
  {
    const SpanScope span(probe, Span::Input);
    feed_.endFrame(input);
  }
  hashes_.rehash(probe);
  const SpanScope span(probe, Span::Publish);
  if (events_.size() > 1) std::ranges::stable_sort(events_, {}, &EventRecord::when);  // it takes memory
  publish(now, input, changes);
  publisher_.follow(changes.viewer.headInWorld());
}

void Scene::publish(const TimeSignature& now, const InputSample& input, ChangeSet& changes) {
  publisher_.publish(now, input, changes);
  counters_.changesPublished += instances_.takePublished();
}

void Scene::publishAsItStands(const TimeSignature& now, ChangeSet& changes) {
  publish(now, feed_.lastInput(), changes);
}

void Scene::collectSounds(const InputSample& input, SoundScape& out) const {
  out.time = time_.now;
  out.X_WR = feed_.rigPose();
  out.X_WH = feed_.rigPose() * feed_.headInRig(input);
  sounds_.collect(out.sounds);
}

// Visiting.

/// Adds to the round all nodes that have something to do. Returns the mail, by target.
std::vector<Message> Scene::callRound(const TimeSignature& now) {
  std::vector<Message> mail = messages_.takeDue(now.time);
  schedule_.begin(*this);
  for (Message& m : mail) {
    m.target = tree_.resolveInside(m.target, m.targetInside);
    m.node = tree_.resolveInside(m.node, m.nodeInside);
  }
  // A message to a removed target is lost.
  std::erase_if(mail, [&](const Message& m) {
    const bool late = m.due > tree_.endOf(m.target.load);
    counters_.messagesLost += late;
    return late;
  });
  for (const Message& m : mail)
    if (schedule_.call(m.target))
      ++counters_.messagesDelivered;
    else
      ++counters_.messagesLost;
  schedule_.callDue(now.time);
  if (mail.size() > 1)
    std::stable_sort(mail.begin(), mail.end(),
                     [](const Message& a, const Message& b) { return a.target < b.target; });
  return mail;
}

void Scene::visit(const TimeSignature& now, const InputSample& input, FrameProbe* probe) {
  FrameContext frame{now, input, *this, false, probe};
  std::vector<Message> mail;
  std::vector<Detached> detached;
  {
    const SpanScope span(probe, Span::Mail);
    mail = callRound(now);
    detached = detachedBy(mail, frame);
    impacts_.setMayBegin(
        std::ranges::any_of(mail, [](const Message& m) { return m.command == CommandId::Start; }));
  }
  FrameProbe* const spans = probe && probe->wantsSpansOfVisits() ? probe : nullptr;
  const auto next = [&] {
    const SpanScope span(spans, Span::Mail);
    return takeBatch(mail, frame, spans);
  };
  while (next()) {
    batch_.size() == 1 ? batch_[0].node->compute(spans) : computeTogether(probe);
    for (const Cycle& cycle : batch_) {
      conclude(cycle, frame, spans);
      if (probe && !spans) probe->visited(cycle.node->self());
    }
  }
  schedule_.end();
  for (const Detached& d : detached) rejoinParent(d, frame);
}

void Scene::conclude(const Cycle& cycle, FrameContext& frame, FrameProbe* probe) {
  Node* node = cycle.node;
  schedule_.setCurrent(*node);
  FrameContext own = cycle.context(frame);
  node->conclude(own, probe);
  ++counters_.nodesVisited;
  const SpanScope span(probe, Span::Settle, node->self());
  schedule_.update(*node);
  hashes_.update(*node);
  schedule_.wakeWatchers();
}

void Scene::computeTogether(FrameProbe* probe) {
  const SpanScope span(probe, Span::Workers);
  workers_.run(batch_.size(), [&](std::size_t i) { batch_[i].node->compute(probe); });
}

/// Takes the next nodes of the round that do not look at each other's results, and begins their cycles. False
/// at the end of the round.
bool Scene::takeBatch(const std::vector<Message>& mail, FrameContext& frame, FrameProbe* probe) {
  batch_.clear();
  while (const VisitQueue::Entry* next = schedule_.next()) {
    Node& node = *next->node;
    if (std::ranges::any_of(batch_, [&](const Cycle& b) { return node.awaits(*b.node, *this); })) break;
    schedule_.take();
    const auto first = std::ranges::lower_bound(mail, node.self(), {}, &Message::target);
    const auto last = std::ranges::upper_bound(mail, node.self(), {}, &Message::target);
    batch_.push_back({&node, degradation_.turnOf(node, frame.now)});
    FrameContext own = batch_.back().context(frame);
    node.begin({first, last}, own, probe);
  }
  return !batch_.empty();
}

std::vector<Scene::Detached> Scene::detachedBy(const std::vector<Message>& mail, const FrameContext& frame) {
  std::vector<Detached> detached;
  for (const Message& m : mail) {
    const auto* node =
        m.command == CommandId::Detach ? dynamic_cast<const PlacedNode*>(find(m.target)) : nullptr;
    if (!node) continue;
    const PlacementId parent = placements_.parent(node->placement());
    detached.push_back({m.target, frame.effective(m), parent, poseOf(placements_.world(parent))});
  }
  return detached;
}

void Scene::rejoinParent(const Detached& d, const FrameContext& frame) {
  auto* node = dynamic_cast<PlacedNode*>(find(d.node));
  if (!node) return;
  Affine X_WP = placements_.world(d.parent);
  const PoseTrack track = poseTracks_.within(d.parent, d.X_WP, frame.start(), frame.now.time, placements_);
  if (!track.empty()) X_WP = withScale(poseOn(track, d.when, Limit::After), X_WP);
  node->rejoin(*this, X_WP);
}

// Messages.

/// A message with its names resolved as seen from `from`, as far as the first part of a path.
Message Scene::addressed(const std::string& target, NodeRef from, std::vector<std::string> arguments) const {
  Message m;
  m.target = tree_.resolveFirst(target, from, m.targetInside);
  if (!arguments.empty()) m.node = tree_.resolveFirst(arguments[0], from, m.nodeInside);
  m.arguments = std::move(arguments);
  return m;
}

void Scene::post(const Node& sender, const Notification& n, Nanoseconds when) {
  if (when > tree_.endOf(sender.self().load)) return;  // the sender is unloaded before
  Message m = addressed(n.target, sender.self(), n.arguments);
  m.due = when + n.delay;
  m.sender = sender.self();
  m.command = n.command;
  if (m.target.valid())
    messages_.post(std::move(m));
  else
    ++counters_.messagesLost;
}

bool Scene::command(const std::string& target, CommandId command, std::vector<std::string> arguments,
                    Nanoseconds when) {
  if (tree_.loads().empty()) return false;
  Message m = addressed(target, {tree_.loads().begin()->first, 0}, std::move(arguments));
  m.due = when;
  m.command = command;
  if (!m.target.valid()) return false;
  messages_.post(std::move(m));
  return true;
}

void Scene::note(NodeRef node, Event event, Nanoseconds when, std::optional<double> figure) {
  if (when > tree_.endOf(node.load)) return;
  events_.push_back({node, event, when, figure});
}

void Scene::warn(const Node& about, const std::string& what) {
  const LoadedScene* from = std::as_const(tree_).load(about.self().load);
  SourcePosition where;
  if (from) where.file = from->file;
  if (from && about.self().position < from->lines.size()) {
    where.line = from->lines[about.self().position];
    where.column = 1;
  }
  const std::string name = about.name().empty() ? std::string(about.type().name) : "\"" + about.name() + "\"";
  loader_.report({Severity::Warning, where, name + " " + what, {}});
}

void Scene::moveRig(const Pose& X_WR) {
  auto* node = feed_.rig().valid() ? dynamic_cast<PlacedNode*>(find(feed_.rig())) : nullptr;
  if (node)
    node->place(*this, toAffine(X_WR));
  else
    feed_.moveFreeRig(X_WR);
}

// Loads.

std::uint32_t Scene::requestLoad(const std::string& file, NodeRef owner, Nanoseconds at) {
  const auto* placed = owner.valid() ? dynamic_cast<const PlacedNode*>(find(owner)) : nullptr;
  return requests_.load(file, owner, placed ? placements_.world(placed->placement()) : Affine::Identity(),
                        at);
}

void Scene::requestUnload(std::uint32_t number, Nanoseconds at) {
  requests_.unload(number, at);
  if (!schedule_.inRound() || at > time_.now) return;
  // It goes in this very frame, and dynamics has not had its turn yet.
  requests_.announceUnloads(time_.now, tree_);
  schedule_.wakeLoadWatchers();
}

void Scene::applyLoads(const TimeSignature& now, FrameProbe* probe) {
  if (requests_.nonePending()) return;
  const SpanScope span(probe, Span::Loading);
  requests_.announceUnloads(now.time, tree_);
  // An installed load may request more: sub-scenes that are there from the start.
  while (const auto change = requests_.takeLoad(now)) {
    if (auto load = loader_.take(change->number))
      install(std::move(load), std::max(change->at, now.time - now.step));
    else
      requests_.forget(change->number);
  }
  requests_.announceUnloads(now.time, tree_);
}

void Scene::applyUnloads(const TimeSignature& now, FrameProbe* probe) {
  if (requests_.nonePending()) return;
  const SpanScope span(probe, Span::Loading);
  while (const auto change = requests_.takeUnload(now)) remove(change->number, now.frame);
}

void Scene::install(std::unique_ptr<LoadedScene> arrived, Nanoseconds at) {
  if (arrived->owner.valid() && (!find(arrived->owner) || tree_.endOf(arrived->owner.load) <= at)) {
    requests_.forget(arrived->number);
    loader_.dispose(std::move(arrived), 0);  // its scene node was removed
    return;
  }
  LoadedScene& load = tree_.install(std::move(arrived));
  load.since = at;
  const Nanoseconds frameEnd = std::exchange(time_.now, at);
  for (const std::uint32_t position : load.enterOrder) enterNode(*load.nodes[position]);
  time_.now = frameEnd;
  auto* owner = dynamic_cast<PlacedNode*>(load.owner.valid() ? find(load.owner) : nullptr);
  publisher_.showChunk(load);
  if (owner && !load.statics.empty()) owner->carryStatics();
  // If its scene node has moved since the request, all that was placed then follows it.
  const Affine X_WO = owner ? placements_.world(owner->placement()) : load.X_WO;
  const bool moved = owner && X_WO.matrix() != load.X_WO.matrix();
  // Objects that no chunk can show are shown one by one.
  if (!moved && (load.chunkShown || load.chunk == kNoChunk)) return;
  const Affine by = moved ? Affine(X_WO * load.X_WO.inverse()) : Affine::Identity();
  for (std::size_t i = 0; i < load.statics.size(); ++i)
    if (!load.nodes[load.statics[i].position]) tree_.promote(load, i, by);
}

void Scene::promoted(Node& node, const Affine& X_WN) {
  enterNode(node);
  node.placed()->setHome(*this, X_WN);
}

void Scene::enterNode(Node& node) {
  node.enter(*this);
  schedule_.update(node);
  hashes_.update(node);
}

void Scene::leaveNode(Node& node) {
  node.leave(*this);
  schedule_.remove(node);
  hashes_.remove(node);
}

void Scene::remove(std::uint32_t number, std::uint64_t frame) {
  LoadedScene* load = tree_.load(number);
  if (!load) return;
  // Loads that this load brought in go first.
  std::vector<std::uint32_t> inner;
  for (const auto& [n, l] : tree_.loads())
    if (l->owner.load == number) inner.push_back(n);
  for (auto n = inner.rbegin(); n != inner.rend(); ++n) remove(*n, frame);
  requests_.drop(number);
  for (auto p = load->enterOrder.rbegin(); p != load->enterOrder.rend(); ++p) leaveNode(*load->nodes[*p]);
  schedule_.updateBusy();
  hashes_.forget(number);
  publisher_.hideChunk(*load);
  std::unique_ptr<LoadedScene> gone = tree_.remove(number);
  schedule_.forget(number);
  degradation_.forget(number);
  requests_.forget(number);
  loader_.dispose(std::move(gone), frame);
}

// The state hash.

std::uint64_t Scene::stateHash() const {
  StateHash h(hashes_.sum());
  h.add(time_.now);
  h.add(feed_.freeRig());
  for (const auto& [number, l] : tree_.loads()) h.add(number);
  std::uint64_t pending = 0;
  for (const Message& m : messages_.pending()) {
    StateHash one(m.sequence);
    one.add(m.due);
    one.add(m.sender);
    one.add(m.target);
    one.add(static_cast<std::uint32_t>(m.command));
    for (const std::string& a : m.arguments) one.add(std::string_view(a));
    one.add(std::string_view(m.targetInside));
    one.add(std::string_view(m.nodeInside));
    pending += one.value();
  }
  h.add(pending);
  schedule_.hash(h);
  requests_.hash(h);
  degradation_.hash(h);
  return h.value();
}

}  // namespace stadion
