#include "pipeline/cluster/follower.h"

#include "engine/plain_text/text_line.h"
#include "pipeline/cluster/session_rules.h"
#include "pipeline/platform/scoped_realtime_priority.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string_view>
#include <utility>

namespace stadion::cluster {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLeastRate = 1, kMostRate = 1000;  ///< of shows [1/s]
constexpr std::size_t kMostOrders = 1U << 16U;      ///< received and not applied: minutes of them

}  // namespace

class Follower::OrderedInput final : public InputDevice {
public:
  explicit OrderedInput(const Follower& of) : of_(of) {}
  void sampleAt(Nanoseconds, InputSample& sample) override { sample = of_.sample_; }
  bool sampleNow(InputSample& sample) override {
    if (of_.sampled_) sample = of_.sample_;
    return of_.sampled_;
  }

private:
  const Follower& of_;
};

Follower::Follower(FollowerOptions options, std::uint64_t incarnation)
    : options_(std::move(options)), incarnation_(incarnation),
      framesShown_(options_.kept ? options_.kept->framesShown : 0), kept_(options_.kept),
      input_(std::make_unique<OrderedInput>(*this)) {}

Follower::~Follower() {
  std::vector<std::thread> giving;
  {
    const std::lock_guard lock(mutex_);
    kept_.reset();
    giving.swap(giving_);
  }
  for (std::thread& thread : giving) thread.join();
  if (bus_) bus_->close();  // stops all calls, which still use bus_
}

Result<std::unique_ptr<Follower>> Follower::open(FollowerOptions options) {
  std::unique_ptr<Follower> follower(new Follower(std::move(options), anyNumber()));
  auto bus = Bus::open(follower->options_.cluster, *follower);
  if (!bus) return bus.error();
  follower->stats_.barrier.makeRoom();
  const std::lock_guard lock(follower->mutex_);
  follower->bus_ = std::move(bus.value());
  follower->announce(Phase::Waiting);
  follower->giveIfAsked();
  return follower;
}

std::unique_ptr<Follower> Follower::unconnected(FollowerOptions options, std::uint64_t incarnation) {
  std::unique_ptr<Follower> follower(new Follower(std::move(options), incarnation));
  follower->bus_ = Bus::none();
  return follower;
}

// Expects the lock.
void Follower::announce(Phase phase) {
  told_ = phase;
  toldSerial_ = appliedSerial_;
  Presence p{};
  p.node = static_cast<std::uint8_t>(options_.node);
  p.incarnation = incarnation_;
  p.count = ++announced_;
  p.cluster = options_.key.cluster;
  p.session = joined_;
  p.phase = static_cast<std::uint8_t>(phase);
  if (kept_) {
    p.plays = kept_->transfer.session;
    p.serial = kept_->transfer.serial;
    p.show = kept_->show;
  } else if (plays_ && !differs_) {
    p.plays = joined_;
    p.serial = appliedSerial_;
    p.show = show_;
  }
  bus_->send(p);
}

// Expects the lock, while no orders come: a new leader must learn which scene is the newest.
void Follower::announceProgress() {
  if (plays_ && toldSerial_ != appliedSerial_) announce(told_);
}

// Expects the lock. Sends on a thread of its own, because a state may be large.
void Follower::giveIfAsked() {
  if (!bus_ || !kept_ || session_.giver != options_.node || session_.resumes != kept_->transfer.session)
    return;
  if (std::exchange(given_, session_.number) == session_.number) return;
  SceneTransfer transfer = kept_->transfer;
  transfer.to = transfer.session = session_.number;
  giving_.emplace_back([this, transfer = std::move(transfer)] { send(*bus_, transfer); });
}

/// Returns false if the wait was stopped.
template <class Ready>
bool Follower::await(std::unique_lock<std::mutex>& lock, const char* what, const Ready& ready) {
  const auto begin = Clock::now();
  bool told = false;
  while (!ready()) {
    if (options_.stop() || double_) return false;
    if (!told && Clock::now() - begin > kLongWait) {
      told = true;
      options_.tell(fmt::format("waiting for {}", what));
    }
    if (changed_.wait_for(lock, kPollInterval) == std::cv_status::timeout) announceProgress();
  }
  return true;
}

std::optional<JoinTerms> Follower::join() {
  for (std::unique_lock lock(mutex_);;) {
    if (auto joining = joinSession(lock)) return joining;
    if (!again_ || over_ || double_ || options_.stop()) return {};
    again_ = false;
    joined_ = 0;  // another program leads now
    announce(Phase::Waiting);
  }
}

/// Expects the lock.
std::optional<JoinTerms> Follower::joinSession(std::unique_lock<std::mutex>& lock) {
  if (!awaitSession(lock)) return {};
  const CompatibilityKey theirs = read(session_.compatibility);
  if (!agrees(theirs)) return {};
  joined_ = session_.number;
  show_ = theirs.show();
  forgetOtherSessions();
  JoinTerms joining{session_.rate, {}, {}, 0, theirs.input != 0};
  if (!session_.begun && session_.resumes == 0) return joining;
  if (session_.begun) awaitDouble(lock);
  if (hasEnded() || !awaitState(lock)) return {};
  continueFromState(joining);
  return joining;
}

/// Expects the lock. Returns true if there is a session that this host can join.
bool Follower::awaitSession(std::unique_lock<std::mutex>& lock) {
  const auto known = [&] {
    return over_ || (session_.number != 0 && session_.giver == kNoNode && !session_.over);
  };
  return await(lock, (leader() + ", the leader").c_str(), known) && !over_;
}

/// Expects the lock. Tells the user where the leader's files and settings differ. Returns false if the two
/// cannot play together.
bool Follower::agrees(const CompatibilityKey& theirs) {
  if (const std::string why = refusal(theirs, options_.key, leader()); !why.empty()) {
    options_.tell(why);
    refused_ = true;
    return false;
  }
  if (const std::string what = remark(theirs, options_.key, leader()); !what.empty()) options_.tell(what);
  return true;
}

/// Expects the lock. Drops what belongs to other sessions than the joined one: orders, a state, and a kept
/// scene if it is of another show.
void Follower::forgetOtherSessions() {
  std::erase_if(orders_, [&](const HeardOrder& o) { return o.numbers.session != joined_; });
  if (incoming_.session() != joined_) incoming_ = {};
  const std::uint64_t ofKept = kept_ ? kept_->transfer.session : joined_;
  if (ofKept == joined_ || ofKept == session_.resumes) return;
  kept_.reset();
  framesShown_ = 0;
}

/// Expects the lock. Asks for the scene's state, again after a long silence. Returns true if it is complete.
bool Follower::awaitState(std::unique_lock<std::mutex>& lock) {
  announce(Phase::Asking);
  std::uint64_t received = 0;
  auto since = Clock::now();
  const auto has = [&] {
    if (std::exchange(received, incoming_.received()) != incoming_.received()) since = Clock::now();
    if (Clock::now() - since > kLongWait) {
      announce(Phase::Asking);
      since = Clock::now();
    }
    return incoming_.complete() || hasEnded();
  };
  return await(lock, ("the scene's state from " + leader()).c_str(), has) && !hasEnded();
}

/// Expects the lock and a complete state. Keeps the state, and notes in `joining` where the show continues.
void Follower::continueFromState(JoinTerms& joining) {
  const auto kept =
      std::make_shared<const ResumableScene>(ResumableScene{incoming_.take(), show_, framesShown_});
  kept_ = kept;
  const SceneTransfer& transfer = kept->transfer;
  appliedSerial_ = transfer.serial;
  plays_ = true;
  joining.after.frame = transfer.frame;
  joining.after.time = transfer.time;
  std::erase_if(orders_, [&](const HeardOrder& o) { return o.numbers.serial <= appliedSerial_; });
  joining.state = {kept, &transfer.scene.bytes};
  joining.files = transfer.scene.files;
}

/// Expects the lock. The leader may still count a host of our name. If that program has crashed, the deadline
/// passes. If it lives, we hear it and end.
void Follower::awaitDouble(std::unique_lock<std::mutex>& lock) {
  const auto until = Clock::now() + std::chrono::duration<double>(2 * options_.cluster.deadline);
  while (isMember_.value_or(true) && !hasEnded() && !options_.stop() && Clock::now() < until)
    changed_.wait_for(lock, kPollInterval);
}

std::optional<FrameOrder> Follower::next() {
  const ScopedRealtimePriority prompt;  // others wait while it holds the lock
  std::unique_lock lock(mutex_);
  if (orders_.empty() && told_ != Phase::Ready) announce(Phase::Ready);
  const auto has = [&] { return !orders_.empty() || hasEnded() || leaves(); };
  if (!await(lock, (leader() + ", the leader").c_str(), has)) return {};
  if (again_ || double_ || leaves() || orders_.empty()) return {};
  HeardOrder heard = std::move(orders_.front());
  orders_.pop_front();
  if (heard.numbers.serial != appliedSerial_ + 1) {
    again_ = true;
    return {};
  }
  if ((heard.numbers.explain >> options_.node & 1U) != 0 && explain(lock)) {
    again_ = differs_ = true;
    return {};
  }
  appliedSerial_ = heard.numbers.serial;
  frame_ = heard.order.signature.frame;
  still_ = heard.order.standsAfter;
  presentation_ = heard.order.presentation;
  const bool isNew = std::exchange(kept_, nullptr) || !plays_;
  plays_ = true;
  if (isNew) announce(told_);
  if (heard.order.last && !over_) {
    frames_ = frame_ + 1;
    tellEnd();  // this host may leave before it hears that the session is over
  }
  heard.order.drawn = (heard.numbers.members >> options_.node & 1U) != 0;
  // The leader left us out for being late. A host that has caught up is taken back.
  if (!heard.order.drawn && told_ == Phase::Ready && orders_.empty()) announce(Phase::Ready);
  shows_.emplace_back(appliedSerial_, heard.order.drawn);
  sample_ = std::move(heard.input);
  sampled_ = heard.sampled;
  ++stats_.orders;
  return heard.order;
}

/// Expects the lock. Returns true if this host has to join again: it is late, or its scene differs and the cluster goes
/// on all the same.
bool Follower::explain(std::unique_lock<std::mutex>& lock) {
  std::uint64_t received = 0;
  auto since = Clock::now();
  bool late = false;  // part of it was lost: the host asks again each time it joins
  const auto has = [&] {
    if (std::exchange(received, incoming_.received()) != incoming_.received()) since = Clock::now();
    late = Clock::now() - since > kLongWait;
    return hasEnded() || late || (incoming_.complete() && incoming_.serial() == appliedSerial_);
  };
  if (!await(lock, "the scene of the leader, to compare ours with it", has) || hasEnded() || late)
    return true;
  const SceneTransfer theirs = incoming_.take();
  const std::optional<Differs> differs = compare_ ? compare_(theirs.scene) : std::nullopt;
  Difference told{};
  told.node = static_cast<std::uint8_t>(options_.node);
  told.session = joined_;
  told.frame = frame_;
  told.found = differs.has_value();
  Differs d = differs.value_or(Differs{});
  told.where = d.where.data();
  told.here = d.here.data();
  told.there = d.there.data();
  bus_->send(told);
  if (!differs) return false;
  const bool goesOn = options_.cluster.stopOnDifference;  // to the last order, which follows
  options_.tell(fmt::format("our scene differs from that of {} after frame {}: {} is {} here and {} there",
                            leader(), frame_, d.where, d.here, d.there));
  return !goesOn;
}

bool Follower::mayShow(const TimeSignature& now) {
  const ScopedRealtimePriority prompt;
  std::unique_lock lock(mutex_);
  if (shows_.empty()) return false;
  const auto [serial, member] = shows_.front();
  shows_.pop_front();
  shown_ = serial;
  if (!member) return true;
  const Drawn told{static_cast<std::uint8_t>(options_.node), joined_, serial};
  bus_->send(told);
  const auto drawn = Clock::now();
  // Repeated after a while: a host that has just connected does not use all topics at once, in either
  // direction.
  while (go_ < serial && !hasEnded() && !options_.stop())
    if (changed_.wait_for(lock, kPollInterval) == std::cv_status::timeout) {
      bus_->send(told);
      announceProgress();
    }
  if (go_ == serial && latest_ == options_.node)
    stats_.barrier.add(std::chrono::duration<double, std::milli>(Clock::now() - drawn).count());
  if (go_ < serial) return false;
  framesShown_ = now.frame + 1;
  return true;
}

void Follower::simulated(std::uint64_t frame, std::uint64_t digest) {
  const ScopedRealtimePriority prompt;  // others wait while it holds the lock
  const std::lock_guard lock(mutex_);
  ++stats_.compared;
  bus_->send(SceneHash{static_cast<std::uint8_t>(options_.node), joined_, frame, digest});
}

ClusterStats Follower::stats() const {
  const std::lock_guard lock(mutex_);
  return stats_;
}

bool Follower::mustRejoin() const {
  const std::lock_guard lock(mutex_);
  return again_ && !over_ && !double_;
}

bool Follower::hasDouble() const {
  const std::lock_guard lock(mutex_);
  return double_;
}

bool Follower::isRefused() const {
  const std::lock_guard lock(mutex_);
  return refused_;
}

bool Follower::missedTheEnd() const {
  const std::lock_guard lock(mutex_);
  return framesShown_ < frames_;
}

std::uint64_t Follower::session() const {
  const std::lock_guard lock(mutex_);
  return joined_;
}

bool Follower::isOver() const {
  const std::lock_guard lock(mutex_);
  return over_;
}

/// Expects the lock. Returns true if it is the session that we play. If we play none, returns true if it
/// continues our show.
bool Follower::isOurs(const Session& session) const {
  if (joined_ != 0) return session.number == joined_;
  return options_.played != 0 && (session.number == options_.played || session.resumes == options_.played);
}

/// Expects the lock.
void Follower::tellEnd() {
  if (!std::exchange(endTold_, true)) options_.tell(leader() + " has ended the show");
}

void Follower::receive(const Session& session) {
  {
    const std::lock_guard lock(mutex_);
    // A leader that looks for a show under way does not know its rate yet.
    if (session.giver == kNoNode && !(session.rate >= kLeastRate && session.rate <= kMostRate)) return;
    // An earlier leader that was taken for dead and comes back leads no more.
    if (session.number < session_.number && (hasShow(session_) || (session.over && !isOurs(session)))) return;
    session_ = session;
    if (session.over && isOurs(session)) {
      frames_ = session.shown;
      over_ = true;
      tellEnd();
    }
    // While another host is asked for its scene, we keep ours.
    const bool holds =
        session.resumes == joined_ && session.giver != kNoNode && session.giver != options_.node;
    if (joined_ != 0 && session.number != joined_ && !holds) again_ = true;
    giveIfAsked();
  }
  changed_.notify_all();
}

// If two programs are the same host, the one without a scene ends. If both or neither have one, the later
// program ends.
void Follower::receive(const Presence& other) {
  {
    const std::lock_guard lock(mutex_);
    if (other.node != options_.node || other.incarnation == incarnation_ || double_) return;
    const bool has = other.plays != 0, have = plays_ || kept_;
    const bool theirs = has != have ? has : other.incarnation < incarnation_;
    if (!theirs) return;
    double_ = true;
    options_.tell(other.cluster == options_.key.cluster
                      ? fmt::format("another program is {} already; this one ends",
                                    options_.cluster.nodes[options_.node].name)
                      : inTheWay(options_.cluster));
  }
  changed_.notify_all();
}

void Follower::receive(const Order& order) {
  {
    const std::lock_guard lock(mutex_);
    if (joined_ != 0 && order.session != joined_) return;
    isMember_ = (order.members >> options_.node & 1U) != 0;
    if (orders_.size() >= kMostOrders) return;  // then an order is missing; the same if it makes no sense
    if (auto heard = readOrder(order)) orders_.push_back(std::move(*heard));
  }
  changed_.notify_all();
}

void Follower::receive(const Go& go) {
  {
    const std::lock_guard lock(mutex_);
    if (go.session != joined_) return;
    go_ = std::max(go_, go.serial);
    latest_ = go.latest;
  }
  changed_.notify_all();
}

void Follower::receive(const StatePart& part) {
  {
    const std::lock_guard lock(mutex_);
    if (part.to == incarnation_ && (joined_ == 0 || part.session == joined_)) incoming_.add(part);
  }
  changed_.notify_all();
}

bool Follower::keepsScene() const {
  const std::lock_guard lock(mutex_);
  const bool isAsked = session_.resumes == joined_ && session_.giver == options_.node;
  return plays_ && !differs_ && !kept_ && (isAsked || (again_ && !over_ && !double_));
}

std::shared_ptr<const ResumableScene> Follower::kept() const {
  const std::lock_guard lock(mutex_);
  return kept_;
}

void Follower::keep(const TimeSignature& last, SavedScene scene) {
  ResumableScene kept;
  SceneTransfer& transfer = kept.transfer;
  transfer.frame = last.frame;
  transfer.time = last.time;
  transfer.scene = std::move(scene);
  const std::lock_guard lock(mutex_);
  transfer.session = joined_;
  transfer.serial = appliedSerial_;
  kept.show = show_;
  transfer.still = still_;
  transfer.presentation = presentation_;
  kept.framesShown = framesShown_;
  kept_ = std::make_shared<const ResumableScene>(std::move(kept));
  giveIfAsked();
}

void Follower::finish() {
  std::vector<std::thread> giving;
  {
    const std::lock_guard lock(mutex_);
    announce(Phase::Leaving);
    giving.swap(giving_);
  }
  for (std::thread& thread : giving) thread.join();
  bus_->flush();
}

}  // namespace stadion::cluster
