#include "profiling/record/frame_facts.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <utility>
#include <vector>

namespace stadion {
namespace {

constexpr float kLate = 1.5f;               ///< of the budget
constexpr float kNamedFrom = 0.05f;         ///< [ms] the most expensive node is named from here on
constexpr std::uint32_t kManyFaults = 500;  ///< pages; some 2 MB

struct Suspect {
  const StageFacts* facts;
  Span stage;
  std::uint32_t wall;
  float all() const { return facts->ms + facts->turn + facts->late; }
};

/// Returns all stages with a meaningful time.
std::vector<Suspect> suspectsOf(const FrameFacts& f) {
  std::vector<Suspect> all{{&f.app, Span::App, 0}};
  for (std::uint32_t wall = 0; wall < f.walls; ++wall) {
    all.push_back({&f.cull[wall], Span::Cull, wall});
    if (f.sampled == 0) all.push_back({&f.draw[wall], Span::Draw, wall});
  }
  all.push_back({&f.swap, Span::Swap, 0});
  return all;
}

float sumOf(const std::vector<Suspect>& stages) {
  float sum = 0;
  for (const Suspect& s : stages) sum += s.all();
  return sum;
}

/// Returns the longest stage, its turn included. In a sequential run, all walls of a stage count together.
Suspect longest(const FrameFacts& f, const std::vector<Suspect>& stages) {
  std::map<Span, float> together;
  for (const Suspect& s : stages) together[s.stage] += s.all();
  return *std::ranges::max_element(stages, {}, [&](const Suspect& s) {
    return std::pair(f.sequential != 0 ? together[s.stage] : 0, s.all());
  });
}

/// Returns the slowest of the walls, except one.
std::uint32_t mostExpensiveDraw(const FrameFacts& f, std::uint32_t except) {
  std::uint32_t mostExpensive = except == 0 && f.walls > 1 ? 1 : 0;
  for (std::uint32_t wall = mostExpensive + 1; wall < f.walls; ++wall)
    if (wall != except && f.draw[wall].ms > f.draw[mostExpensive].ms) mostExpensive = wall;
  return mostExpensive;
}

Cause causeOf(const Suspect& s, float budget) {
  const StageFacts& stage = *s.facts;
  const float excess = std::max(s.all() - 0.5f * budget, 0.1f * s.all());
  if (stage.loading > 0.5f * excess) return Cause::Loading;
  if (stage.turn > stage.ms + stage.late) return Cause::Turn;
  if (stage.delayed + stage.late > 0.5f * excess) return Cause::Preempted;
  // Draw waits for the rasteriser's threads: its own processor time says nothing.
  const float lost = s.stage == Span::Draw ? 0 : stage.ms - stage.processor - stage.delayed;
  if (lost > 0.5f * excess && stage.faults > kManyFaults) return Cause::PageFaults;
  return s.stage == Span::App    ? Cause::App
         : s.stage == Span::Cull ? Cause::Cull
         : s.stage == Span::Draw ? Cause::Draw
                                 : Cause::Swap;
}

/// The delay of a stage's start.
struct Wait {
  Span stage;
  std::uint32_t wall;
  float ms;
};

float ended(const StageFacts& s) {
  return s.at + s.ms + s.turn;
}

/// Returns the waits: App's, if it starts later than a frame after the previous App. Then those of the later
/// stages on the wall that was drawn last, from the stage before and from the previous frame's swap.
std::array<Wait, 4> waitsOf(const FrameFacts& f) {
  std::uint32_t last = 0;
  for (std::uint32_t wall = 1; wall < f.walls; ++wall)
    if (ended(f.draw[wall]) > ended(f.draw[last])) last = wall;
  const auto between = [](const StageFacts& before, const StageFacts& after) {
    return after.at - std::max(0.0f, ended(before));
  };
  const bool overlap = f.sequential == 0;
  return {{{Span::App, 0, f.sinceApp - f.budget},
           {Span::Cull, last, overlap ? between(f.app, f.cull[last]) : 0},
           {Span::Draw, last, overlap ? between(f.cull[last], f.draw[last]) : 0},
           {Span::Swap, 0, between(f.draw[last], f.swap)}}};
}

/// Returns the cause for a frame with short stages. A wait for a tick lasts longer than a frame only if the
/// thread overslept.
Cause causeOf(const Wait& wait, const FrameFacts& f) {
  if (wait.ms < 0.25f * (f.period - f.budget)) return Cause::Unknown;
  const bool follows = wait.stage == Span::App && f.tick < 1.1f * f.budget;
  return follows ? Cause::Follows : Cause::Woken;
}

const StageFacts& factsOf(const FrameFacts& f) {
  return f.stage == Span::App    ? f.app
         : f.stage == Span::Cull ? f.cull[f.wall]
         : f.stage == Span::Draw ? f.draw[f.wall]
                                 : f.swap;
}

std::string stageText(const FrameFacts& f, std::span<const std::string> walls) {
  std::string stage(nameOf(f.stage));
  stage[0] = static_cast<char>(stage[0] - 'a' + 'A');
  return (f.stage != Span::Cull && f.stage != Span::Draw) || f.wall >= walls.size()
             ? stage
             : stage + " of wall " + walls[f.wall];
}

}  // namespace

std::string_view nameOf(Cause cause) {
  switch (cause) {
  case Cause::None: return "none";
  case Cause::App: return "App over";
  case Cause::Cull: return "Cull over";
  case Cause::Draw: return "Draw over";
  case Cause::Turn: return "waiting for a wall";
  case Cause::Preempted: return "pre-empted";
  case Cause::PageFaults: return "page faults";
  case Cause::Loading: return "loading";
  case Cause::Swap: return "Swap over";
  case Cause::Follows: return "follows a late frame";
  case Cause::Woken: return "woken late";
  case Cause::Unknown: break;
  }
  return "unknown";
}

void judge(FrameFacts& f) {
  f.cause = Cause::None;
  if (f.budget <= 0 || f.period <= kLate * f.budget) return;
  const std::vector<Suspect> stages = suspectsOf(f);
  const Suspect s = longest(f, stages);
  f.stage = s.stage;
  f.wall = s.wall;
  f.holder = mostExpensiveDraw(f, f.wall);
  // Each stage may be short, and all together long.
  const bool tookLong = std::max(s.all(), sumOf(stages)) >= 0.5f * f.budget;
  if (tookLong) {
    f.cause = causeOf(s, f.budget);
  } else if (f.sampled == 0) {
    const auto waits = waitsOf(f);
    const Wait& wait = *std::ranges::max_element(waits, {}, &Wait::ms);
    f.stage = wait.stage;
    f.wall = wait.wall;
    f.waited = wait.ms;
    f.cause = causeOf(wait, f);
  }
}

bool nodeExplains(const FrameFacts& f) {
  return f.cause == Cause::App && f.nodeMs >= kNamedFrom;
}

namespace {

/// ": Draw of wall floor took 41.2 ms".
std::string causeText(const FrameFacts& f, std::span<const std::string> walls) {
  std::string text, stage = stageText(f, walls);
  if (f.stage == Span::App && f.appFrame < f.frame)
    stage += fmt::format(" of frame {}, not shown,", f.appFrame);
  const StageFacts& s = factsOf(f);
  const float all = sumOf(suspectsOf(f));
  // It did not take long by itself.
  const std::string together = s.ms + s.turn + s.late < 0.5f * f.budget || f.sequential != 0
                                   ? fmt::format(", which with the other stages came to {:.1f} ms", all)
                                   : "";
  switch (f.cause) {
  case Cause::Turn:
    text += fmt::format(": {} waited {:.1f} ms for other walls, most of it for {}", stage, s.turn,
                        f.holder < walls.size() ? walls[f.holder] : "?");
    break;
  case Cause::Preempted:
    if (s.late > s.delayed)
      text += fmt::format(": {} began {:.1f} ms late without a processor, which others had", stage, s.late);
    else
      text += fmt::format(": {} took {:.1f} ms, {:.1f} of them without a processor, which others had", stage,
                          s.ms, s.delayed);
    break;
  case Cause::PageFaults: text += fmt::format(": {} waited for {} pages of memory", stage, s.faults); break;
  case Cause::Loading: text += fmt::format(": {} took {:.1f} ms to load", stage, s.loading); break;
  case Cause::Swap: text += fmt::format(": showing it took {:.1f} ms", s.ms); break;
  case Cause::Follows:
    text += f.slot > 0.5f * f.waited
                ? fmt::format(": App waited {:.1f} ms for earlier frames to be drawn", f.slot)
                : fmt::format(": App had missed its tick for the frame before, and began {:.1f} ms late",
                              f.waited);
    break;
  case Cause::Woken:
    text += f.stage == Span::App
                ? fmt::format(": the system woke App {:.1f} ms after its tick", f.waited)
                : fmt::format(": {} was woken {:.1f} ms after what it waited for was done", stage, f.waited);
    break;
  case Cause::Unknown:
    text +=
        fmt::format(": no stage took long, all together {:.1f} ms; App began {:.1f} ms after App before it, "
                    "and {:.1f} ms after the frame before was shown",
                    all, f.sinceApp, f.app.at);
    break;
  default: text += fmt::format(": {} took {:.1f} ms{}", stage, s.ms, together);
  }
  if (f.name[0] != 0 && nodeExplains(f))
    text += fmt::format("; most expensive: {}, {:.1f} ms", f.name, f.nodeMs);
  const bool over = f.cause == Cause::Cull || f.cause == Cause::Draw;
  if (f.most[0] != 0 && over)
    text += fmt::format("; most there is to {} of {}", f.cause == Cause::Cull ? "cull" : "draw", f.most);
  return text;
}

}  // namespace

std::string toText(const FrameFacts& f, std::span<const std::string> walls) {
  std::string text = fmt::format("frame {} came after {:.1f} ms ({:.1f})", f.frame, f.period, f.budget);
  if (f.cause != Cause::None) text += causeText(f, walls);
  if (f.over[0] != 0)
    text += fmt::format("; over budget: {}, {:.1f} ms of {:g}", f.over, f.overMs, f.overBudget);
  return text;
}

}  // namespace stadion
