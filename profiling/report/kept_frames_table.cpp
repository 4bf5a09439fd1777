#include "profiling/report/kept_frames_table.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

bool isOfSomeNode(const KeptSpan& s) {
  return s.node.valid();
}

}  // namespace

bool Stretch::covers(std::uint64_t frame) const {
  return frame + KeptFrames::kBefore >= about && frame <= about + KeptFrames::kAfter;
}

void KeptFrames::take(std::size_t number, const SpanRecord& r) {
  Track& track = tracks_[number];
  if (r.depth > 0) {
    track.parts.push_back(r);
    return;
  }
  if (r.frame == kNoFrame) {
    track.waits.add(r);
    track.parts.clear();
    return;
  }
  for (const SpanRecord& wait : track.waits) add(r.frame, number, wait);
  add(r.frame, number, r);
  for (const SpanRecord& part : track.parts) add(r.frame, number, part);
  track.waits.clear();
  track.parts.clear();
}

/// For spans of nodes, there is room only for the most expensive ones.
void KeptFrames::add(std::uint64_t number, std::size_t track, const SpanRecord& r) {
  const auto ns = [&](ProfileClock::time_point t) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(t - began_).count();
  };
  KeptFrame& frame = frames_[number];
  const KeptSpan span{track,   r.what,      r.wall,      r.node,
                      r.depth, ns(r.began), ns(r.ended), static_cast<float>(r.took)};
  if (isOfSomeNode(span)) {
    const auto nodes = std::ranges::count_if(frame.spans, isOfSomeNode);
    if (static_cast<std::size_t>(nodes) >= kNodesAFrame) {
      const auto least = std::ranges::min_element(frame.spans, {}, [](const KeptSpan& s) {
        return s.node.valid() ? s.ms : std::numeric_limits<float>::infinity();
      });
      if (least->ms < span.ms) *least = span;
      return;
    }
  }
  frame.spans.push_back(span);
}

void KeptFrames::shown(const FrameFacts& facts) {
  KeptFrame& frame = frames_[facts.frame];
  frame.facts = facts;
  frame.sampled = facts.sampled != 0;
  consider(facts);
  forget();
}

void KeptFrames::consider(const FrameFacts& f) {
  if (f.period > 0 && f.sampled == 0) {
    // Of overlapping stretches only the worst one counts.
    const auto near = std::ranges::find_if(worst_, [&](const Stretch& s) { return s.covers(f.frame); });
    const Stretch now{f.frame, static_cast<double>(f.period)};
    if (near == worst_.end())
      worst_.push_back(now);
    else if (near->score < now.score)
      *near = now;
    std::ranges::sort(worst_, std::ranges::greater(), &Stretch::score);
    if (worst_.size() > kWorst) worst_.pop_back();
  }
  // Candidates are evenly spaced; if there are too many, every second one is dropped.
  if (f.frame < kAfter || (f.frame - kAfter) % candidateEvery_ != 0) return;
  Stretch candidate{f.frame - kAfter, 0};
  double sum = 0, count = 0;
  for (const auto& [number, frame] : frames_)
    if (candidate.covers(number) && frame.facts.period > 0 && !frame.sampled) {
      sum += static_cast<double>(frame.facts.period);
      ++count;
    }
  if (count < static_cast<double>(kBefore)) return;
  candidate.score = sum / count;
  candidates_.push_back(candidate);
  if (candidates_.size() <= kCandidates) return;
  candidateEvery_ *= 2;
  std::erase_if(candidates_, [&](const Stretch& s) { return s.about % candidateEvery_ != 0; });
}

void KeptFrames::forget() {
  if (frames_.size() <= kRecent) return;
  const std::uint64_t newest = frames_.rbegin()->first;
  std::erase_if(frames_, [&](const auto& entry) {
    const auto covers = [&](const Stretch& s) { return s.covers(entry.first); };
    return entry.first + kRecent < newest && std::ranges::none_of(worst_, covers) &&
           std::ranges::none_of(candidates_, covers);
  });
}

const Stretch* KeptFrames::normal(double period) const {
  const auto at =
      std::ranges::min_element(candidates_, {}, [&](const Stretch& s) { return std::abs(s.score - period); });
  return at == candidates_.end() ? nullptr : &*at;
}

}  // namespace stadion
