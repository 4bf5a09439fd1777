#include "show/supervision/supervisor.h"

#include "pipeline/platform/child_process.h"
#include "pipeline/record/journal.h"
#include "pipeline/supervision/shared_progress.h"
#include "show/base/process_status.h"
#include "show/base/stop_signal.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <thread>
#include <unistd.h>
#include <utility>

namespace stadion {
namespace {

using Phase = SharedProgress::Phase;
using std::chrono::milliseconds;

constexpr milliseconds kLook{10};

}  // namespace

Supervisor::Terminal::Terminal() : isThere_(tcgetattr(STDIN_FILENO, &was_) == 0) {}

void Supervisor::Terminal::restore() const {
  if (isThere_ && tcgetpgrp(STDIN_FILENO) == getpgrp()) tcsetattr(STDIN_FILENO, TCSANOW, &was_);
}

std::unique_ptr<Supervisor> Supervisor::create(const SupervisionSettings& settings, const PlayerWords& words,
                                               Reporter& reporter) {
  auto progress = SharedProgress::create();
  if (!progress) {
    reporter.fault(progress.error().message);
    return nullptr;
  }
  std::unique_ptr<Supervisor> made(new Supervisor(reporter));
  if (!settings.journal.empty()) {
    auto opened = Journal::open(settings.journal);
    if (!opened) {
      reporter.fault("--journal: " + opened.error().message);
      return nullptr;
    }
    made->journal_ = std::move(opened.value());
  }
  made->service_ = ServiceNotifier::open(settings.service);
  made->hangs_ = fromSeconds(settings.hangAfter);
  made->words_ = words(progress.value()->descriptor());
  made->progress_ = std::move(progress.value());
  return made;
}

Supervisor::~Supervisor() = default;

void Supervisor::say(const std::string& line) {
  reporter_.hint("supervise: " + line);
  const SharedProgress::Moment at = progress_->newest();
  if (service_) service_->status(line);
  if (!journal_) return;
  const auto why = journal_->add(
      "supervise: " + line, at.clock > 0 ? std::optional(Journal::Place{at.time, at.frame}) : std::nullopt);
  if (why) reporter_.hint("supervise: --journal: " + *why + "; lines are lost");
}

/// False: `stop` came.
bool Supervisor::pauseFor(milliseconds time, const std::atomic<bool>& stop) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (!stop && std::chrono::steady_clock::now() < end) {
    if (service_) service_->alive();
    std::this_thread::sleep_for(kLook);
  }
  return !stop;
}

/// While the show plays, only a finished frame is a sign of life. While it opens, `watch` has a limit of its
/// own.
void Supervisor::tellService(const HangWatch& watch) {
  if (!service_) return;
  if (progress_->phase() != Phase::Playing || !watch.shows()) return service_->alive();
  const std::uint64_t shown = progress_->framesShown();
  if (shown == std::exchange(told_, shown)) return;
  service_->pictureShown("plays");
}

std::optional<Supervisor::End> Supervisor::playOnce(const std::atomic<bool>& stop) {
  ChildProcess player;
  progress_->enter(Phase::Opening);
  progress_->countStart();
  if (const auto why = player.start(words_, {0, 1, 2}, {}, ChildProcess::Group::Ours)) {
    say(fmt::format("the player cannot be started: {}", std::strerror(*why)));
    return {};
  }
  HangWatch watch(*progress_, hangs_);
  bool forwarded = false;
  End end;
  for (;;) {
    const auto status = player.wait(kLook);
    if (status) {
      end.status = *status;
      break;
    }
    if (gone_ > 0 && watch.shows()) {
      say(fmt::format("pictures again, after {:.2f} s without", toSeconds(progress_->lastShown() - gone_)));
      gone_ = 0;
    }
    tellService(watch);
    if (stop && !forwarded) {
      kill(player.pid(), stopSignal());
      if (service_) service_->stopping();
    }
    forwarded = stop;
    end.hung = watch.hangs().value_or(0);
    if (end.hung == 0) continue;
    if (stop)
      say(fmt::format("the player has not ended {:g} s after {} and is killed", toSeconds(end.hung),
                      stopSignalName()));
    player.kill();
    player.wait(milliseconds(5000));
    end.status = kStopped + SIGKILL;
    break;
  }
  if (end.status > kStopped) terminal_.restore();
  return end;
}

/// Whether another player is to continue. A signal is no reason, nor an error in the show; but a show that
/// did play may be corrected while a later player waits. A result that could not be written after the end is
/// no reason either.
bool Supervisor::isDeath(const End& end, bool stopped) const {
  if (stopped || end.status == kStopped + SIGINT || end.status == kStopped + SIGTERM) return false;
  if (end.status == kRefused) return progress_->starts() > 1 && progress_->phase() != Phase::Ending;
  return end.hung > 0 || end.status > kStopped || end.status == kFailed;
}

std::string Supervisor::howOf(const End& end) const {
  if (end.hung > 0) return fmt::format("showed nothing for {:g} s and was killed", toSeconds(end.hung));
  if (end.status > kStopped)
    return fmt::format("was ended by signal {} ({})", end.status - kStopped,
                       strsignal(end.status - kStopped));
  return fmt::format("ended with exit code {}", end.status);
}

int Supervisor::play(const std::atomic<bool>& stop) {
  for (;;) {
    const auto end = playOnce(stop);
    if (!end) return kFailed;
    if (stop && end->hung > 0) return kStopped + stopSignal();
    if (!isDeath(*end, stop)) return end->status;
    if (gone_ == 0) gone_ = progress_->lastShown();
    const SharedProgress::Moment last = progress_->newest();
    const Recovery::Step step = recovery_.died(last.time, progress_->played());
    const std::string died =
        fmt::format("the player {} at frame {}, {:.3f} s", howOf(*end), last.frame, toSeconds(last.time));
    if (step.way == Recovery::Way::GiveUp) {
      say(fmt::format("{}, the {}th time in a row; the show is given up", died, recovery_.deaths()));
      return end->status;
    }
    const bool again = step.way == Recovery::Way::Restart;
    say(fmt::format(
        "{}; {}{}", died,
        again ? fmt::format("the {}th time in a row: another one begins the show again", recovery_.deaths())
              : "another one goes on",
        step.pause.count() > 0 ? fmt::format(" after {} s", 1e-3 * static_cast<double>(step.pause.count()))
                               : ""));
    if (!pauseFor(step.pause, stop)) return kStopped + stopSignal();
    if (again) progress_->forget();
  }
}

}  // namespace stadion
