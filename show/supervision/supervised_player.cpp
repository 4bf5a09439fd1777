#include "show/supervision/supervised_player.h"
#include "engine/scene/scene_snapshot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace stadion {
namespace {

/// How often the scene is kept, unless that takes more than a thousandth of the time.
constexpr Nanoseconds kKeepEvery = fromSeconds(5), kKeepSeldom = fromSeconds(60);
constexpr Nanoseconds kShare = 1000;
/// While a player catches up: unless that takes more than a twentieth.
constexpr Nanoseconds kKeepSoon = fromSeconds(1), kSoonShare = 20;

std::string timesOf(std::uint64_t count) {
  return count == 1 ? "once" : fmt::format("{} times", count);
}

}  // namespace

SupervisedPlayer::SupervisedPlayer(std::unique_ptr<SharedProgress> progress,
                                   std::function<void(const std::string&)> say)
    : progress_(std::move(progress)), say_(std::move(say)), operator_(progress_->operatorState()),
      nextKept_(machineClock() + kKeepEvery) {
  progress_->enter(SharedProgress::Phase::Opening);
  from_ = progress_->kept();
  if (!from_) return;
  state_ = std::make_shared<const std::vector<std::uint8_t>>(progress_->scene());
}

std::unique_ptr<SupervisedPlayer> SupervisedPlayer::create(const SupervisionSettings& settings,
                                                           bool keepsScene,
                                                           std::function<void(const std::string&)> say,
                                                           Diagnostics& findings) {
  if (settings.progress < 0) return nullptr;
  auto progress = SharedProgress::attach(settings.progress);
  if (!progress) {
    findings.error({}, "--supervised is for players that `stadion run --supervise` starts");
    return nullptr;
  }
  std::unique_ptr<SupervisedPlayer> part(new SupervisedPlayer(std::move(progress), std::move(say)));
  part->keeps_ = keepsScene;
  return part;
}

void SupervisedPlayer::restartShow(const Diagnostics& found) {
  state_.reset();
  from_.reset();
  const auto why = std::ranges::find(found.all(), Severity::Error, &Diagnostic::severity);
  say_((why == found.all().end() ? "the saved scene cannot be restored" : why->message) +
       " (have its files changed?): the show restarts");
}

void SupervisedPlayer::goOn(FrameLoopOptions& loop, OperatorConsole& console, RunWatch& watch) {
  if (!keeps_) return;
  step_ = fromSeconds(1 / loop.rate);
  console.changed = [this](const OperatorState& state) { setOperatorState(state); };
  progress_->catchesUpUntil(machineClock());
  if (std::exchange(wentOn_, true) || progress_->starts() < 2) return setOperatorState(console.state());
  state_.reset();
  console.resume(operator_);
  const Nanoseconds at = from_ ? from_->time : 0;
  begun_ = machineClock();
  due_ = std::max(at, progress_->timeNow());
  loop.late = due_ - at;
  console.playback().standFrom(due_);
  progress_->catchesUpUntil(begun_ + loop.late);
  catchesUp_ = true;
  nextKept_ = begun_ + kKeepSoon;
  if (from_) {
    loop.after = TimeSignature{from_->frame, from_->time, 0, {}};
    watch.goOnFrom(from_->history);
  }
  const std::string from =
      from_ ? fmt::format("goes on from frame {}, {:.3f} s", from_->frame, toSeconds(at)) : "restarts";
  const bool paced = loop.pace != Pace::Free;
  say_(fmt::format("the show {}{}", from,
                   paced ? fmt::format(", and catches up to {:.3f} s", toSeconds(due_)) : ""));
}

void SupervisedPlayer::simulated(const TimeSignature& now, Scene& scene, const RunWatch& watch, bool late) {
  if (!keeps_) return;
  const bool still = progress_->operatorState().still();
  const bool arrived = catchesUp_ && (!late || (still && now.time >= due_));
  if (arrived) {
    catchesUp_ = false;
    progress_->catchesUpUntil(machineClock());
  }
  const Nanoseconds due = due_ + (still ? 0 : machineClock() - begun_);
  progress_->simulated(now, catchesUp_ ? due : now.time);
  if (arrived || machineClock() >= nextKept_) keep(now, scene, watch);
}

void SupervisedPlayer::keep(const TimeSignature& now, Scene& scene, const RunWatch& watch) {
  const Nanoseconds begin = machineClock();
  const std::vector<std::uint8_t> state = SceneSnapshot(scene).save();
  bytes_ = state.size();
  const int wrong = progress_->keep({now.frame, now.time, watch.history()}, state);
  const Nanoseconds took = machineClock() - begin;
  ++times_;
  longest_ = std::max(longest_, took);
  const Nanoseconds pause = std::clamp(kShare * took, kKeepEvery, kKeepSeldom);
  nextKept_ = begin + (catchesUp_ ? std::clamp(kSoonShare * took, kKeepSoon, pause) : pause);
  if (told_ || (wrong == 0 && took < step_)) return;
  told_ = true;
  say_(wrong == 0
           ? fmt::format(
                 "to keep the show's scene takes {:.1f} ms, more than a frame has; it is done every {:.0f} s",
                 1e3 * toSeconds(took), toSeconds(pause))
           : fmt::format("the show's scene cannot be kept: {}; if the player dies, the show goes on from an "
                         "older one, or restarts",
                         std::strerror(wrong)));
}

std::string SupervisedPlayer::remark() const {
  std::string words;
  if (progress_->starts() > 1)
    words = fmt::format("the player was replaced {}; frames, times and what happened are of the last one",
                        timesOf(progress_->starts() - 1));
  if (times_ > 0)
    words += fmt::format("{}the scene ({} bytes) was kept {} for the next player, in {:.2f} ms at most",
                         words.empty() ? "" : "; ", bytes_, timesOf(times_), 1e3 * toSeconds(longest_));
  return words;
}

}  // namespace stadion
