#include "profiling/trace/trace_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace stadion {
namespace {

constexpr std::size_t kFlushAt = 1 << 16;

/// Returns the category: the kind of time.
std::string_view categoryOf(Span what) {
  if (isWait(what)) return "wait";
  if (isStage(what)) return "stage";
  if (isOfNode(what) || what == Span::Settle) return "node";
  return "part";
}

}  // namespace

TraceFile::TraceFile(TraceOptions options, const NodeNames& names)
    : options_(std::move(options)), names_(names), file_(options_.file), threads_(options_.walls) {
  text_ = "{\"displayTimeUnit\":\"ms\",\"traceEvents\":[\n";
  trace::addProcessName(text_, "stadion " + options_.show);
}

void TraceFile::take(std::size_t number, const SpanRecord& r) {
  Track& track = tracks_[number];
  if (r.depth > 0) {
    track.spans.push_back(r);
    return;
  }
  if (r.frame == kNoFrame) {
    track.spans.clear();
    track.waits.add(r);
    return;
  }
  threads_.see(number, r);
  if (r.what == Span::App) {
    oldestFrame_ = std::min(oldestFrame_, r.frame);
    newestFrame_ = std::max(newestFrame_, r.frame);
  }
  if (cutFrom_ == kNoFrame && bytes_ + text_.size() > options_.mostBytes) cutFrom_ = newestFrame_ + 1;
  if (isAsked(r.frame)) write(number, r);
  track.spans.clear();
  track.waits.clear();
}

/// A counter keeps its value until the next one.
void TraceFile::take(const CountRecord& c) {
  if (!isAsked(c.frame)) return;
  std::string name(nameOf(c.what));
  if (c.node.valid()) name += " of " + nameOfNode(c.node).path;
  if (c.wall < options_.walls.size()) name += ", " + options_.walls[c.wall];
  if (c.within == Span::LeftEye || c.within == Span::RightEye)
    name += c.within == Span::LeftEye ? " left" : " right";
  const auto [at, isNew] = lastCounts_.try_emplace(name, c.amount);
  if (!isNew && std::exchange(at->second, c.amount) == c.amount) return;
  trace::addCounter(text_, name, "count", ticks(c.when), static_cast<double>(c.amount));
}

/// Writes a stage with all its parts. If two slices begin together, viewers take the first for the outer one.
void TraceFile::write(std::size_t number, const SpanRecord& root) {
  Track& track = tracks_[number];
  for (const SpanRecord& wait : track.waits) writeSpan(number, wait, root.frame);
  // Parts of a stage with a lost record lie outside of this one.
  std::erase_if(track.spans,
                [&](const SpanRecord& s) { return s.began < root.began || s.ended > root.ended; });
  std::ranges::sort(track.spans, [](const SpanRecord& a, const SpanRecord& b) {
    return a.began != b.began ? a.began < b.began : a.depth < b.depth;
  });
  writeSpan(number, root, root.frame);
  writeFlow(number, root);
  for (const SpanRecord& span : track.spans) {
    writeSpan(number, span, root.frame);
    writeFlow(number, span);
  }
  if (text_.size() > kFlushAt) flush();
}

void TraceFile::writeSpan(std::size_t number, const SpanRecord& r, std::uint64_t frame) {
  const bool ofNode = r.node.valid();
  std::string name, args = fmt::format("\"frame\":{},\"ms\":{:.6f}", frame, r.took);
  if (r.wall < options_.walls.size()) args += ",\"wall\":" + trace::jsonText(options_.walls[r.wall]);
  if (ofNode) {
    const Name& node = nameOfNode(r.node);
    name = node.text;
    args += fmt::format(",\"phase\":\"{}\"{}", nameOf(r.what), node.args);
  } else {
    std::string plain(nameOf(r.what));
    if (isStage(r.what)) plain[0] = static_cast<char>(plain[0] - 'a' + 'A');
    name = trace::jsonText(plain);
  }
  if (isStage(r.what)) args += fmt::format(",\"processor ms\":{:.3f}", r.use.processor);
  if (r.what == Span::Draw && r.disturbed) args += R"(,"sampled":"eyes or batches were drawn alone")";
  trace::addSlice(text_, {name, categoryOf(r.what), number + 1, ticks(r.began), ticks(r.ended), args});
}

/// While the operator pauses, a frame comes more than once: only the first is written.
bool TraceFile::isFirst(Span stage, std::uint32_t wall, std::uint64_t frame) {
  const auto [at, isNew] = newest_.try_emplace({stage, wall}, frame);
  if (!isNew && frame <= at->second) return false;
  at->second = frame;
  return true;
}

void TraceFile::writeFlow(std::size_t number, const SpanRecord& r) {
  const std::uint64_t walls = options_.walls.size();
  const auto point = [&](trace::FlowPoint p, std::uint64_t wall) {
    trace::addFlow(text_, p, r.frame * walls + wall + 1, number + 1, ticks(r.began));
  };
  if (r.what == Span::Swap && isFirst(r.what, kNoWall, r.frame)) {
    const trace::Ticks now = ticks(r.ended);
    if (lastShown_)
      trace::addCounter(text_, "frame to frame", "ms", now,
                        0.000125 * static_cast<double>(now - *lastShown_));
    lastShown_ = now;
  }
  if (r.what == Span::App && isFirst(r.what, kNoWall, r.frame))
    for (std::uint64_t wall = 0; wall < walls; ++wall) point(trace::FlowPoint::Start, wall);
  if (r.what == Span::Cull && r.wall < walls && isFirst(r.what, r.wall, r.frame))
    point(trace::FlowPoint::Step, r.wall);
  if (r.what == Span::Draw && r.wall < walls && isFirst(r.what, r.wall, r.frame))
    point(trace::FlowPoint::End, r.wall);
}

const TraceFile::Name& TraceFile::nameOfNode(NodeRef node) {
  const auto at = nodes_.find(node);
  if (at != nodes_.end()) return at->second;
  const auto name = names_.find(node);
  if (!name) {
    const std::string plain = fmt::format("node {} of file {}", node.position, node.load);
    unknown_ = {trace::jsonText(plain), "", plain};
    return unknown_;
  }
  const std::string place = fmt::format("{}:{}", name->file, name->line);
  return nodes_[node] = {
             trace::jsonText(name->path),
             fmt::format(",\"kind\":{},\"script\":{}", trace::jsonText(name->type), trace::jsonText(place)),
             name->path};
}

trace::Ticks TraceFile::ticks(ProfileClock::time_point t) const {
  const auto ns = std::chrono::duration_cast<std::chrono::nanoseconds>(t - began_).count();
  return trace::ticksOf(std::max<std::int64_t>(0, ns));
}

void TraceFile::flush() {
  file_.write(text_);
  bytes_ += text_.size();
  text_.clear();
}

std::string TraceFile::leftOut() const {
  std::string left;
  const auto add = [&](const std::string& what) { left += (left.empty() ? "" : "; ") + what; };
  const auto frames = [](std::uint64_t from, std::uint64_t to) {
    return from == to ? fmt::format("frame {}", from) : fmt::format("frames {} to {}", from, to);
  };
  const auto [first, last] = std::pair(options_.first, options_.last);
  const bool anyRecorded = oldestFrame_ != kNoFrame, someAsked = last != kNoFrame;
  if (someAsked && !anyRecorded) add(frames(first, last) + ": no frame was recorded");
  if (someAsked && anyRecorded && first < oldestFrame_)
    add(fmt::format("{}: recording began with frame {}", frames(first, std::min(last, oldestFrame_ - 1)),
                    oldestFrame_));
  if (cutFrom_ != kNoFrame && newestFrame_ >= cutFrom_ && cutFrom_ <= last)
    add(fmt::format("frames from {} on: the trace would be larger than {:g} MB", cutFrom_,
                    1e-6 * static_cast<double>(options_.mostBytes)));
  if (someAsked && anyRecorded && last > newestFrame_)
    add(fmt::format("{}: the run ended with frame {}", frames(std::max(first, newestFrame_ + 1), last),
                    newestFrame_));
  return left;
}

std::optional<Diagnostic> TraceFile::finish() {
  std::size_t place = 0;
  for (const auto& [track, name] : threads_.threads()) trace::addThreadName(text_, track + 1, name, place++);
  text_.erase(text_.size() - 2);  // the last comma
  text_ += "\n],\"otherData\":{\"show\":" + trace::jsonText(options_.show);
  text_ += ",\"times\":\"ms is what a span took, less what recording it took; its length includes that\"";
  if (const std::string left = leftOut(); !left.empty()) text_ += ",\"left out\":" + trace::jsonText(left);
  text_ += "}}\n";
  flush();
  return file_.commit();
}

}  // namespace stadion
