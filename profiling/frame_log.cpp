#include "profiling/frame_log.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace stadion {
namespace {

constexpr std::chrono::milliseconds kNap{2};
/// Visits of nodes, of some six spans each: beyond the first figure a frame is light, and the second is what
/// is recorded on average.
constexpr std::uint64_t kManyVisits = 300, kVisitsAFrame = 30;
/// Nodes among which a span is shared: of more, it is asked for more rarely.
constexpr std::uint64_t kManyShares = 500;
/// There the eyes are sampled so many times more rarely, in large parts.
constexpr std::uint64_t kCrowdedEvery = 4;
constexpr std::chrono::microseconds kDear{250};

/// There are as many of them as there are nodes that are visited.
constexpr bool isOfVisit(Span what) {
  return isOfNode(what) || what == Span::Settle || what == Span::Mail;
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
      collect();
      std::this_thread::sleep_for(kNap);
    }
  });
}

/// Of many spans in one another, in this thread now. The median of some rounds counts: this thread may lose
/// its processor in the midst of one.
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
    inside.push_back(0), outside.push_back(0);
    for (SpanRecord r; track().spans().take(r);)
      (r.what == Span::App ? outside : inside).back() += r.own * 1e6 / kSpansARound;
    track().takeCount();
  }
  const double ns = std::chrono::duration<double, std::nano>(ProfileClock::now() - began).count();
  nanosecondsATick_ = ns / static_cast<double>(std::max<std::uint64_t>(1, TickClock::now() - beganTicks));
  dearTicks_ =
      static_cast<std::uint64_t>(std::chrono::duration<double, std::nano>(kDear).count() / nanosecondsATick_);
  const auto median = [](std::vector<double>& v) {
    std::ranges::nth_element(v, v.begin() + kRounds / 2);
    return v[kRounds / 2];
  };
  overhead_ = {median(inside), median(outside)};
  // Whoever comes to this thread later gets a track that knows it.
  tracks_.clear();
  number_ = nextNumber();
  appFrame_ = kNoFrame, nextWhole_ = 0;
}

FrameLog::~FrameLog() {
  finish();
}

void FrameLog::finish() {
  done_ = true;
  if (collector_.joinable()) collector_.join();
  collect();
}

/// Each thread looks for its own once.
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

/// As many visits as in the frame before are expected.
void FrameLog::beginApp(SpanTrack& t, std::uint64_t frame) {
  appFrame_.store(frame, std::memory_order_relaxed);
  const std::uint64_t visits = t.takeCount();
  const bool light = visits > kManyVisits && (frame < nextWhole_ || frame < options_.from);
  if (!light) nextWhole_ = frame + 1 + visits / kVisitsAFrame;
  light_.store(light, std::memory_order_relaxed);
  t.setWhole(!light);
  t.beginLightly();
}

// What runs on no stage's thread, runs for App.
void FrameLog::began(Span what, NodeRef node) {
  if (isOfVisit(what) && light_.load(std::memory_order_relaxed)) {
    beganInVisit(what, node);
    return;
  }
  SpanTrack& t = track();
  if (what == Span::Settle) t.count();
  const std::uint64_t frame = t.frame();
  t.began(what, frame != kNoFrame ? frame : appFrame_.load(std::memory_order_relaxed), t.wall(), node);
}

// A visit lasts from the one before to the node's Settle; on threads that help App, as long as it simulates.
void FrameLog::beganInVisit(Span what, NodeRef node) {
  if (what != Span::Settle && what != Span::Simulate) return;
  SpanTrack& t = track();
  if (what == Span::Simulate && t.depth() > 0) return;
  if (what == Span::Simulate) t.beginLightly();
  t.nameLightly(node);
}

void FrameLog::ended(Span what) {
  const bool light = light_.load(std::memory_order_relaxed);
  if (!light || !isOfVisit(what)) {
    SpanTrack& t = track();
    t.ended();
    if (light) t.beginLightly();
    return;
  }
  if (what != Span::Settle && what != Span::Simulate) return;
  SpanTrack& t = track();
  if (what == Span::Settle || t.depth() == 0)
    t.endLightly(appFrame_.load(std::memory_order_relaxed), dearTicks_, nanosecondsATick_);
}

void FrameLog::counted(Count what, std::uint64_t amount, NodeRef node) {
  track().counted(what, amount, node);
}

bool FrameLog::wantsShares(std::uint64_t frame, std::uint32_t wall) const {
  if (!(samples_ || options_.shares) || frame < options_.from || frame % options_.sampleEvery != 0)
    return false;
  const std::lock_guard lock(mutex_);
  const auto next = nextShares_.find(wall);
  return next == nextShares_.end() || frame >= next->second;
}

void FrameLog::shared(Span what, std::uint64_t frame, std::uint32_t wall, std::span<const NodeRef> among) {
  track().disturb();
  SharedSpan s{what, frame, wall, track().last(what), {among.begin(), among.end()}};
  const std::lock_guard lock(mutex_);
  if (what == Span::Fill && among.size() > kManyShares) crowded_.insert(wall);
  std::uint64_t& next = nextShares_[wall];
  next = std::max(next, frame + 1 + options_.sampleEvery * (among.size() / kManyShares));
  shared_.push_back(std::move(s));
}

DrawSample FrameLogOptions::drawSample(std::uint64_t frame, std::uint64_t every) const {
  if (!samples || frame < from) return DrawSample::None;
  const std::uint64_t phase = frame % every;
  return phase == sampleEvery / 2       ? (whole ? DrawSample::Whole : DrawSample::None)
         : phase == sampleEvery / 2 + 1 ? DrawSample::Some
                                        : DrawSample::None;
}

DrawSample FrameLog::drawSample(std::uint64_t frame, std::uint32_t wall) const {
  if (!samples_) return DrawSample::None;
  std::uint64_t every = options_.sampleEvery;
  {
    const std::lock_guard lock(mutex_);
    if (crowded_.contains(wall)) every *= kCrowdedEvery;
  }
  FrameLogOptions options = options_;
  options.samples = true;
  return options.drawSample(frame, every);
}

std::size_t FrameLog::nextBatch(std::uint32_t wall, std::uint32_t eye, std::size_t batches) {
  const std::lock_guard lock(mutex_);
  const std::size_t at = 2 * std::size_t{wall} + eye;
  if (next_.size() <= at) next_.resize(at + 1);
  const std::size_t now = next_[at] % batches;
  next_[at] = now + kBatchesAFrame < batches ? now + kBatchesAFrame : 0;
  return now;
}

void FrameLog::drewAlone(const DrawnAlone& drawn, std::span<const NodeShare> nodes) {
  track().disturb();
  const std::lock_guard lock(mutex_);
  alone_.push_back({drawn, {nodes.begin(), nodes.end()}});
}

namespace {

/// The track whose next record ended first: readers learn of all threads' frames side by side, however much
/// has come together.
std::optional<std::size_t> firstEnded(const std::vector<SpanTrack*>& tracks) {
  std::optional<std::size_t> first;
  ProfileClock::time_point ended;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const SpanRecord* next = tracks[i]->spans().next();
    if (next && (!first || next->ended < ended)) first = i, ended = next->ended;
  }
  return first;
}

}  // namespace

void FrameLog::collect() {
  std::vector<SpanTrack*> tracks;
  std::vector<SharedSpan> shared;
  std::vector<Alone> alone;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& t : tracks_) tracks.push_back(t.get());
    shared.swap(shared_), alone.swap(alone_);
  }
  SpanRecord record;
  while (const auto first = firstEnded(tracks))
    if (tracks[*first]->spans().take(record) && record.frame >= options_.from)
      for (SpanReader* reader : readers_) reader->take(*first, record);
  for (SpanTrack* t : tracks)
    for (CountRecord c; t->counts().take(c);)
      if (c.frame >= options_.from)
        for (SpanReader* reader : readers_) reader->take(c);
  for (const SharedSpan& s : shared)
    for (SpanReader* reader : readers_) reader->take(s);
  for (const Alone& a : alone)
    for (SpanReader* reader : readers_) reader->take(a.drawn, a.nodes);
  for (SpanReader* reader : readers_) reader->caughtUp();
}

std::uint64_t FrameLog::lost() const {
  const std::lock_guard lock(mutex_);
  std::uint64_t lost = 0;
  for (const auto& t : tracks_) lost += t->spans().lost() + t->counts().lost();
  return lost;
}

}  // namespace stadion
