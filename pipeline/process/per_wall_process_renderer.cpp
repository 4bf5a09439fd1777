#include "pipeline/process/per_wall_process_renderer.h"

#include "engine/base/run_stopped.h"
#include "pipeline/draw_list/list_filling.h"
#include "pipeline/process/answer_deadline.h"
#include "pipeline/process/restarts.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <optional>

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using State = wall_process::WallProcess::State;

constexpr int kMostStarts = 3;            // for one frame after the first, or to open
constexpr milliseconds kLookEvery{10};    // whether the run gives up, and whether the process lives
constexpr milliseconds kHangs{5000};      // without using the processor, where every frame counts
constexpr milliseconds kHangsLive{1000};  // where others must not wait
constexpr milliseconds kStopped{250};     // if somebody has stopped it
// A driver in an endless loop is busy, too. A frame that takes this many times as long as any before it hangs,
constexpr int kTooLong = 20;
constexpr milliseconds kSpins{60'000};        // if it takes at least this long, where every frame counts
constexpr milliseconds kSpinsLive{3000};      // where others must not wait
constexpr milliseconds kSpinsFirst{600'000};  // while it is not known what a frame takes
constexpr milliseconds kForEver{24 * 3600 * 1000};

}  // namespace

struct PerWallProcessRenderer::Wall {
  Wall(std::string name_, double rate, wall_process::WallProcessSetting setting, const MeshStore& meshes,
       wall_process::SharedMeshes& shared)
      : name(std::move(name_)), process(std::move(setting), meshes, shared), deadline(rate) {}

  std::string name;
  wall_process::WallProcess process;
  std::string description;
  ViewTotals before{}, totals{};  ///< of the processes before this one; in all
  std::atomic<int> pid = 0;
  wall_process::Restarts restarts;

  // These say whether it hangs.
  double processor = -1;      ///< processor time that it has used [s]
  Clock::time_point since{};  ///< time at which it had first used that much

  Clock::time_point began{};              ///< time of its present order
  std::optional<milliseconds> longest{};  ///< longest frame of any process

  // Where the newest frame counts.
  wall_process::AnswerDeadline deadline;
  bool warm = false;         ///< the process has drawn; its first frame includes compiling shaders
  bool waitedFor = true;     ///< false: the other walls go on without it until it answers
  Clock::time_point lost{};  ///< time since which they go on without it
};

PerWallProcessRenderer::PerWallProcessRenderer(PerWallProcessParts parts)
    : parts_(std::move(parts)), sharedMeshes_(parts_.meshes) {
  for (std::size_t i = 0; i < parts_.walls.size(); ++i) {
    const wall_process::WallProcessSetting setting{parts_.program,
                                                   parts_.renderer,
                                                   parts_.walls[i].width,
                                                   parts_.walls[i].height,
                                                   parts_.quality,
                                                   parts_.rasteriserThreads,
                                                   i < parts_.processors.size() ? parts_.processors[i]
                                                                                : ProcessorSet{},
                                                   parts_.walls[i].card};
    walls_.push_back(
        std::make_unique<Wall>(parts_.names[i], parts_.rate, setting, parts_.meshes, sharedMeshes_));
  }
}

PerWallProcessRenderer::~PerWallProcessRenderer() = default;

void PerWallProcessRenderer::report(const Wall& wall, const std::string& what) const {
  if (parts_.tell) parts_.tell("wall " + wall.name + ": " + what);
}

Failure PerWallProcessRenderer::start(Wall& wall) {
  wall.before = wall.totals;
  wall.processor = -1;
  wall.began = wall.since = Clock::now();
  wall.warm = false;
  if (const auto why = wall.process.start())
    return Reason("wall " + wall.name + ": no process draws it: " + *why);
  wall.pid = wall.process.pid();
  return kNoFailure;
}

/// The process crashed, or must end. Reports the first crash, and once that more follow.
void PerWallProcessRenderer::died(Wall& wall, const std::string& how) {
  wall.process.stop();
  wall.pid = 0;
  using wall_process::Restarts;
  switch (wall.restarts.died(Clock::now())) {
  case Restarts::Death::First:
    report(wall, "the process that draws it " + how + "; another one is started");
    break;
  case Restarts::Death::Second:
    report(wall, "the process that draws it " + how + " again; further ones are started" +
                     (parts_.everyFrame ? "" : " after growing pauses") + ", and not told of");
    break;
  case Restarts::Death::Further: break;
  }
}

/// Waits until the process is idle. Returns false if it ended or is still busy.
bool PerWallProcessRenderer::await(Wall& wall, milliseconds atMost) {
  const auto deadline = Clock::now() + atMost;
  for (;;) {
    if (wall.process.state() == State::Idle) return true;
    const auto left = std::chrono::ceil<milliseconds>(deadline - Clock::now());
    if (wall.process.receive(std::clamp(left, milliseconds(0), kLookEvery))) return true;
    if (wall.process.state() == State::Down || left <= milliseconds(0)) return false;
    if (parts_.giveUp && parts_.giveUp()) throw RunStopped();
    noteProgress(wall);
    if (hangs(wall)) return false;
  }
}

/// How long one frame may take it; one that has to begin may take as long as where every frame counts.
milliseconds PerWallProcessRenderer::longestFrameOf(const Wall& wall) const {
  const bool live = !parts_.everyFrame && wall.process.state() != State::Opening && wall.warm;
  if (!wall.longest) return kSpinsFirst;
  return std::max(live ? kSpinsLive : kSpins, kTooLong * *wall.longest);
}

/// Notes that the process uses the processor, or waits for one.
void PerWallProcessRenderer::noteProgress(Wall& wall) {
  const wall_process::ProcessStatus& status = wall.process.status();
  if (status.state != 'R' && status.processorSeconds == wall.processor) return;
  wall.processor = status.processorSeconds;
  wall.since = Clock::now();
}

/// Returns true if it has not used the processor for long, while it had something to do and did not wait for
/// one, or has used it for far too long. One that opens its context may wait for a disk.
bool PerWallProcessRenderer::hangs(const Wall& wall) const {
  const wall_process::ProcessStatus& status = wall.process.status();
  const auto now = Clock::now();
  if (now - wall.began > longestFrameOf(wall)) return true;
  const bool live = !parts_.everyFrame && wall.process.state() != State::Opening;
  return now - wall.since > (status.state == 'T' ? kStopped : live ? kHangsLive : kHangs);
}

/// What the process said, as far as it concerns the run.
Failure PerWallProcessRenderer::answered(Wall& wall) {
  const wall_process::AnswerHead& answer = wall.process.answer();
  wall.processor = -1;
  if (answer.failed) return Reason("wall " + wall.name + ": " + wall.process.text());
  if (answer.to == wall_process::Order::Open) wall.description = wall.process.text();
  if (answer.to == wall_process::Order::Draw) hasDrawn(wall, answer.totals);
  return kNoFailure;
}

/// Counts the picture, whether or not it came in time.
void PerWallProcessRenderer::hasDrawn(Wall& wall, const ViewTotals& totals) {
  for (std::size_t view = 0; view < wall.totals.size(); ++view) {
    wall.totals[view] = totals[view];
    wall.totals[view].add(wall.before[view]);
  }
  const auto took = Clock::now() - wall.began;
  if (wall.warm) wall.deadline.took(took);
  wall.longest = std::max(wall.longest.value_or(milliseconds(0)), std::chrono::ceil<milliseconds>(took));
  wall.warm = true;
}

Failure PerWallProcessRenderer::open(std::size_t index) {
  Wall& wall = *walls_[index];
  wall.before = wall.totals = {};
  std::string why;
  for (int starts = 0; starts < kMostStarts; ++starts) {
    if (Failure f = start(wall)) return f;
    if (await(wall, kForEver)) return answered(wall);
    why = wall.process.state() == State::Down ? wall.process.end() : "hung";
  }
  return Reason("wall " + wall.name + ": the process that is to draw it " + why + " before it was ready, " +
                std::to_string(kMostStarts) + " times");
}

// Nothing is shown yet, so no wall waits for another one.
Failure PerWallProcessRenderer::warmUp(std::size_t index, const DrawList& list) {
  return drawEvery(*walls_[index], list, false, true);
}

DrawOutcome PerWallProcessRenderer::draw(std::size_t index, const DrawList& list, bool read) {
  if (list.filling && !list.filling->isWhole()) return {{}, false};
  Wall& wall = *walls_[index];
  if (parts_.everyFrame) return {drawEvery(wall, list, read)};
  return drawNewest(wall, list, read);
}

/// What it uses of the processor counts from now on: it may have had nothing to do for long.
void PerWallProcessRenderer::begin(Wall& wall, const DrawList& list, bool read, bool warmUp) {
  wall.processor = -1;
  wall.began = wall.since = Clock::now();
  if (warmUp)
    wall.process.warmUp(list);
  else
    wall.process.draw(list, read);
}

Failure PerWallProcessRenderer::drawEvery(Wall& wall, const DrawList& list, bool read, bool warmUp) {
  std::string how;
  for (int processes = 0; processes <= kMostStarts; ++processes) {
    if (wall.process.state() == State::Down) {
      if (how.empty()) died(wall, wall.process.end());  // between two frames
      if (Failure f = start(wall)) return f;
    }
    if (wall.process.state() == State::Opening && await(wall, kForEver))
      if (Failure f = answered(wall)) return f;
    if (wall.process.state() == State::Idle) {
      begin(wall, list, read, warmUp);
      if (await(wall, kForEver)) {
        wall.restarts.drew();
        return answered(wall);
      }
    }
    how = wall.process.state() == State::Down ? wall.process.end() : "hung";
    died(wall, how);
  }
  return Reason("wall " + wall.name + ", frame " + std::to_string(list.ticket.signature.frame) + ": " +
                std::to_string(1 + kMostStarts) + " processes died of it; the last one " + how);
}

/// Looks at a process without waiting. When it is time, replaces one that ended or hangs.
Failure PerWallProcessRenderer::lookAfter(Wall& wall) {
  const State was = wall.process.state();
  if (was == State::Opening || was == State::Busy) {
    if (wall.process.receive(milliseconds(0))) {
      if (was == State::Busy) return answered(wall);
      if (wall.process.answer().failed)
        died(wall, "could not begin (" + wall.process.text() + ")");
      else
        answered(wall);
    } else if (wall.process.state() == State::Down) {
      died(wall, wall.process.end());
    } else {
      noteProgress(wall);
      if (hangs(wall)) died(wall, "hung");
    }
  }
  if (wall.process.state() == State::Down && wall.restarts.due(Clock::now()))
    if (const Failure f = start(wall)) died(wall, "could not be started (" + f->message + ")");
  return kNoFailure;
}

/// Waits as long as the walls beside may wait: not for one that somebody has stopped, and as long again for
/// one that runs, or would if there was a processor.
bool PerWallProcessRenderer::awaitInTime(Wall& wall) {
  const milliseconds limit = deadlineOf(wall);
  const auto began = Clock::now();
  for (;;) {
    if (await(wall, std::min(kLookEvery, limit))) return true;
    const char state = wall.process.status().state;
    noteProgress(wall);
    if (wall.process.state() == State::Down || state == 'T' || hangs(wall)) return false;
    if (Clock::now() - began >= (state == 'R' ? 2 * limit : limit)) return false;
  }
}

/// How long the walls beside may have to wait: while a new process draws for the first time, not at all.
milliseconds PerWallProcessRenderer::deadlineOf(const Wall& wall) {
  if (!wall.warm && wall.restarts.deaths() > 0) return milliseconds(0);
  const auto limit = wall.deadline.limit();
  return limit ? std::chrono::ceil<milliseconds>(*limit) : kForEver;
}

/// Never waits longer than the walls beside may wait.
DrawOutcome PerWallProcessRenderer::drawNewest(Wall& wall, const DrawList& list, bool read) {
  const auto late = [&]() -> DrawOutcome {
    if (wall.waitedFor) wall.lost = Clock::now();
    wall.waitedFor = false;
    return {{}, false};
  };
  if (Failure f = lookAfter(wall)) return {std::move(f)};
  if (wall.process.state() != State::Idle) return late();
  begin(wall, list, read);
  if (!awaitInTime(wall)) {
    if (wall.process.state() == State::Down) {
      died(wall, wall.process.end());
      lookAfter(wall);
    }
    return late();
  }
  if (Failure f = answered(wall)) return {std::move(f)};
  drewInTime(wall);
  return {};
}

void PerWallProcessRenderer::drewInTime(Wall& wall) {
  wall.waitedFor = true;
  const std::size_t deaths = wall.restarts.deaths();
  if (!wall.restarts.drew()) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - wall.lost).count();
  report(wall, deaths == 1 ? "draws again, after " + std::to_string(std::lround(1000 * seconds)) + " ms"
                           : "draws again, after " + std::to_string(deaths) + " processes that died");
}

Failure PerWallProcessRenderer::read(std::size_t index, std::uint32_t view, std::span<std::uint8_t> rgba) {
  Wall& wall = *walls_[index];
  if (!wall.process.holdsPictures() && wall.process.state() == State::Idle) {
    wall.process.readPictures();
    if (await(wall, kForEver))
      if (Failure f = answered(wall)) return f;
  }
  const auto picture = wall.process.picture(view);
  if (!wall.process.holdsPictures() || picture.size() != rgba.size())
    return Reason("wall " + wall.name + ": its picture is lost: the process that draws it " +
                  (wall.process.state() == State::Down ? wall.process.end() : std::string("hung")));
  std::memcpy(rgba.data(), picture.data(), rgba.size());
  return kNoFailure;
}

void PerWallProcessRenderer::close(std::size_t index) {
  walls_[index]->pid = 0;
  walls_[index]->process.stop();
}

ViewTotals PerWallProcessRenderer::totals(std::size_t wall) const {
  return walls_[wall]->totals;
}

std::string PerWallProcessRenderer::drawnBy(std::size_t wall) const {
  return walls_[wall]->description;
}

int PerWallProcessRenderer::pid(std::size_t wall) const {
  return walls_[wall]->pid;
}

}  // namespace stadion
