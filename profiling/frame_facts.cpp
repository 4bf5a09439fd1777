#include "profiling/frame_facts.h"

#include <algorithm>
#include <fmt/format.h>

namespace stadion {
namespace {

constexpr float kLate = 1.5f;               ///< of the budget
constexpr std::uint32_t kManyFaults = 500;  ///< pages; some 2 MB

struct Suspect {
  const StageFacts* facts;
  Span stage;
  std::uint32_t wall;
  float all() const { return facts->ms + facts->turn; }
};

/// The stage that took longest, its turn included.
Suspect longest(const FrameFacts& f) {
  Suspect worst{&f.app, Span::App, 0};
  for (std::uint32_t wall = 0; wall < f.walls; ++wall) {
    const Suspect cull{&f.cull[wall], Span::Cull, wall}, draw{&f.draw[wall], Span::Draw, wall};
    for (const Suspect& s : {cull, draw})
      if (s.all() > worst.all()) worst = s;
  }
  return worst;
}

/// Of the walls but one.
std::uint32_t dearestDraw(const FrameFacts& f, std::uint32_t except) {
  std::uint32_t dearest = except == 0 && f.walls > 1 ? 1 : 0;
  for (std::uint32_t wall = dearest + 1; wall < f.walls; ++wall)
    if (wall != except && f.draw[wall].ms > f.draw[dearest].ms) dearest = wall;
  return dearest;
}

Cause causeOf(const Suspect& s, float budget) {
  const StageFacts& stage = *s.facts;
  if (s.all() < 0.5f * budget) return Cause::Unknown;
  const float excess = std::max(s.all() - 0.5f * budget, 0.1f * s.all());
  if (stage.loading > 0.5f * excess) return Cause::Loading;
  if (stage.turn > stage.ms) return Cause::Turn;
  // Draw waits for the rasteriser's threads: its own processor time says nothing.
  const bool draws = s.stage == Span::Draw;
  if (draws && stage.delayed > 0.5f * excess) return Cause::Preempted;
  const float lost = draws ? 0 : stage.ms - stage.processor;
  if (lost > 0.5f * excess && stage.faults > kManyFaults) return Cause::PageFaults;
  if (lost > 0.5f * excess && stage.switches > 0) return Cause::Preempted;
  return s.stage == Span::App ? Cause::App : s.stage == Span::Cull ? Cause::Cull : Cause::Draw;
}

std::string stageText(const FrameFacts& f, std::span<const std::string> walls) {
  std::string stage(nameOf(f.stage));
  stage[0] = static_cast<char>(stage[0] - 'a' + 'A');
  return f.stage == Span::App || f.wall >= walls.size() ? stage : stage + " of wall " + walls[f.wall];
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
  case Cause::Unknown: break;
  }
  return "unknown";
}

void judge(FrameFacts& f) {
  f.cause = Cause::None;
  if (f.budget <= 0 || f.period <= kLate * f.budget) return;
  const Suspect s = longest(f);
  f.stage = s.stage, f.wall = s.wall;
  f.cause = causeOf(s, f.budget);
  f.holder = dearestDraw(f, f.wall);
}

namespace {

/// ": Draw of wall floor took 41.2 ms".
std::string causeText(const FrameFacts& f, std::span<const std::string> walls) {
  std::string text;
  const std::string stage = stageText(f, walls);
  const StageFacts& s = f.stage == Span::App    ? f.app
                        : f.stage == Span::Cull ? f.cull[f.wall]
                                                : f.draw[f.wall];
  switch (f.cause) {
  case Cause::Turn:
    text += fmt::format(": {} waited {:.1f} ms for other walls, most of it for {}", stage, s.turn,
                        f.holder < walls.size() ? walls[f.holder] : "?");
    break;
  case Cause::Preempted:
    if (f.stage == Span::Draw) {
      text += fmt::format(": {} took {:.1f} ms, {:.1f} of them without a processor, which others had", stage,
                          s.ms, s.delayed);
      break;
    }
    text += fmt::format(": {} lost its processor to others {} times, {:.1f} of {:.1f} ms", stage, s.switches,
                        s.ms - s.processor, s.ms);
    break;
  case Cause::PageFaults: text += fmt::format(": {} waited for {} pages of memory", stage, s.faults); break;
  case Cause::Loading: text += fmt::format(": {} took {:.1f} ms to load", stage, s.loading); break;
  case Cause::Unknown: text += ": no stage took long"; break;
  default: text += fmt::format(": {} took {:.1f} ms", stage, s.ms);
  }
  if (f.name[0] != 0 && f.nodeMs > 0 && f.stage == Span::App)
    text += fmt::format(", {:.1f} of them {}", f.nodeMs, f.name);
  if (f.drawn[0] != 0 && f.stage == Span::Draw && f.cause == Cause::Draw)
    text += fmt::format("; most there is to draw of {}", f.drawn);
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
