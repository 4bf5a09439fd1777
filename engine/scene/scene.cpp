#include "engine/scene/scene.h"

#include "engine/scene/object_node.h"
#include "engine/scene/placed_node.h"

#include <algorithm>
#include <cassert>

namespace stadion {

Scene::Scene(SceneLoader& loader, MeshStore& meshes, std::size_t threads)
    : loader_(loader), meshes_(meshes), crew_(threads) {}

// Nobody looks any more, so that no node takes leave: some may not even have been there, if a file broke off
// while it was installed.
Scene::~Scene() {
  while (!loads_.empty()) {
    const auto last = std::prev(loads_.end());
    std::unique_ptr<Load> gone = std::move(last->second);
    loads_.erase(last);
    try {
      loader_.dispose(std::move(gone), 0);
    } catch (const std::bad_alloc&) {
      // It goes here and now.
    }
  }
}

bool Scene::open(const std::string& file) {
  script_ = file;
  const std::uint32_t number = requestLoad(file, {}, 0);
  applyLoads({}, nullptr);
  return loads_.contains(number);
}

void Scene::advance(const TimeSignature& now, const InputSample& input, ChangeSet& changes,
                    FrameProbe* probe) {
  counters_ = {};
  events_.clear();
  now_ = now.time;
  frame_ = now.frame;
  frameStart_ = now.time - now.step;
  courses_.clear();
  impacts_.clear();
  applyLoads(now, probe);
  obey(now);
  {
    const SpanScope span(probe, Span::Input);
    rigStart_ = rigPose();
  }
  visit(now, input, probe);
  applyUnloads(now, probe);
  {
    const SpanScope span(probe, Span::Input);
    lastInput_ = input;
  }
  settleTouched(probe);
  const SpanScope span(probe, Span::Publish);
  if (events_.size() > 1) std::ranges::stable_sort(events_, {}, &EventRecord::when);  // it takes memory
  publish(now, input, changes);
  shadowPlaces_.follow(changes.viewer.headInWorld());
}

void Scene::settleTouched(FrameProbe* probe) {
  for (Node* node : touched_) {
    if (!node->standing().touched) continue;  // its own cycle came after it
    const SpanScope span(probe, Span::Settle, node->self());
    rehash(*node);
  }
  touched_.clear();
}

// Visiting.

/// Whom to visit in this round: the busy, those with mail, those whose alarm rings, those who were woken
/// after their turn. Returns the mail, by target.
std::vector<Message> Scene::callRound(const TimeSignature& now) {
  std::vector<Message> mail = messages_.takeDue(now.time);
  settleLevels();
  agenda_.begin();
  if (!reliefs_.empty()) agenda_.leaveOut([&](Node& node) { return putOff(node); });
  std::erase_if(putOff_, [&](NodeRef ref) {
    Node* node = find(ref);
    if (node && putOff(*node)) return false;
    wokenLate_.push_back(ref);  // its turn has come
    return true;
  });
  for (Message& m : mail) {
    m.target = resolveInside(m.target, m.targetInside);
    m.node = resolveInside(m.node, m.nodeInside);
  }
  // What is due after its target has gone finds nobody.
  std::erase_if(mail, [&](const Message& m) {
    const bool late = m.due > endOf(m.target.load);
    counters_.messagesLost += late;
    return late;
  });
  for (const Message& m : mail)
    callToRound(m.target) ? ++counters_.messagesDelivered : ++counters_.messagesLost;
  while (!wakes_.empty() && wakes_.begin()->at <= now.time) {
    callToRound(wakes_.begin()->node);
    wakes_.erase(wakes_.begin());
  }
  wokenBefore_.swap(wokenLate_);
  for (const NodeRef ref : wokenBefore_) callToRound(ref);
  wokenBefore_.clear();
  if (loadsTold_ != loadsVersion_)
    for (const NodeRef ref : loadWatchers_) callToRound(ref);
  loadsTold_ = loadsVersion_;
  agenda_.sort();
  wakeWatchers();
  if (mail.size() > 1)
    std::stable_sort(mail.begin(), mail.end(),
                     [](const Message& a, const Message& b) { return a.target < b.target; });
  return mail;
}

/// Nodes that look at each other's results come in that order. Which node moves what is known a round after
/// it has come.
void Scene::settleLevels() {
  if (levelsLoads_ == loadsVersion_ && levelsSettled_) return;
  levelsSettled_ = levelsLoads_ == loadsVersion_;
  levelsLoads_ = loadsVersion_;
  std::map<NodeRef, std::vector<NodeRef>> movers;
  for (const NodeRef ref : loadWatchers_)
    if (const Node* node = find(ref)) node->addMovers(*this, movers[ref]);
  std::erase_if(movers, [](const auto& entry) { return entry.second.empty(); });
  const auto reaches = [&](NodeRef from, NodeRef to) {
    std::set<NodeRef> seen{from};
    std::vector<NodeRef> open{from};
    while (!open.empty()) {
      const auto at = movers.find(open.back());
      open.pop_back();
      if (at == movers.end()) continue;
      for (const NodeRef next : at->second) {
        if (next == to) return true;
        if (seen.insert(next).second) open.push_back(next);
      }
    }
    return false;
  };
  // Where two look at each other, the one that comes first in the file does so here.
  std::vector<std::pair<NodeRef, NodeRef>> mutual;
  for (const auto& [ref, before] : movers)
    for (const NodeRef mover : before)
      if (ref < mover && reaches(mover, ref)) mutual.emplace_back(ref, mover);
  for (const auto& [ref, mover] : mutual) std::erase(movers[ref], mover);
  std::map<NodeRef, std::uint16_t> levels;
  const std::function<std::uint16_t(NodeRef)> levelOf = [&](NodeRef ref) {
    if (const auto known = levels.find(ref); known != levels.end()) return known->second;
    std::uint16_t level = 0;
    if (const auto at = movers.find(ref); at != movers.end())
      for (const NodeRef mover : at->second) level = std::max<std::uint16_t>(level, levelOf(mover) + 1);
    return levels[ref] = level;
  };
  bool changed = false;
  for (const NodeRef ref : loadWatchers_)
    if (Node* node = find(ref))
      changed |= std::exchange(node->standing().level, levelOf(ref)) != levelOf(ref);
  if (changed) agenda_.reorder();
}

bool Scene::callToRound(NodeRef ref) {
  Node* node = find(ref);
  if (node) agenda_.call(*node);
  return node != nullptr;
}

void Scene::visit(const TimeSignature& now, const InputSample& input, FrameProbe* probe) {
  FrameContext frame{now, input, *this, false, probe};
  std::vector<Message> mail;
  std::vector<Detached> detached;
  {
    const SpanScope span(probe, Span::Mail);
    mail = callRound(now);
    detached = detachedBy(mail, frame);
    startsInFrame_ = std::ranges::any_of(mail, [](const Message& m) { return m.verb == Verb::Start; });
  }
  const auto next = [&] {
    const SpanScope span(probe, Span::Mail);
    return takeBatch(mail, frame, probe);
  };
  while (next()) {
    computeTogether(batch_, probe);
    for (const Cycle& cycle : batch_) {
      Node* node = cycle.node;
      current_ = Visit::of(*node);
      FrameContext own = cycle.context(frame);
      node->conclude(own, probe);
      ++counters_.nodesVisited;
      const SpanScope span(probe, Span::Settle, node->self());
      setBusy(*node);
      rehash(*node);
      wakeWatchers();
    }
  }
  current_.reset();
  for (const Detached& d : detached) rejoinParent(d, frame);
}

void Scene::computeTogether(std::span<const Cycle> batch, FrameProbe* probe) {
  if (batch.size() == 1) return batch[0].node->compute(probe);
  const SpanScope span(probe, Span::Crew);
  crew_.run(batch.size(), [&](std::size_t i) { batch[i].node->compute(probe); });
}

/// The next nodes of this round that do not look at each other's results, each of them begun. False: no more.
bool Scene::takeBatch(const std::vector<Message>& mail, FrameContext& frame, FrameProbe* probe) {
  batch_.clear();
  while (const Agenda::Entry* next = agenda_.next()) {
    Node& node = *next->node;
    if (std::ranges::any_of(batch_, [&](const Cycle& b) { return node.awaits(*b.node, *this); })) break;
    current_ = next->visit;
    agenda_.take();
    const auto first = std::ranges::lower_bound(mail, node.self(), {}, &Message::target);
    const auto last = std::ranges::upper_bound(mail, node.self(), {}, &Message::target);
    batch_.push_back(cycleOf(node, frame.now));
    FrameContext own = batch_.back().context(frame);
    node.begin({first, last}, own, probe);
  }
  return !batch_.empty();
}

std::vector<Scene::Detached> Scene::detachedBy(const std::vector<Message>& mail, const FrameContext& frame) {
  std::vector<Detached> detached;
  for (const Message& m : mail) {
    const auto* node = m.verb == Verb::Detach ? dynamic_cast<const PlacedNode*>(find(m.target)) : nullptr;
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
  const Course way = courses_.within(d.parent, d.X_WP, frame.start(), frame.now.time, placements_);
  if (!way.empty()) X_WP = withScale(poseOn(way, d.when, Limit::After), X_WP);
  node->rejoin(*this, X_WP);
}

void Scene::wakeNow(NodeRef ref) {
  Node* node = find(ref);
  if (!node) return;
  const Visit v = Visit::of(*node);
  if (current_ && *current_ < v)
    agenda_.callNow(*node);
  else if (!current_ || *current_ != v)
    wokenLate_.push_back(ref);
}

void Scene::watch(PlacementId placement, NodeRef watcher) {
  watchers_.insert({placement, watcher});
  placements_.watch(placement);
}

void Scene::unwatch(PlacementId placement, NodeRef watcher) {
  const auto [first, last] = watchers_.equal_range(placement);
  for (auto at = first; at != last; ++at)
    if (at->second == watcher) {
      watchers_.erase(at);
      return;
    }
}

void Scene::wakeWatchers() {
  for (const PlacementId p : placements_.takeMovedWatched()) {
    const auto [first, last] = watchers_.equal_range(p);
    // A node that moves what it watches does not wake itself.
    for (auto at = first; at != last; ++at) {
      const NodeRef ref = at->second;
      if (current_ && current_->node == ref) continue;
      Node* node = reliefs_.empty() ? nullptr : find(ref);
      if (node && putOff(*node))
        putOff_.insert(ref);
      else
        wakeNow(ref);
    }
  }
}

void Scene::setBusy(Node& node) {
  agenda_.setBusy(node, node.busy());
}

void Scene::wakeAt(Nanoseconds when, NodeRef node) {
  wakes_.insert({when, node});
}

void Scene::unwatchImpacts(NodeRef body, NodeRef watcher) {
  const auto [first, last] = impactWatchers_.equal_range(body);
  const auto at = std::find_if(first, last, [&](const auto& w) { return w.second == watcher; });
  if (at != last) impactWatchers_.erase(at);
}

void Scene::noteImpact(const Impact& impact) {
  bool anybody = false;
  for (const NodeRef party : {impact.body, impact.other}) {
    const auto [first, last] = impactWatchers_.equal_range(party);
    for (auto w = first; w != last; ++w) wakeNow(w->second);
    anybody |= first != last;
  }
  if (anybody || startsInFrame_) impacts_.push_back(impact);
}

// Messages.

Message Scene::addressed(const std::string& target, NodeRef from, std::vector<std::string> arguments) const {
  Message m;
  const auto split = [&](const std::string& name, std::string& inside) {
    const std::size_t slash = name.find('/');
    if (slash != std::string::npos) inside = name.substr(slash + 1);
    return resolve(name.substr(0, slash), from);
  };
  m.target = split(target, m.targetInside);
  if (!arguments.empty()) m.node = split(arguments[0], m.nodeInside);
  m.arguments = std::move(arguments);
  return m;
}

void Scene::post(const Node& sender, const Notification& n, Nanoseconds when) {
  if (when > endOf(sender.self().load)) return;  // it is not there any more by then
  Message m = addressed(n.target, sender.self(), n.arguments);
  m.due = when + n.delay;
  m.sender = sender.self();
  m.verb = n.verb;
  if (m.target.valid())
    messages_.post(std::move(m));
  else
    ++counters_.messagesLost;
}

bool Scene::command(const std::string& target, Verb verb, std::vector<std::string> arguments,
                    Nanoseconds when) {
  if (loads_.empty()) return false;
  Message m = addressed(target, {loads_.begin()->first, 0}, std::move(arguments));
  m.due = when;
  m.verb = verb;
  if (!m.target.valid()) return false;
  messages_.post(std::move(m));
  return true;
}

void Scene::note(NodeRef node, Event event, Nanoseconds when, std::optional<double> figure) {
  if (when > endOf(node.load)) return;
  events_.push_back({node, event, when, figure});
}

void Scene::warn(const Node& about, const std::string& what) {
  const Load* from = load(about.self().load);
  SourcePosition where;
  if (from) where.file = from->file;
  if (from && about.self().position < from->lines.size())
    where.line = from->lines[about.self().position], where.column = 1;
  const std::string name = about.name().empty() ? std::string(about.type().name) : "\"" + about.name() + "\"";
  loader_.report({Severity::Warning, where, name + " " + what, {}});
}

// Names.

const Load* Scene::load(std::uint32_t number) const {
  const auto at = loads_.find(number);
  return at == loads_.end() ? nullptr : at->second.get();
}

Node* Scene::find(NodeRef ref) {
  const auto at = loads_.find(ref.load);
  if (at == loads_.end() || ref.position >= at->second->nodes.size()) return nullptr;
  Load& load = *at->second;
  if (load.nodes[ref.position]) return load.nodes[ref.position].get();
  const auto s = std::lower_bound(load.statics.begin(), load.statics.end(), ref.position,
                                  [](const StaticObject& o, std::uint32_t p) { return o.position < p; });
  if (s == load.statics.end() || s->position != ref.position) return nullptr;
  return promote(load, static_cast<std::size_t>(s - load.statics.begin()));
}

NodeRef Scene::resolve(const std::string& name, NodeRef from) const {
  const std::size_t slash = name.find('/');
  const std::string head = name.substr(0, slash);
  NodeRef found;
  for (const Load* l = load(from.load); l && !found.valid(); l = load(l->owner.load)) found = l->find(head);
  return slash == std::string::npos ? found : resolveInside(found, std::string_view(name).substr(slash + 1));
}

NodeRef Scene::resolveInside(NodeRef from, std::string_view path) const {
  NodeRef found = from;
  while (found.valid() && !path.empty()) {
    const std::size_t end = std::min(path.find('/'), path.size());
    const std::string part(path.substr(0, end));
    NodeRef inner;
    for (const auto& [number, l] : loads_)
      if (l->owner == found) inner = l->find(part);
    found = inner;
    path.remove_prefix(std::min(end + 1, path.size()));
  }
  return found;
}

PlacementId Scene::placementFor(NodeRef parent, NodeRef child) {
  if (!parent.valid()) {
    const Load* own = load(child.load);
    if (!own || !own->owner.valid()) return kWorldPlacement;
    parent = own->owner;
  }
  Node* above = find(parent);
  const PlacedNode* placed = above ? above->placed() : nullptr;
  return placed && placed->placement() != kNoPlacement ? placed->placement() : kWorldPlacement;
}

// The state hash.

std::uint64_t Scene::nodeHash(const Node& node) const {
  StateHash h((std::uint64_t{node.self().load} << 32) | node.self().position);
  node.hash(h);
  return h.value();
}

void Scene::rehash(Node& node) {
  // A sum over all nodes can be kept up by the change of one; each term knows its node's identity.
  const std::uint64_t now = nodeHash(node);
  hashSum_ += now - std::exchange(node.standing().hash, now);
  node.standing().touched = false;
}

std::uint64_t Scene::stateHash() const {
  StateHash h(hashSum_);
  h.add(now_);
  h.add(freeRig_);
  for (const auto& [number, l] : loads_) h.add(number);
  std::uint64_t pending = 0;
  for (const Message& m : messages_.pending()) {
    StateHash one(m.sequence);
    one.add(m.due), one.add(m.sender), one.add(m.target), one.add(static_cast<std::uint32_t>(m.verb));
    for (const std::string& a : m.arguments) one.add(std::string_view(a));
    one.add(std::string_view(m.targetInside)), one.add(std::string_view(m.nodeInside));
    pending += one.value();
  }
  h.add(pending);
  for (const Wake& w : wakes_) h.add(w.at), h.add(w.node);
  for (const Change& c : pendingLoads_) h.add(c.at), h.add(c.number), h.add(c.load);
  hashRelief(h);
  return h.value();
}

void Scene::forEachLoad(const std::function<void(const Load&)>& f) const {
  for (const auto& [number, l] : loads_) f(*l);
}

void Scene::forEachNode(const std::function<void(const Node&)>& f) const {
  for (const auto& [number, l] : loads_)
    for (const auto& node : l->nodes)
      if (node) f(*node);
}

}  // namespace stadion
