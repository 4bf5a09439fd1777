#include "pipeline/cluster/lead.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <random>
#include <utility>

namespace stadion::cluster {
namespace {

constexpr std::size_t kPart = 32 * 1024;  ///< of the state, at once [byte]
constexpr std::size_t kHashesKept = 64;
constexpr std::chrono::milliseconds kLook{100};  ///< how often a wait looks whether it is still wanted

std::uint64_t anyNumber() {
  std::random_device device;
  return std::uint64_t{device()} << 32U | device() | 1U;
}

std::uint32_t bit(std::size_t node) {
  return std::uint32_t{1} << node;
}

}  // namespace

/// The show's input, which all are told of.
class Lead::SampledInput final : public InputDevice {
public:
  SampledInput(InputDevice& inner, Lead& lead) : inner_(inner), lead_(lead) {}
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
  Lead& lead_;
};

Lead::Lead(LeadOptions options) : options_(std::move(options)), followers_(options_.cluster.nodes.size()) {
  session_.number = anyNumber(), session_.show = options_.show, session_.rate = options_.rate;
}

Result<std::unique_ptr<Lead>> Lead::open(LeadOptions options) {
  std::unique_ptr<Lead> lead(new Lead(std::move(options)));
  auto bus = Bus::open(lead->options_.cluster, *lead);
  if (!bus) return bus.error();
  lead->bus_ = std::move(bus.value());
  lead->bus_->tell(lead->session_);
  lead->sender_ = std::thread([self = lead.get()] { self->sendParcels(); });
  return lead;
}

Lead::~Lead() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  if (sender_.joinable()) sender_.join();
  bus_.reset();  // nobody calls any more
}

InputDevice& Lead::input(InputDevice& inner) {
  input_ = std::make_unique<SampledInput>(inner, *this);
  return *input_;
}

void Lead::begin() {
  std::unique_lock lock(mutex_);
  const auto until = Clock::now() + options_.patience;
  const auto missing = [&] {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < followers_.size(); ++i)
      if (i != options_.cluster.lead && followers_[i].phase != Phase::Ready) names.push_back(nameOf(i));
    return names;
  };
  while (!missing().empty() && Clock::now() < until && !options_.stop()) changed_.wait_for(lock, kLook);
  if (const auto names = missing(); !names.empty() && !options_.stop())
    options_.tell(fmt::format("the show begins without {}", fmt::join(names, ", ")));
  session_.begun = true;
  bus_->tell(session_);
}

// The order goes out with its input, which App takes next.
void Lead::issue(FrameOrder& order) {
  answerWhoAsks();
  const std::lock_guard lock(mutex_);
  order.last = order.last || stop_;
  pending_ = order;
  awaitsInput_ = true;
}

void Lead::send(const InputSample* input) {
  const std::lock_guard lock(mutex_);
  if (!awaitsInput_) return;
  awaitsInput_ = false;
  std::uint32_t members = 0;
  for (std::size_t i = 0; i < followers_.size(); ++i)
    if (followers_[i].member) members |= bit(i);
  rounds_.push_back({++serial_, members, false});
  bus_->tell(
      written_.write({session_.number, serial_, members, std::exchange(explain_, 0)}, pending_, input));
  const std::uint64_t bytes = written_.bytes();
  ++tally_.orders, tally_.orderBytes += bytes;
  tally_.mostOrderBytes = std::max(tally_.mostOrderBytes, bytes);
}

// Between two frames: the scene is as it was after the order before.
void Lead::answerWhoAsks() {
  std::vector<std::uint64_t> asking;
  std::uint64_t serial = 0;
  {
    const std::lock_guard lock(mutex_);
    serial = serial_;
    for (std::size_t i = 0; i < followers_.size() && serial > 0; ++i) {
      Follower& f = followers_[i];
      if (!std::exchange(f.asks, false)) continue;
      asking.push_back(f.incarnation);
      if (f.differs) explain_ |= bit(i);
    }
  }
  if (asking.empty() || !save_) return;
  const std::vector<std::uint8_t> state = save_();
  {
    const std::lock_guard lock(mutex_);
    for (const std::uint64_t to : asking) parcels_.push_back({to, serial, state});
  }
  changed_.notify_all();
}

// On a thread of its own, for a state may be large.
void Lead::sendParcels() {
  for (std::unique_lock lock(mutex_); !ending_;) {
    if (parcels_.empty()) {
      changed_.wait(lock);
      continue;
    }
    Parcel parcel = std::move(parcels_.front());
    parcels_.pop_front();
    lock.unlock();
    StatePart part{};
    part.to = parcel.to, part.session = session_.number, part.serial = parcel.serial;
    part.size = parcel.bytes.size();
    do {
      const std::size_t size = std::min(kPart, parcel.bytes.size() - part.offset);
      part.bytes._buffer = parcel.bytes.data() + part.offset, part.bytes._release = false;
      part.bytes._length = part.bytes._maximum = static_cast<std::uint32_t>(size);
      bus_->tell(part);
      part.offset += size;
    } while (part.offset < parcel.bytes.size());
    lock.lock();
  }
}

bool Lead::mayShow(const TimeSignature&) {
  std::unique_lock lock(mutex_);
  const std::uint64_t serial = ++shown_;
  const auto at = std::ranges::find(rounds_, serial, &Round::serial);
  if (at == rounds_.end()) return false;
  at->drawnHere = true;
  const bool latest = at->awaited == 0;
  const auto drawn = Clock::now();
  release();
  while (go_ < serial && !options_.stop()) changed_.wait_for(lock, kLook);
  if (latest) tally_.barrier.add(std::chrono::duration<double, std::milli>(Clock::now() - drawn).count());
  return go_ >= serial;
}

// With the mutex: what all have drawn is shown.
void Lead::release() {
  bool released = false;
  while (!rounds_.empty() && rounds_.front().awaited == 0 && rounds_.front().drawnHere) {
    go_ = rounds_.front().serial;
    rounds_.pop_front();
    released = true;
  }
  if (!released) return;
  bus_->tell(Go{session_.number, go_, latest_});
  changed_.notify_all();
}

void Lead::hear(const Presence& p) {
  std::unique_lock lock(mutex_);
  if (p.node >= followers_.size() || p.node == options_.cluster.lead) return;
  Follower& f = followers_[p.node];
  if (f.incarnation != p.incarnation) {
    if (f.member) leaveOut(p.node, "began anew");
    f = {p.incarnation, Phase::Waiting, false, false, false};
  }
  f.phase = p.session == session_.number ? static_cast<Phase>(p.phase) : Phase::Waiting;
  f.asks = f.phase == Phase::Asking;
  if (f.phase == Phase::Ready && !f.member) {
    f.member = true;
    ++tally_.joined;
    if (session_.begun) options_.tell(fmt::format("{} plays with us", nameOf(p.node)));
  }
  lock.unlock();
  changed_.notify_all();
}

void Lead::hear(const Drawn& d) {
  const std::lock_guard lock(mutex_);
  if (d.session != session_.number || d.node >= followers_.size()) return;
  const auto at = std::ranges::find(rounds_, d.serial, &Round::serial);
  if (at == rounds_.end()) return;
  at->awaited &= ~bit(d.node);
  latest_ = d.node;
  release();
}

void Lead::left(std::uint8_t node) {
  const std::lock_guard lock(mutex_);
  if (node >= followers_.size() || node == options_.cluster.lead) return;
  if (followers_[node].member && !pending_.last)  // they go when the show is over
    leaveOut(node, fmt::format("has not been heard of for {:g} s", options_.cluster.deadline));
  followers_[node] = {};
}

// With the mutex.
void Lead::leaveOut(std::size_t node, const std::string& why) {
  followers_[node].member = false;
  ++tally_.leftOut;
  options_.tell(fmt::format("{} {}; the others go on", nameOf(node), why));
  for (Round& round : rounds_) round.awaited &= ~bit(node);
  release();
}

void Lead::simulated(std::uint64_t frame, std::uint64_t hash) {
  const std::lock_guard lock(mutex_);
  hashes_.emplace_back(frame, hash);
  if (hashes_.size() > kHashesKept) hashes_.pop_front();
  for (const SceneHash& early : early_)
    if (early.frame == frame) compare(early.node, frame, early.hash);
  std::erase_if(early_, [&](const SceneHash& h) { return h.frame <= frame; });
}

void Lead::hear(const SceneHash& h) {
  const std::lock_guard lock(mutex_);
  if (h.session != session_.number || h.node >= followers_.size()) return;
  const auto ours = std::ranges::find(hashes_, h.frame, &std::pair<std::uint64_t, std::uint64_t>::first);
  if (ours != hashes_.end())
    compare(h.node, h.frame, h.hash);
  else if (hashes_.empty() || h.frame > hashes_.back().first)
    early_.push_back(h);
}

// With the mutex.
void Lead::compare(std::size_t node, std::uint64_t frame, std::uint64_t hash) {
  const auto ours = std::ranges::find(hashes_, frame, &std::pair<std::uint64_t, std::uint64_t>::first);
  ++tally_.compared;
  if (ours == hashes_.end() || ours->second == hash) return;
  ++tally_.differed;
  if (std::exchange(followers_[node].differs, true)) return;
  followers_[node].asks = true;
  options_.tell(
      fmt::format("the scene of {} differs from ours since frame {} at the latest ({:016x}, {:016x})",
                  nameOf(node), frame, hash, ours->second));
}

void Lead::hear(const Difference& d) {
  const std::lock_guard lock(mutex_);
  if (d.session != session_.number || d.node >= followers_.size()) return;
  if (d.found)
    options_.tell(fmt::format("the scene of {} differs from ours after frame {}: {} is {} there and {} here",
                              nameOf(d.node), d.frame, d.where, d.here, d.there));
  else
    options_.tell(fmt::format("the scene of {} is like ours after frame {}", nameOf(d.node), d.frame));
  stop_ = stop_ || (d.found && options_.cluster.stopOnDifference);
  if (stop_) tally_.stopped = 1;
}

void Lead::finish() {
  bus_->flush();
}

}  // namespace stadion::cluster
