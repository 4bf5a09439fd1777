#include "pipeline/cluster/cluster_leader.h"

#include "engine/plain_text/text_line.h"
#include "pipeline/cluster/session_rules.h"
#include "pipeline/platform/scoped_realtime_priority.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace stadion::cluster {
namespace {

constexpr std::size_t kHashesKept = 64, kMostEarly = kHashesKept * ClusterFile::kMostNodes;
constexpr std::chrono::milliseconds kSearch{1500};  ///< time to discover other hosts
constexpr std::chrono::seconds kGiving{5};          ///< limit for a host that sends its scene
constexpr std::chrono::seconds kReturn{5};          ///< limit for a continued show that waits for the others
constexpr std::chrono::seconds kLately{10};         ///< a host that crashed so recently may be on its way
                                                    ///< back

std::uint32_t bit(std::size_t node) {
  return std::uint32_t{1} << node;
}

}  // namespace

/// The show's input, which is sent to all hosts.
class ClusterLeader::SampledInput final : public InputDevice {
public:
  SampledInput(InputDevice& inner, ClusterLeader& lead) : inner_(inner), lead_(lead) {}
  void sampleAt(Nanoseconds showTime, InputSample& sample) override {
    inner_.sampleAt(showTime, sample);
    lead_.send(&sample);
  }
  void sampleFrame(Nanoseconds start, Nanoseconds end, InputSample& sample) override {
    inner_.sampleFrame(start, end, sample);
    lead_.send(&sample);
  }
  bool sampleNow(InputSample& sample) override {
    const bool sampled = inner_.sampleNow(sample);
    lead_.send(sampled ? &sample : nullptr);
    return sampled;
  }
  void freezeHead(bool frozen) override { inner_.freezeHead(frozen); }
  Nanoseconds end() const override { return inner_.end(); }

private:
  InputDevice& inner_;
  ClusterLeader& lead_;
};

ClusterLeader::ClusterLeader(LeaderOptions options, std::uint64_t session)
    : options_(std::move(options)), followers_(options_.cluster.nodes.size()), words_(followers_.size()) {
  session_.number = std::max(session, options_.above + 1);
  session_.compatibility = written(options_.key);
  session_.giver = kNoNode;
}

Result<std::unique_ptr<ClusterLeader>> ClusterLeader::open(LeaderOptions options) {
  std::unique_ptr<ClusterLeader> lead(new ClusterLeader(std::move(options), anyNumber()));
  auto bus = Bus::open(lead->options_.cluster, *lead);
  if (!bus) return bus.error();
  lead->bus_ = std::move(bus.value());
  lead->stats_.barrier.makeRoom();
  lead->sender_ = std::thread([self = lead.get()] { self->sendTransfers(); });
  return lead;
}

std::unique_ptr<ClusterLeader> ClusterLeader::unconnected(LeaderOptions options, std::uint64_t session) {
  std::unique_ptr<ClusterLeader> lead(new ClusterLeader(std::move(options), session));
  lead->bus_ = Bus::none();
  return lead;
}

ClusterLeader::~ClusterLeader() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  if (sender_.joinable()) sender_.join();
  if (bus_) bus_->close();  // stops all calls, which still use bus_
}

InputDevice& ClusterLeader::input(InputDevice& inner) {
  input_ = std::make_unique<SampledInput>(inner, *this);
  return *input_;
}

// Expects the lock. Returns which of those hosts has come farthest in this show.
std::optional<std::size_t> ClusterLeader::newestOf(std::uint32_t nodes) const {
  std::optional<std::size_t> best;
  const auto at = [this](std::size_t node) {
    return std::pair(followers_[node].plays, followers_[node].serial);
  };
  for (std::size_t node = 0; node < followers_.size(); ++node) {
    const Follower& f = followers_[node];
    if ((nodes & bit(node)) == 0 || f.plays == 0 || f.show != options_.key.show()) continue;
    if (!best || at(node) > at(*best)) best = node;
  }
  return best;
}

// Another leader is discovered no later than its followers. Until then we stay silent: its followers would
// take us for the leader that they have lost. Meanwhile they announce how far they have come.
std::optional<ShowUnderWay> ClusterLeader::takeOver() {
  std::unique_lock lock(mutex_);
  const auto wait = [&](Clock::time_point until, const auto& ready) {
    while (!ready() && Clock::now() < until && waits()) changed_.wait_for(lock, kPollInterval);
  };
  const auto allAreNew = [&] {
    return std::ranges::count(followers_, 0U, &Follower::incarnation) == 1 &&  // it is this program
           std::ranges::count(followers_, 0U, &Follower::plays) == std::ssize(followers_);
  };
  wait(Clock::now() + kSearch, allAreNew);
  // Independent of our clock: a later session always has a higher number.
  for (const Follower& f : followers_)
    session_.number = std::max({session_.number, f.session + 1, f.plays + 1});
  std::uint32_t untried = ~std::uint32_t{0};
  for (auto node = newestOf(untried); node && !double_; node = newestOf(untried)) {
    untried &= ~bit(*node);
    const Follower& f = followers_[*node];
    session_.resumes = f.plays;
    session_.giver = static_cast<std::uint8_t>(*node);
    bus_->send(session_);
    wait(Clock::now() + kGiving, [&] { return incoming_.complete() || f.plays == 0; });
    if (!incoming_.complete()) continue;
    SceneTransfer transfer = incoming_.take();
    if (!isTime(transfer.time)) continue;
    session_.giver = kNoNode;
    pending_.signature.frame = transfer.frame;
    pending_.signature.time = transfer.time;
    pending_.standsAfter = transfer.still;
    pending_.presentation = transfer.presentation;
    options_.tell(
        fmt::format("the show goes on after frame {}, with the scene of {}", transfer.frame, nameOf(*node)));
    return ShowUnderWay{pending_.signature,
                        std::make_shared<const std::vector<std::uint8_t>>(std::move(transfer.scene.bytes)),
                        transfer.scene.files, transfer.still, transfer.presentation};
  }
  if (session_.resumes != 0 && !double_)
    options_.tell("the others play, but none sends its scene: the show restarts");
  session_.resumes = 0;
  session_.giver = kNoNode;
  return {};
}

std::vector<HostState> ClusterLeader::hosts() const {
  using Is = HostState::Is;
  const std::lock_guard lock(mutex_);
  std::vector<HostState> hosts;
  for (std::size_t i = 0; i < followers_.size(); ++i) {
    const Follower& f = followers_[i];
    const Is is = i == options_.cluster.lead ? Is::Leads
                  : f.member                 ? Is::Plays
                  : f.incarnation != 0       ? Is::Joins
                                             : Is::Absent;
    hosts.push_back({nameOf(i), is, f.differs});
  }
  return hosts;
}

ClusterStats ClusterLeader::stats() const {
  const std::lock_guard lock(mutex_);
  return stats_;
}

std::uint64_t ClusterLeader::session() const {
  const std::lock_guard lock(mutex_);
  return session_.number;
}

bool ClusterLeader::hasBegun() const {
  const std::lock_guard lock(mutex_);
  return session_.begun;
}

// Expects the lock.
std::vector<std::string> ClusterLeader::missing() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < followers_.size(); ++i) {
    if (i == options_.cluster.lead || followers_[i].phase == Phase::Ready) continue;
    if ((options_.expected & bit(i)) != 0 || followers_[i].incarnation != 0) names.push_back(nameOf(i));
  }
  return names;
}

std::uint32_t ClusterLeader::played() const {
  const std::lock_guard lock(mutex_);
  return played_;
}

bool ClusterLeader::begin(double rate, const OperatorDecision& operators) {
  std::unique_lock lock(mutex_);
  if (double_) return true;
  session_.rate = rate;
  bus_->send(session_);
  const auto start = Clock::now();
  const std::chrono::seconds patience = session_.resumes != 0 ? kReturn : options_.patience;
  for (bool told = false; !missing().empty() && Clock::now() < start + patience && waits();) {
    const WaitDecision his = operators(told);
    if (his == WaitDecision::GivesUp) return false;
    if (his == WaitDecision::Ends) break;
    if (!told && Clock::now() > start + kLongWait) {
      told = true;
      options_.tell(fmt::format("waiting for {}, {} s at most; Start begins without",
                                fmt::join(missing(), ", "), patience.count()));
    }
    lock.unlock();
    answerRequests();
    lock.lock();
    changed_.wait_for(lock, kPollInterval);
  }
  if (double_) return true;
  if (const auto names = missing(); !names.empty() && !options_.stop())
    options_.tell(fmt::format("the show {} without {}", session_.resumes != 0 ? "goes on" : "begins",
                              fmt::join(names, ", ")));
  session_.begun = true;
  bus_->send(session_);
  return true;
}

// The order goes out with its input, which App takes next.
void ClusterLeader::issue(FrameOrder& order) {
  answerRequests();
  const std::lock_guard lock(mutex_);
  order.last = order.last || stop_ || double_;
  pending_ = order;
  awaitsInput_ = true;
}

void ClusterLeader::send(const InputSample* input) {
  const ScopedRealtimePriority prompt;  // others wait while it holds the lock
  const std::lock_guard lock(mutex_);
  if (!awaitsInput_) return;
  awaitsInput_ = false;
  std::uint32_t members = 0;
  for (std::size_t i = 0; i < followers_.size(); ++i)
    if (followers_[i].member) members |= bit(i);
  epochs_.push_back({++serial_, pending_.signature.frame, members, {}});
  bus_->send(
      written_.write({session_.number, serial_, members, std::exchange(explain_, 0)}, pending_, input));
  const std::uint64_t bytes = written_.bytes();
  ++stats_.orders;
  stats_.orderBytes += bytes;
  stats_.mostOrderBytes = std::max(stats_.mostOrderBytes, bytes);
}

// Runs between two frames: the scene is as it was after the previous order.
void ClusterLeader::answerRequests() {
  std::vector<std::uint64_t> asking;
  SceneTransfer transfer;
  {
    const std::lock_guard lock(mutex_);
    transfer.session = session_.number;
    transfer.serial = serial_;
    transfer.frame = pending_.signature.frame;
    transfer.time = pending_.signature.time;
    transfer.still = pending_.standsAfter;
    transfer.presentation = pending_.presentation;
    const bool underWay = serial_ > 0 || session_.resumes != 0;
    for (std::size_t i = 0; i < followers_.size() && underWay; ++i) {
      Follower& f = followers_[i];
      if (!std::exchange(f.asks, false)) continue;
      asking.push_back(f.incarnation);
      if (f.differs) explain_ |= bit(i);
    }
  }
  if (asking.empty() || !save_) return;
  transfer.scene = save_();
  {
    const std::lock_guard lock(mutex_);
    for (const std::uint64_t to : asking) {
      transfer.to = to;
      transfers_.push_back(transfer);
    }
  }
  changed_.notify_all();
}

// Runs on a thread of its own, because a state may be large.
void ClusterLeader::sendTransfers() {
  for (std::unique_lock lock(mutex_); !ending_;) {
    if (transfers_.empty()) {
      changed_.wait(lock);
      continue;
    }
    const SceneTransfer transfer = std::move(transfers_.front());
    transfers_.pop_front();
    lock.unlock();
    cluster::send(*bus_, transfer);
    lock.lock();
  }
}

bool ClusterLeader::mayShow(const TimeSignature&) {
  const ScopedRealtimePriority prompt;
  std::unique_lock lock(mutex_);
  const std::uint64_t serial = ++shown_;
  const auto at = std::ranges::find(epochs_, serial, &OrderEpoch::serial);
  if (at == epochs_.end()) return false;
  const auto drawn = Clock::now();
  at->drawnHere = drawn;
  const bool latest = at->awaited == 0;
  if (latest) latest_ = static_cast<std::uint8_t>(options_.cluster.lead);
  release();
  while (go_ < serial && waits()) {
    changed_.wait_for(lock, kPollInterval);
    leaveOutStuckFollowers();
  }
  if (latest) stats_.barrier.add(std::chrono::duration<double, std::milli>(Clock::now() - drawn).count());
  return go_ >= serial && !double_;
}

// Expects the lock. A host that lives but does not draw what all others have drawn would hold them forever.
void ClusterLeader::leaveOutStuckFollowers() {
  if (epochs_.empty() || !epochs_.front().drawnHere) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - *epochs_.front().drawnHere).count();
  if (seconds < kStuck * options_.cluster.deadline) return;
  const std::uint32_t awaited = epochs_.front().awaited;
  for (std::size_t i = 0; i < followers_.size(); ++i)
    if ((awaited & bit(i)) != 0)
      leaveOut(i, fmt::format("lives, but has drawn nothing for {:.1f} s", seconds));
}

// Expects the lock. Lets all hosts show what all have drawn.
void ClusterLeader::release() {
  bool released = false;
  while (!epochs_.empty() && epochs_.front().awaited == 0 && epochs_.front().drawnHere) {
    go_ = epochs_.front().serial;
    session_.shown = epochs_.front().frame + 1;
    epochs_.pop_front();
    released = true;
  }
  if (!released) return;
  bus_->send(Go{session_.number, go_, latest_});
  changed_.notify_all();
}

void ClusterLeader::receive(const Session& other) {
  {
    const std::lock_guard lock(mutex_);
    if (other.over || other.number == session_.number || double_) return;
    if (!supersedes(other, session_)) {
      // Our followers may have heard the other leader last. If our show is over, they are the other's.
      if (session_.rate > 0 && !session_.over) bus_->send(session_);
      return;
    }
    double_ = true;
    options_.tell(
        other.compatibility.cluster == options_.key.cluster
            ? fmt::format("another program leads as {} already; this one ends", nameOf(options_.cluster.lead))
            : inTheWay(options_.cluster));
  }
  changed_.notify_all();
}

bool ClusterLeader::hasDouble() const {
  const std::lock_guard lock(mutex_);
  return double_;
}

void ClusterLeader::receive(const Presence& p) {
  std::unique_lock lock(mutex_);
  if (p.node >= followers_.size() || p.node == options_.cluster.lead) return;
  if (p.cluster != options_.key.cluster) return;  // another check tells it that its cluster file differs
  Follower& f = followers_[p.node];
  // Another leader that has just started may end at once, because we lead.
  if (f.member && f.incarnation != p.incarnation && static_cast<Phase>(p.phase) == Phase::Waiting) return;
  // A host that is discovered again repeats its last sample, which may be out of date.
  Word& word = words_[p.node];
  if (word.incarnation == p.incarnation && p.count <= word.count) return;
  word.incarnation = p.incarnation;
  word.count = p.count;
  if (f.incarnation != p.incarnation) {
    if (f.member) leaveOut(p.node, "restarted");
    f = {};
    f.incarnation = p.incarnation;
  }
  f.session = p.session;
  f.plays = p.plays;
  f.serial = p.serial;
  f.show = p.show;
  f.phase = p.session == session_.number ? static_cast<Phase>(p.phase) : Phase::Waiting;
  f.asks = f.phase == Phase::Asking || (f.asks && f.differs && f.phase == Phase::Ready);
  if (f.member && f.phase == Phase::Leaving) {
    if (!pending_.last) leaveOut(p.node, "plays no longer");
    letGo(p.node);
  }
  if (f.phase == Phase::Ready && !f.member) {
    f.member = true;
    ++stats_.joined;
    if (session_.begun) options_.tell(fmt::format("{} plays with us", nameOf(p.node)));
  }
  lock.unlock();
  changed_.notify_all();
}

void ClusterLeader::receive(const Drawn& d) {
  const std::lock_guard lock(mutex_);
  if (d.session != session_.number || d.node >= followers_.size()) return;
  const auto at = std::ranges::find(epochs_, d.serial, &OrderEpoch::serial);
  if (at == epochs_.end()) {
    if (d.serial <= go_) bus_->send(Go{session_.number, go_, latest_});  // it has not received permission yet
    return;
  }
  at->awaited &= ~bit(d.node);
  latest_ = d.node;
  release();
}

void ClusterLeader::receive(const StatePart& part) {
  {
    const std::lock_guard lock(mutex_);
    if (part.to == session_.number) incoming_.add(part);
  }
  changed_.notify_all();
}

void ClusterLeader::left(std::uint8_t node, std::uint64_t incarnation) {
  const std::lock_guard lock(mutex_);
  if (node >= followers_.size() || node == options_.cluster.lead) return;
  if (followers_[node].incarnation != incarnation) return;  // another program is this host now
  if (followers_[node].member && !pending_.last)
    leaveOut(node, fmt::format("has not been heard of for {:g} s", options_.cluster.deadline));
  letGo(node);  // when the show is over, hosts leave, and no message is needed
  followers_[node] = {};
  changed_.notify_all();
}

// Expects the lock.
void ClusterLeader::leaveOut(std::size_t node, const std::string& why) {
  ++stats_.leftOut;
  options_.tell(fmt::format("{} {}; the others go on", nameOf(node), why));
  letGo(node);
}

// Expects the lock. Stops waiting for the host.
void ClusterLeader::letGo(std::size_t node) {
  if (std::exchange(followers_[node].member, false)) words_[node].gone = Clock::now();
  for (OrderEpoch& epoch : epochs_) epoch.awaited &= ~bit(node);
  release();
}

void ClusterLeader::simulated(std::uint64_t frame, std::uint64_t digest) {
  const ScopedRealtimePriority prompt;  // others wait while it holds the lock
  const std::lock_guard lock(mutex_);
  hashes_.emplace_back(frame, digest);
  if (hashes_.size() > kHashesKept) hashes_.pop_front();
  for (const SceneHash& early : early_)
    if (early.frame == frame) compare(early.node, frame, early.hash);
  std::erase_if(early_, [&](const SceneHash& h) { return h.frame <= frame; });
}

void ClusterLeader::receive(const SceneHash& h) {
  const std::lock_guard lock(mutex_);
  if (h.session != session_.number || h.node >= followers_.size()) return;
  const auto ours = std::ranges::find(hashes_, h.frame, &std::pair<std::uint64_t, std::uint64_t>::first);
  if (ours != hashes_.end())
    compare(h.node, h.frame, h.hash);
  else if (early_.size() < kMostEarly && (hashes_.empty() || h.frame > hashes_.back().first))
    early_.push_back(h);
}

// Expects the lock.
void ClusterLeader::compare(std::size_t node, std::uint64_t frame, std::uint64_t hash) {
  const auto ours = std::ranges::find(hashes_, frame, &std::pair<std::uint64_t, std::uint64_t>::first);
  ++stats_.compared;
  if (ours == hashes_.end() || ours->second == hash) return;
  ++stats_.differed;
  if (std::exchange(followers_[node].differs, true)) return;
  followers_[node].asks = true;
  options_.tell(
      fmt::format("the scene of {} differs from ours since frame {} at the latest ({:016x}, {:016x})",
                  nameOf(node), frame, hash, ours->second));
}

void ClusterLeader::receive(const Difference& d) {
  const std::lock_guard lock(mutex_);
  if (d.session != session_.number || d.node >= followers_.size()) return;
  if (d.found)
    options_.tell(fmt::format("the scene of {} differs from ours after frame {}: {} is {} there and {} here",
                              nameOf(d.node), d.frame, printable(d.where, kMaxRemoteText),
                              printable(d.here, kMaxRemoteText), printable(d.there, kMaxRemoteText)));
  else
    options_.tell(fmt::format("the scene of {} is like ours after frame {}", nameOf(d.node), d.frame));
  followers_[d.node].differs = d.found;  // a later difference is reported again
  stop_ = stop_ || (d.found && options_.cluster.stopOnDifference);
  if (stop_) stats_.stopped = 1;
}

// The end must not be received before the last orders.
void ClusterLeader::finish(bool over) {
  bus_->flush();
  {
    const std::lock_guard lock(mutex_);
    played_ = 0;
    for (std::size_t i = 0; i < followers_.size(); ++i) {
      const auto gone = words_[i].gone;
      if (followers_[i].member || (gone && Clock::now() - *gone < kLately)) played_ |= bit(i);
    }
    if (!over || double_) return;
    session_.over = true;
    bus_->send(session_);
  }
  bus_->flush();
}

}  // namespace stadion::cluster
