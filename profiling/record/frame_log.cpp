#include "profiling/record/frame_log.h"

#include "engine/maths/median.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace stadion {
namespace {

constexpr std::chrono::milliseconds kNap{2};
/// Visits of nodes, of some six spans each. Above the first number a frame is light; the second is the
/// average number of recorded visits.
constexpr std::uint64_t kManyVisits = 300, kVisitsAFrame = 30;
constexpr std::chrono::microseconds kExpensive{250};

/// Spans that occur once for each visited node.
constexpr bool isOfVisit(Span what) {
  return isOfNode(what) || what == Span::Settle || what == Span::Mail;
}

/// Returns the first multiple of `every` that is not less.
std::uint64_t nextMultiple(std::uint64_t frame, std::uint64_t every) {
  return (frame + every - 1) / every * every;
}

std::uint64_t nextNumber() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

}  // namespace

FrameLog::FrameLog(std::vector<SpanReader*> readers, FrameLogOptions options)
    : readers_(std::move(readers)), options_(options), number_(nextNumber()), samples_(options.samples) {
  measureOverhead();
  collector_ = std::thread([this] {
    while (!done_) {
      collectSafely();
      std::this_thread::sleep_for(kNap);
    }
  });
}

/// Measures nested spans in this thread. The median of some rounds counts, since the thread may lose its
/// processor during one.
void FrameLog::measureOverhead() {
  constexpr int kRounds = 63, kSpansARound = 1000;
  FrameProbe& probe = *this;
  const auto began = ProfileClock::now();
  const std::uint64_t beganTicks = TickClock::now();
  std::vector<double> inside, outside;
  for (int round = 0; round < kRounds; ++round) {
    probe.began(Span::App, 0, kNoWall);
    for (int i = 0; i < kSpansARound; ++i) {
      const SpanScope span(&probe, Span::Simulate, NodeRef{1, 0});
    }
    probe.ended(Span::App);
    inside.push_back(0);
    outside.push_back(0);
    for (SpanRecord r; track().spans().take(r);)
      (r.what == Span::App ? outside : inside).back() += r.own * 1e6 / kSpansARound;
    track().takeCount();
  }
  const double ns = std::chrono::duration<double, std::nano>(ProfileClock::now() - began).count();
  nanosecondsATick_ = ns / static_cast<double>(std::max<std::uint64_t>(1, TickClock::now() - beganTicks));
  expensiveTicks_ = static_cast<std::uint64_t>(std::chrono::duration<double, std::nano>(kExpensive).count() /
                                               nanosecondsATick_);
  overhead_ = {median(inside), median(outside)};
  measureLightOverhead();
  // A thread that comes later gets a track that includes the measurement.
  tracks_.clear();
  number_ = nextNumber();
  appFrame_ = kNoFrame;
  nextWhole_ = 0;
}

/// Measures empty visits, in a frame that is not recorded as a whole.
void FrameLog::measureLightOverhead() {
  constexpr int kRounds = 63, kVisits = 1000;
  const NodeRef node{1, 0};
  const auto accounts = std::make_shared<NodeAccounts>(std::vector{node});
  accounts->add(node, 0);
  watch(accounts);
  track().began(Span::App, 0, kNoWall, {});
  light_ = true;
  std::array<std::uint64_t, kRounds> ticks{};
  for (std::uint64_t& round : ticks) {
    track().beginLightly();
    for (int i = 0; i < kVisits; ++i) {
      {
        const SpanScope mail(this, Span::Mail);
        const SpanScope receive(this, Span::Receive, node);
        const SpanScope simulate(this, Span::Simulate, node);
      }
      { const SpanScope simulate(this, Span::Simulate, node); }
      { const SpanScope dispatch(this, Span::Dispatch, node); }
      const SpanScope settle(this, Span::Settle, node);
    }
    round = std::exchange(shortTicks_[0], 0) / kVisits;
  }
  light_ = false;
  track().ended();
  std::ranges::nth_element(ticks, ticks.begin() + kRounds / 2);
  lightTicks_ = ticks[kRounds / 2];
  watch(nullptr);
}

FrameLog::~FrameLog() {
  finish();
}

void FrameLog::finish() {
  done_ = true;
  if (collector_.joinable()) collector_.join();
  collectSafely();
}

// Recording must not end a show: without memory, records are lost and counted.
void FrameLog::collectSafely() noexcept {
  try {
    collect();
  } catch (const std::bad_alloc&) {
    ++notCollected_;
  }
}

/// Each thread looks up its own once.
SpanTrack& FrameLog::track() {
  thread_local std::pair<std::uint64_t, SpanTrack*> mine{0, nullptr};
  if (mine.first != number_) {
    const std::lock_guard lock(mutex_);
    tracks_.push_back(std::make_unique<SpanTrack>(overhead_));
    mine = {number_, tracks_.back().get()};
  }
  return *mine.second;
}

void FrameLog::began(Span what, std::uint64_t frame, std::uint32_t wall) {
  SpanTrack& t = track();
  if (what == Span::App) beginApp(t, frame);
  t.began(what, frame, wall, {});
}

/// Expects as many visits as in the previous frame.
void FrameLog::beginApp(SpanTrack& t, std::uint64_t frame) {
  appFrame_.store(frame, std::memory_order_relaxed);
  const std::uint64_t visits = t.takeCount();
  const bool light = visits > kManyVisits && (frame < nextWhole_ || frame < options_.from);
  if (!light) nextWhole_ = frame + 1 + visits / kVisitsAFrame;
  light_.store(light, std::memory_order_relaxed);
  called_ = false;
  t.setWhole(!light);
  t.beginLightly();
}

// Work outside the stages' threads is done for App.
void FrameLog::began(Span what, NodeRef node) {
  if (isOfVisit(what) && light_.load(std::memory_order_relaxed)) {
    beganInVisit(what, node);
    return;
  }
  SpanTrack& t = track();
  if (what == Span::Settle) t.count();
  if (what == Span::Workers) inParallel_.store(true, std::memory_order_relaxed);
  const std::uint64_t frame = t.frame();
  t.began(what, frame != kNoFrame ? frame : appFrame_.load(std::memory_order_relaxed), t.wall(), node);
}

// A visit lasts from the previous one to the node's Settle. Nodes that simulate in parallel are
// distinguished.
void FrameLog::beganInVisit(Span what, NodeRef node) {
  const bool aside = what == Span::Simulate && inParallel_.load(std::memory_order_relaxed);
  if (what != Span::Settle && !aside) return;
  SpanTrack& t = track();
  if (aside) t.beginLightly();
  t.nameLightly(node);
}

void FrameLog::ended(Span what) {
  const bool light = light_.load(std::memory_order_relaxed);
  if (light && isOfVisit(what)) {
    const bool aside = what == Span::Simulate && inParallel_.load(std::memory_order_relaxed);
    if (what == Span::Settle || aside) endedVisit();
    // The nodes to visit are known, for all of them.
    if (what == Span::Mail && !std::exchange(called_, true)) track().beginLightly();
    return;
  }
  if (what == Span::Workers) inParallel_.store(false, std::memory_order_relaxed);
  SpanTrack& t = track();
  if (light && what == Span::App) tellShortVisits();
  t.ended();
  if (light) t.beginLightly();
}

void FrameLog::visited(NodeRef node) {
  track().nameLightly(node);
  endedVisit();
}

void FrameLog::endedVisit() {
  SpanTrack& t = track();
  const NodeAccounts::Account account = accounts_ ? accounts_->of(t.namedLightly()) : NodeAccounts::kNone;
  // Only App's own thread adds up.
  const bool helps = t.depth() == 0 && account != NodeAccounts::kNone;
  const std::uint64_t ticks =
      t.endLightly(appFrame_.load(std::memory_order_relaxed), helps ? 0 : expensiveTicks_, nanosecondsATick_);
  if (account != NodeAccounts::kNone && ticks > lightTicks_) shortTicks_[account] += ticks - lightTicks_;
}

void FrameLog::watch(std::shared_ptr<const NodeAccounts> accounts) {
  tellShortVisits();
  shortTicks_.assign(accounts ? accounts->holders().size() : 0, 0);
  const std::lock_guard lock(mutex_);
  accounts_ = std::move(accounts);
}

void FrameLog::tellShortVisits() {
  for (std::size_t i = 0; i < shortTicks_.size(); ++i)
    if (ShortVisits* s = shortTicks_[i] > 0 ? shortVisits_.claim() : nullptr) {
      const double ns = static_cast<double>(std::exchange(shortTicks_[i], 0)) * nanosecondsATick_;
      *s = {appFrame_.load(std::memory_order_relaxed), accounts_->holders()[i], 1e-6 * ns};
      shortVisits_.push();
    }
}

void FrameLog::counted(Count what, std::uint64_t amount, NodeRef node) {
  track().counted(what, amount, node);
}

bool FrameLog::wantsShares(std::uint64_t frame, std::uint32_t wall) const {
  if (!(samples_ || options_.shares)) return false;
  const std::lock_guard lock(mutex_);
  const auto next = nextShares_.find(wall);
  return frame >=
         (next == nextShares_.end() ? nextMultiple(options_.from, options_.sampleEvery) : next->second);
}

void FrameLog::shared(Span what, std::uint64_t frame, std::uint32_t wall, std::span<const NodeRef> among) {
  track().disturb();
  SharedSpan s{what, frame, wall, track().last(what), {among.begin(), among.end()}, 0};
  const std::lock_guard lock(mutex_);
  if (what == Span::Fill && among.size() > kManyShares) crowded_.insert(wall);
  const std::uint64_t round = options_.sampleEvery * (1 + among.size() / kManyShares);
  std::uint64_t& next = nextShares_[wall];
  next = std::max(next, nextMultiple(frame + 1 + round - options_.sampleEvery, options_.sampleEvery));
  s.round = std::max(round, next - frame);
  shared_.push_back(std::move(s));
}

/// If frames are skipped, the next drawn one is sampled: a show that is too slow is sampled, too.
DrawSample FrameLog::drawSample(std::uint64_t frame, std::uint32_t wall) {
  if (!samples_ || frame < options_.from) return DrawSample::None;
  const std::uint64_t first = options_.sampleEvery / 2 + (options_.whole ? 0 : 1);
  const std::lock_guard lock(mutex_);
  Due& due = nextDrawn_.try_emplace(wall, Due{first, false}).first->second;
  if (std::exchange(due.some, false)) return DrawSample::Some;
  if (frame < due.frame) return DrawSample::None;
  due.frame = first + nextMultiple(frame - first + 1, sampleEvery(wall));
  due.some = options_.whole;
  return options_.whole ? DrawSample::Whole : DrawSample::Some;
}

std::uint64_t FrameLog::sampleEvery(std::uint32_t wall) const {
  return options_.sampleEvery * (crowded_.contains(wall) ? options_.crowdedEvery : 1);
}

bool FrameLog::wantsAlone(std::span<const NodeRef> owners) const {
  const std::lock_guard lock(mutex_);
  return options_.whole || !accounts_ || std::ranges::any_of(owners, [&](NodeRef owner) {
           return accounts_->of(owner) != NodeAccounts::kNone;
         });
}

std::size_t FrameLog::nextBatch(std::uint32_t wall, std::uint32_t eye, std::size_t batches) {
  const std::lock_guard lock(mutex_);
  const std::size_t at = 2 * std::size_t{wall} + eye;
  if (turns_.size() <= at) turns_.resize(at + 1);
  Turn& turn = turns_[at];
  const std::size_t now = turn.next % batches;
  turn.next = now + kBatchesAFrame < batches ? now + kBatchesAFrame : 0;
  turn.round = sampleEvery(wall) * ((batches + kBatchesAFrame - 1) / kBatchesAFrame);
  return now;
}

void FrameLog::drewAlone(const IsolatedDrawTime& drawn, std::span<const NodeShare> nodes) {
  track().disturb();
  const std::size_t at = 2 * std::size_t{drawn.wall} + drawn.eye;
  const std::lock_guard lock(mutex_);
  alone_.push_back({drawn, {nodes.begin(), nodes.end()}});
  if (at < turns_.size()) alone_.back().drawn.round = turns_[at].round;
}

namespace {

/// Returns the track with the next record that ended first. Readers thus see the frames of all threads in
/// step, however many records have accumulated.
std::optional<std::size_t> firstEnded(const std::vector<SpanTrack*>& tracks) {
  std::optional<std::size_t> first;
  ProfileClock::time_point ended;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const SpanRecord* next = tracks[i]->spans().next();
    if (next && (!first || next->ended < ended)) {
      first = i;
      ended = next->ended;
    }
  }
  return first;
}

}  // namespace

/// Tells the readers that take the frame.
template <class... What>
void FrameLog::tell(std::uint64_t frame, const What&... what) {
  for (SpanReader* reader : readers_)
    if (frame >= options_.from || reader->takesFirstFrames()) reader->take(what...);
}

void FrameLog::collect() {
  std::vector<SpanTrack*> tracks;
  std::vector<SharedSpan> shared;
  std::vector<Alone> alone;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& t : tracks_) tracks.push_back(t.get());
    shared.swap(shared_);
    alone.swap(alone_);
  }
  SpanRecord record;
  while (const auto first = firstEnded(tracks))
    if (tracks[*first]->spans().take(record)) tell(record.frame, *first, record);
  for (SpanTrack* t : tracks)
    for (CountRecord c; t->counts().take(c);) tell(c.frame, c);
  for (ShortVisits s; shortVisits_.take(s);) tell(s.frame, s);
  for (const SharedSpan& s : shared)
    for (SpanReader* reader : readers_) reader->take(s);
  for (const Alone& a : alone)
    for (SpanReader* reader : readers_) reader->take(a.drawn, a.nodes);
  for (SpanReader* reader : readers_) reader->caughtUp();
}

std::uint64_t FrameLog::lost() const {
  const std::lock_guard lock(mutex_);
  std::uint64_t lost = shortVisits_.lost() + notCollected_;
  for (const auto& t : tracks_) lost += t->spans().lost() + t->counts().lost();
  return lost;
}

}  // namespace stadion
