#include "profiling/frame_log.h"

#include <algorithm>
#include <utility>

namespace stadion {
namespace {

constexpr std::chrono::milliseconds kNap{2};
/// Spans of nodes that simulate, of which a visit has one or two beside four others: beyond the first figure
/// a frame is light, and the second is what is recorded on average.
constexpr std::uint64_t kManyNodeSpans = 600, kNodeSpansAFrame = 60;
/// Nodes among which a span is shared: of more, it is asked for more rarely.
constexpr std::uint64_t kManyShares = 500;
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
    : readers_(std::move(readers)), options_(options), number_(nextNumber()) {
  measureOverhead();
  collector_ = std::thread([this] {
    while (!done_) {
      collect();
      std::this_thread::sleep_for(kNap);
    }
  });
}

/// Of many spans in one another, in this thread now: of as many as there is room for, so that each record is
/// written where none has been for a while, as in a show.
void FrameLog::measureOverhead() {
  constexpr int kSpansMeasured = SpanTrack::kCapacity - 2;
  FrameProbe& probe = *this;
  const auto began = ProfileClock::now();
  const std::uint64_t beganTicks = TickClock::now();
  double inside = 0, own = 0;
  // The second time nothing is touched for the first time any more.
  for (int round = 0; round < 2; ++round) {
    probe.began(Span::App, 0, kNoWall);
    for (int i = 0; i < kSpansMeasured; ++i) {
      const SpanScope span(&probe, Span::Simulate, NodeRef{1, 0});
    }
    probe.ended(Span::App);
    inside = own = 0;
    for (SpanRecord r; track().take(r);) (r.what == Span::App ? own : inside) += r.own;
    track().takeCount();
  }
  const double ns = std::chrono::duration<double, std::nano>(ProfileClock::now() - began).count();
  nanosecondsATick_ = ns / static_cast<double>(std::max<std::uint64_t>(1, TickClock::now() - beganTicks));
  dearTicks_ =
      static_cast<std::uint64_t>(std::chrono::duration<double, std::nano>(kDear).count() / nanosecondsATick_);
  constexpr double kNanosecondsEach = 1e6 / kSpansMeasured;
  overhead_ = {inside * kNanosecondsEach, own * kNanosecondsEach};
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

/// As many spans as in the frame before are expected.
void FrameLog::beginApp(SpanTrack& t, std::uint64_t frame) {
  appFrame_.store(frame, std::memory_order_relaxed);
  const std::uint64_t spans = t.takeCount();
  const bool light = spans > kManyNodeSpans && (frame < nextWhole_ || frame < options_.from);
  if (!light) nextWhole_ = frame + 1 + spans / kNodeSpansAFrame;
  light_.store(light, std::memory_order_relaxed);
  t.setWhole(!light);
}

// What runs on no stage's thread, runs for App.
void FrameLog::began(Span what, NodeRef node) {
  if (isOfVisit(what) && light_.load(std::memory_order_relaxed)) {
    if (what == Span::Simulate) track().beganLightly(node);
    return;
  }
  SpanTrack& t = track();
  if (what == Span::Simulate) t.count();
  const std::uint64_t frame = t.frame();
  t.began(what, frame != kNoFrame ? frame : appFrame_.load(std::memory_order_relaxed), t.wall(), node);
}

void FrameLog::ended(Span what) {
  if (!isOfVisit(what) || !light_.load(std::memory_order_relaxed))
    track().ended();
  else if (what == Span::Simulate)
    track().endedLightly(what, appFrame_.load(std::memory_order_relaxed), dearTicks_, nanosecondsATick_);
}

bool FrameLog::wantsShares(std::uint64_t frame, std::uint32_t wall) const {
  if (!options_.samples || frame < options_.from || frame % options_.sampleEvery != 0) return false;
  const std::lock_guard lock(mutex_);
  const auto next = nextShares_.find(wall);
  return next == nextShares_.end() || frame >= next->second;
}

void FrameLog::shared(Span what, std::uint64_t frame, std::uint32_t wall, std::span<const NodeRef> among) {
  track().disturb();
  SharedSpan s{what, frame, wall, track().last(what), {among.begin(), among.end()}};
  const std::lock_guard lock(mutex_);
  std::uint64_t& next = nextShares_[wall];
  next = std::max(next, frame + 1 + options_.sampleEvery * (among.size() / kManyShares));
  shared_.push_back(std::move(s));
}

DrawSample FrameLog::drawSample(std::uint64_t frame, std::uint32_t) const {
  if (!options_.samples || frame < options_.from) return DrawSample::None;
  const std::uint64_t phase = frame % options_.sampleEvery;
  return phase == options_.sampleEvery / 2       ? DrawSample::Whole
         : phase == options_.sampleEvery / 2 + 1 ? DrawSample::Some
                                                 : DrawSample::None;
}

std::size_t FrameLog::nextBatch(std::uint32_t wall, std::uint32_t eye, std::size_t batches) {
  const std::lock_guard lock(mutex_);
  const std::size_t at = 2 * std::size_t{wall} + eye;
  if (next_.size() <= at) next_.resize(at + 1);
  const std::size_t now = next_[at] % batches;
  next_[at] = now + kBatchesAFrame < batches ? now + kBatchesAFrame : 0;
  return now;
}

void FrameLog::drewAlone(const DrawnAlone& drawn, std::span<const NodeRef> nodes) {
  track().disturb();
  const std::lock_guard lock(mutex_);
  alone_.push_back({drawn, {nodes.begin(), nodes.end()}});
}

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
  for (std::size_t i = 0; i < tracks.size(); ++i)
    while (tracks[i]->take(record))
      if (record.frame >= options_.from)
        for (SpanReader* reader : readers_) reader->take(i, record);
  for (const SharedSpan& s : shared)
    for (SpanReader* reader : readers_) reader->take(s);
  for (const Alone& a : alone)
    for (SpanReader* reader : readers_) reader->take(a.drawn, a.nodes);
}

std::uint64_t FrameLog::lost() const {
  const std::lock_guard lock(mutex_);
  std::uint64_t lost = 0;
  for (const auto& t : tracks_) lost += t->lost();
  return lost;
}

}  // namespace stadion
