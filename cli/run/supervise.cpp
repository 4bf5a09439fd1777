#include "cli/run/supervise.h"

#include "cli/exit_code.h"
#include "pipeline/platform/child_process.h"
#include "pipeline/record/journal.h"
#include "pipeline/supervision/hang_watch.h"
#include "pipeline/supervision/recovery.h"
#include "pipeline/supervision/shared_progress.h"
#include "show/base/stop_signal.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <termios.h>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

using Phase = SharedProgress::Phase;
using std::chrono::milliseconds;

constexpr milliseconds kLook{10};

/// The terminal as it was: a player that is killed leaves it as it had it.
class Terminal {
public:
  Terminal() : there_(tcgetattr(STDIN_FILENO, &was_) == 0) {}
  void giveBack() const {
    if (there_ && tcgetpgrp(STDIN_FILENO) == getpgrp()) tcsetattr(STDIN_FILENO, TCSANOW, &was_);
  }

private:
  termios was_{};
  bool there_;
};

/// This command line, for a player.
std::vector<std::string> playerWords(int descriptor) {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  std::erase_if(words,
                [](const std::string& w) { return w == "--supervise" || w.starts_with("--supervise="); });
  words.front() = std::filesystem::canonical("/proc/self/exe").string();
  const auto run = std::ranges::find(words, "run");
  const std::vector<std::string> own{"--supervised", std::to_string(descriptor), "--ends-with",
                                     std::to_string(getpid())};
  words.insert(run == words.end() ? run : std::next(run), own.begin(), own.end());
  return words;
}

class Supervisor {
public:
  Supervisor(const RunOptions& o, std::unique_ptr<SharedProgress> progress, std::unique_ptr<Journal> journal,
             const std::atomic<bool>& stop)
      : progress_(std::move(progress)), journal_(std::move(journal)), stop_(stop),
        hangs_(fromSeconds(o.hangAfter)), words_(playerWords(progress_->descriptor())) {}

  int play();

private:
  struct End {
    int status = 0;        ///< exit status; 128 + signal
    Nanoseconds hung = 0;  ///< so long no picture came, and it was killed
  };
  std::optional<End> playOnce();
  bool isDeath(const End& end) const;
  std::string howOf(const End& end) const;
  void say(const std::string& line);
  bool pause(milliseconds time) const;

  std::unique_ptr<SharedProgress> progress_;
  std::unique_ptr<Journal> journal_;
  const std::atomic<bool>& stop_;
  Nanoseconds hangs_;
  std::vector<std::string> words_;
  Terminal terminal_;
  Recovery recovery_;
  Nanoseconds gone_ = 0;  ///< when the player before this one showed its last frame
};

void Supervisor::say(const std::string& line) {
  std::fprintf(stderr, "supervise: %s\n", line.c_str());
  const SharedProgress::Moment at = progress_->newest();
  if (!journal_) return;
  const auto why = journal_->add(
      "supervise: " + line, at.clock > 0 ? std::optional(Journal::Place{at.time, at.frame}) : std::nullopt);
  if (why) std::fprintf(stderr, "supervise: --journal: %s; lines are lost\n", why->c_str());
}

/// False: the run is to end.
bool Supervisor::pause(milliseconds time) const {
  const auto end = std::chrono::steady_clock::now() + time;
  while (!stop_ && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(kLook);
  return !stop_;
}

std::optional<Supervisor::End> Supervisor::playOnce() {
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
    if (stop_ && !forwarded) kill(player.pid(), stopSignal());
    forwarded = stop_;
    end.hung = watch.hangs().value_or(0);
    if (end.hung == 0) continue;
    if (stop_)
      say(fmt::format("the player has not ended {:g} s after {} and is killed", toSeconds(end.hung),
                      stopSignalName()));
    player.kill();
    player.wait(milliseconds(5000));
    end.status = kStopped + SIGKILL;
    break;
  }
  if (end.status > kStopped) terminal_.giveBack();
  return end;
}

/// Whether another player is to go on. What the user asked for, and what is wrong with the show, is no
/// reason; but a show that did play may be mended while a later player waits. What could not be written of
/// one that is over is no reason either.
bool Supervisor::isDeath(const End& end) const {
  if (stop_ || end.status == kStopped + SIGINT || end.status == kStopped + SIGTERM) return false;
  if (end.status == kBadInput) return progress_->starts() > 1 && progress_->phase() != Phase::Ending;
  return end.hung > 0 || end.status > kStopped || end.status == kInternalFault;
}

std::string Supervisor::howOf(const End& end) const {
  if (end.hung > 0) return fmt::format("showed nothing for {:g} s and was killed", toSeconds(end.hung));
  if (end.status > kStopped)
    return fmt::format("was ended by signal {} ({})", end.status - kStopped,
                       strsignal(end.status - kStopped));
  return fmt::format("ended with exit code {}", end.status);
}

int Supervisor::play() {
  for (;;) {
    const auto end = playOnce();
    if (!end) return kInternalFault;
    if (stop_ && end->hung > 0) return kStopped + stopSignal();
    if (!isDeath(*end)) return end->status;
    if (gone_ == 0) gone_ = progress_->lastShown();
    const SharedProgress::Moment last = progress_->newest();
    const Recovery::Step step = recovery_.died(last.time, progress_->played());
    const std::string died =
        fmt::format("the player {} at frame {}, {:.3f} s", howOf(*end), last.frame, toSeconds(last.time));
    if (step.way == Recovery::Way::GiveUp) {
      say(fmt::format("{}, the {}th time in a row; the show is given up", died, recovery_.deaths()));
      return end->status;
    }
    const bool again = step.way == Recovery::Way::BeginAgain;
    say(fmt::format(
        "{}; {}{}", died,
        again ? fmt::format("the {}th time in a row: another one begins the show again", recovery_.deaths())
              : "another one goes on",
        step.pause.count() > 0 ? fmt::format(" after {} s", 1e-3 * static_cast<double>(step.pause.count()))
                               : ""));
    if (!pause(step.pause)) return kStopped + stopSignal();
    if (again) progress_->forget();
  }
}

}  // namespace

int superviseRun(const RunOptions& o) {
  const auto refuse = [](const std::string& why) {
    std::fprintf(stderr, "stadion: %s\n", why.c_str());
    return kBadInput;
  };
  auto progress = SharedProgress::create();
  if (!progress) return refuse(progress.error().message);
  std::unique_ptr<Journal> journal;
  if (!o.journal.empty()) {
    auto opened = Journal::open(o.journal);
    if (!opened) return refuse("--journal: " + opened.error().message);
    journal = std::move(opened.value());
  }
  outliveReaders();
  Supervisor supervisor(o, std::move(progress.value()), std::move(journal), catchStopSignals());
  return supervisor.play();
}

}  // namespace stadion
