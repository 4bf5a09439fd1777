#include "profiling/trace/trace_merge.h"

#include "engine/base/atomic_file.h"
#include "profiling/trace/trace_events.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string_view>

namespace stadion {
namespace {

using trace::Ticks;

constexpr std::string_view kEvent = "{\"ph\":\"";
constexpr std::size_t kMostHosts = 64;

std::size_t after(std::string_view line, std::string_view key) {
  const std::size_t at = line.find(key);
  return at == std::string_view::npos ? at : at + key.size();
}

std::optional<std::uint64_t> numberAfter(std::string_view line, std::string_view key) {
  const std::size_t at = after(line, key);
  if (at == std::string_view::npos) return std::nullopt;
  std::uint64_t number = 0;
  const auto [end, wrong] = std::from_chars(line.data() + at, line.data() + line.size(), number);
  return wrong == std::errc() ? std::optional(number) : std::nullopt;
}

/// "12.125" after the key, in eighths of a microsecond.
std::optional<Ticks> ticksAfter(std::string_view line, std::string_view key) {
  const std::size_t at = after(line, key);
  if (at == std::string_view::npos) return std::nullopt;
  double us = 0;
  const auto [end, wrong] = std::from_chars(line.data() + at, line.data() + line.size(), us);
  return wrong == std::errc() ? std::optional(static_cast<Ticks>(us * 8 + (us < 0 ? -0.5 : 0.5)))
                              : std::nullopt;
}

/// Replaces the number after the key.
void setNumber(std::string& line, std::string_view key, const std::string& number) {
  const std::size_t at = after(line, key);
  if (at == std::string::npos) return;
  const std::size_t end = line.find_first_not_of("0123456789.-", at);
  line.replace(at, end - at, number);
}

/// A trace, line by line.
class TraceLines {
public:
  explicit TraceLines(const std::string& file) : in_(file), file_(file) {}

  std::optional<Diagnostic> open() {
    std::string head;
    if (!in_ || !std::getline(in_, head)) return wrong("cannot be read");
    if (head.find("\"traceEvents\"") == std::string::npos) return wrong("is no trace of stadion");
    return {};
  }
  /// The next event; false at the end.
  bool next(std::string& line) {
    while (std::getline(in_, line))
      if (line.starts_with(kEvent)) {
        if (line.ends_with(',')) line.pop_back();
        return true;
      }
    return false;
  }

private:
  Diagnostic wrong(const char* why) const { return {Severity::Error, {file_, 0, 0}, why, {}}; }

  std::ifstream in_;
  std::string file_;
};

using SwapEnds = std::map<std::uint64_t, Ticks>;  ///< by frame

Result<SwapEnds> swapEndsIn(const std::string& file) {
  TraceLines lines(file);
  if (auto wrong = lines.open()) return *wrong;
  SwapEnds ends;
  for (std::string line; lines.next(line);) {
    if (line.find("\"name\":\"Swap\"") == std::string::npos) continue;
    const auto frame = numberAfter(line, "\"frame\":");
    const auto begin = ticksAfter(line, "\"ts\":"), length = ticksAfter(line, "\"dur\":");
    if (frame && begin && length) ends.try_emplace(*frame, *begin + *length);
  }
  return ends;
}

/// By how much the second clock is ahead, and over how many frames.
std::pair<Ticks, std::size_t> aheadOf(const SwapEnds& first, const SwapEnds& second) {
  std::vector<Ticks> apart;
  for (const auto& [frame, end] : second)
    if (const auto at = first.find(frame); at != first.end()) apart.push_back(end - at->second);
  if (apart.empty()) return {0, 0};
  const auto middle = apart.begin() + static_cast<std::ptrdiff_t>(apart.size() / 2);
  std::ranges::nth_element(apart, middle);
  return {*middle, apart.size()};
}

std::string microseconds(Ticks t) {
  return fmt::format("{}.{:03}", t / 8, t % 8 * 125);
}

/// Writes the events of a host as those of its own process.
std::optional<Diagnostic> addEvents(const TraceOfHost& of, std::size_t number, std::size_t hosts, Ticks shift,
                                    AtomicFile& out, bool& isFirst) {
  TraceLines lines(of.file);
  if (auto wrong = lines.open()) return wrong;
  const auto add = [&](const std::string& line) {
    out.write(isFirst ? line : ",\n" + line);
    isFirst = false;
  };
  add(fmt::format(R"({{"ph":"M","pid":{},"name":"process_name","args":{{"name":{}}}}})", number + 1,
                  trace::jsonText(of.host)));
  add(fmt::format(R"({{"ph":"M","pid":{},"name":"process_sort_index","args":{{"sort_index":{}}}}})",
                  number + 1, number));
  for (std::string line; lines.next(line);) {
    if (line.find("\"name\":\"process_name\"") != std::string::npos) continue;
    setNumber(line, "\"pid\":", std::to_string(number + 1));
    if (const auto at = ticksAfter(line, "\"ts\":")) setNumber(line, "\"ts\":", microseconds(*at + shift));
    // Arrows of different hosts must not have a common number.
    if (line.find("\"bp\":\"e\"") != std::string::npos)
      if (const auto id = numberAfter(line, "\"id\":"))
        setNumber(line, "\"id\":", std::to_string(*id * hosts + number));
    add(line);
  }
  return {};
}

}  // namespace

Result<std::vector<AlignedHost>> mergeTraces(std::span<const TraceOfHost> traces, const std::string& file) {
  if (traces.size() > kMostHosts)
    return Result<std::vector<AlignedHost>>::failure(
        fmt::format("at most {} traces can be merged", kMostHosts));
  std::vector<SwapEnds> ends;
  for (const TraceOfHost& t : traces) {
    auto of = swapEndsIn(t.file);
    if (!of) return of.error();
    ends.push_back(std::move(of.value()));
  }
  std::vector<Ticks> ahead;
  std::vector<AlignedHost> aligned;
  for (std::size_t i = 0; i < traces.size(); ++i) {
    const auto [apart, frames] = aheadOf(ends.front(), ends[i]);
    ahead.push_back(apart);
    aligned.push_back({traces[i].host, -static_cast<double>(apart) / 8, frames});
  }
  const Ticks most = *std::ranges::max_element(ahead);  // so that no time is negative
  AtomicFile out(file);
  if (out.error()) return *out.error();
  out.write("{\"displayTimeUnit\":\"ms\",\"traceEvents\":[\n");
  bool isFirst = true;
  for (std::size_t i = 0; i < traces.size(); ++i)
    if (auto wrong = addEvents(traces[i], i, traces.size(), most - ahead[i], out, isFirst)) return *wrong;
  std::string end = "\n],\"otherData\":{\"hosts\":[";
  for (const AlignedHost& a : aligned)
    end += fmt::format("{}{{\"host\":{},\"shift us\":{:.3f},\"common frames\":{}}}",
                       &a == &aligned.front() ? "" : ",", trace::jsonText(a.host), a.shiftUs, a.commonFrames);
  out.write(end + "]}}\n");
  if (const auto wrong = out.commit()) return *wrong;
  return aligned;
}

std::vector<TraceOfHost> tracesOf(const std::vector<std::string>& files) {
  std::vector<std::string> names;
  for (const std::string& f : files) names.push_back(std::filesystem::path(f).stem().string());
  std::size_t common = 0;
  if (names.size() > 1)
    while (std::ranges::all_of(names, [&](const std::string& n) {
      return n.size() > common + 1 && n[common] == names.front()[common];
    }))
      ++common;
  // Names may begin alike themselves: a dash ends what all have in common.
  common = names.empty() ? 0 : names.front().substr(0, common).rfind('-') + 1;
  std::vector<TraceOfHost> traces;
  for (std::size_t i = 0; i < files.size(); ++i) traces.push_back({names[i].substr(common), files[i]});
  return traces;
}

}  // namespace stadion
