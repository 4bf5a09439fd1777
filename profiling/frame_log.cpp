#include "profiling/frame_log.h"

#include <optional>
#include <utility>

namespace stadion {
namespace {

constexpr std::chrono::milliseconds kNap{2};

std::uint64_t nextNumber() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

/// Of many spans in one another, in this thread now.
SpanOverhead measureOverhead() {
  constexpr int kSpansMeasured = 2000;
  SpanTrack track;
  double inside = 0, own = 0;
  // The second time nothing is touched for the first time any more.
  for (int round = 0; round < 2; ++round) {
    track.began(Span::App, 0, kNoWall, {});
    for (int i = 0; i < kSpansMeasured; ++i) track.began(Span::Simulate, 0, kNoWall, {}), track.ended();
    track.ended();
    SpanRecord r;
    for (inside = 0; track.take(r);) (r.what == Span::App ? own : inside) += r.own;
    if (round == 0) own = 0;
  }
  constexpr double kNanosecondsEach = 1e6 / kSpansMeasured;
  return {inside * kNanosecondsEach, own * kNanosecondsEach};
}

}  // namespace

FrameLog::FrameLog(std::vector<SpanReader*> readers, FrameLogOptions options)
    : readers_(std::move(readers)), options_(options), overhead_(measureOverhead()), number_(nextNumber()),
      collector_([this] {
        while (!done_) {
          collect();
          std::this_thread::sleep_for(kNap);
        }
      }) {}

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
  if (what == Span::App) appFrame_.store(frame, std::memory_order_relaxed);
  track().began(what, frame, wall, {});
}

// What runs on no stage's thread, runs for App.
void FrameLog::began(Span what, NodeRef node) {
  SpanTrack& t = track();
  const std::uint64_t frame = t.frame();
  t.began(what, frame != kNoFrame ? frame : appFrame_.load(std::memory_order_relaxed), t.wall(), node);
}

void FrameLog::ended(Span) {
  track().ended();
}

bool FrameLog::wantsShares(std::uint64_t frame, std::uint32_t) const {
  return options_.samples && frame >= options_.from && frame % options_.sampleEvery == 0;
}

void FrameLog::shared(Span what, std::uint64_t frame, std::uint32_t wall, std::span<const NodeRef> among) {
  SharedSpan s{what, frame, wall, track().last(what), {among.begin(), among.end()}};
  const std::lock_guard lock(mutex_);
  shared_.push_back(std::move(s));
}

DrawSample FrameLogOptions::drawSample(std::uint64_t frame) const {
  if (!samples || frame < from) return DrawSample::None;
  const std::uint64_t phase = frame % sampleEvery;
  return phase == sampleEvery / 2       ? (whole ? DrawSample::Whole : DrawSample::None)
         : phase == sampleEvery / 2 + 1 ? DrawSample::Some
                                        : DrawSample::None;
}

DrawSample FrameLog::drawSample(std::uint64_t frame, std::uint32_t) const {
  return options_.drawSample(frame);
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
    const SpanRecord* next = tracks[i]->next();
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
    if (tracks[*first]->take(record) && record.frame >= options_.from)
      for (SpanReader* reader : readers_) reader->take(*first, record);
  for (const SharedSpan& s : shared)
    for (SpanReader* reader : readers_) reader->take(s);
  for (const Alone& a : alone)
    for (SpanReader* reader : readers_) reader->take(a.drawn, a.nodes);
  for (SpanReader* reader : readers_) reader->caughtUp();
}

std::uint64_t FrameLog::lost() const {
  const std::lock_guard lock(mutex_);
  std::uint64_t lost = 0;
  for (const auto& t : tracks_) lost += t->lost();
  return lost;
}

}  // namespace stadion
