#include "show/supervision/run_journal.h"

#include "pipeline/platform/process_figures.h"
#include "show/base/process_status.h"
#include "show/base/processor_name.h"
#include "show/base/version.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sys/utsname.h>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

std::string machineText() {
  utsname system{};
  const bool known = uname(&system) == 0;
  return fmt::format("{}, {} processors, {} {}", processorName(), std::thread::hardware_concurrency(),
                     known ? system.sysname : "?", known ? system.release : "?");
}

}  // namespace

std::unique_ptr<RunJournal> RunJournal::open(const SupervisionSettings& settings, Reporter& reporter,
                                             Diagnostics& findings) {
  if (settings.journal.empty()) return nullptr;
  if (settings.progress >= 0)  // the supervisor has seen that it could be written: no reason for dark walls
    return std::unique_ptr<RunJournal>(new RunJournal(Journal::openLater(settings.journal), reporter));
  auto file = Journal::open(settings.journal);
  if (!file) {
    findings.error({}, "--journal: " + file.error().message);
    return nullptr;
  }
  return std::unique_ptr<RunJournal>(new RunJournal(std::move(file.value()), reporter));
}

void RunJournal::note(std::string_view what) {
  std::optional<Journal::Place> at;
  {
    const std::lock_guard lock(mutex_);
    at = place_;
  }
  if (const auto why = file_->add(what, at))
    reporter_.fault("--journal: " + *why + "; lines are lost, the show goes on");
}

void RunJournal::note(const Diagnostics& findings) {
  for (const Diagnostic& d : findings.all()) {
    Diagnostic withoutExcerpt = d;
    withoutExcerpt.excerpt.clear();
    note(format(withoutExcerpt));
  }
}

void RunJournal::began(const ShowOptions& show, const Player& player) {
  note(fmt::format("started: stadion {}, process {}, {}, walls {} ({}), {}, {} frames a second", kVersion,
                   getpid(), show.script, show.walls, fmt::join(player.walls().names(), ", "),
                   nameOf(show.mode), player.rate()));
  note("machine: " + machineText());
}

void RunJournal::beginGroup() {
  loads_.clear();
  loadsSeen_ = 0;
  const std::lock_guard lock(mutex_);
  place_.reset();
}

void RunJournal::see(const TimeSignature& now, const InputSample& input, const Scene& scene) {
  {
    const std::lock_guard lock(mutex_);
    place_ = Journal::Place{now.time, now.frame};
  }
  if (scene.tree().version() != loadsSeen_ || now.frame == 0) noteLoads(scene);
  noteTrackers(input);
  if (const auto clock = Clock::now(); clock - minute_ >= kEvery) noteMinute(clock);
}

void RunJournal::noteLoads(const Scene& scene) {
  loadsSeen_ = scene.tree().version();
  std::map<std::uint32_t, std::string> there;
  scene.tree().forEachLoad([&](const LoadedScene& load) { there.emplace(load.number, load.file); });
  for (const auto& [number, file] : there)
    if (!loads_.contains(number)) note("loaded " + file);
  for (const auto& [number, file] : loads_)
    if (!there.contains(number)) note("unloaded " + file);
  loads_ = std::move(there);
}

/// Of trackers that are there; a log's never were.
void RunJournal::noteTrackers(const InputSample& input) {
  for (const TrackerSample& t : input.trackers) {
    const bool heard = t.measured > 0;
    const auto known = heard_.find(t.name);
    if (known == heard_.end()) {
      if (!heard) continue;
      heard_.emplace(t.name, true);
      note("tracker " + t.name + " is heard");
    } else if (known->second != heard) {
      known->second = heard;
      note("tracker " + t.name + (heard ? " is heard again" : " has fallen silent"));
    }
  }
}

std::string RunJournal::figures() {
  const ProcessFigures p = processFigures();
  return fmt::format("{:.1f} MiB of memory, {} handles, {} threads",
                     static_cast<double>(p.residentBytes) / (1 << 20), p.handles, p.threads);
}

void RunJournal::noteMinute(Clock::time_point now) {
  const double seconds = std::chrono::duration<double>(now - minute_).count();
  minute_ = now;
  std::string text;
  {
    const std::lock_guard lock(mutex_);
    const std::uint64_t frames = shown_ - shownBefore_, late = late_ - lateBefore_;
    text = fmt::format("in {:.0f} s: {} frames shown, {} late{}{}; ", seconds, frames, late,
                       late > 0 ? ", at last " : "", late > 0 ? lastLate_ : "");
    shownBefore_ = shown_;
    lateBefore_ = late_;
  }
  note(text + figures());
}

bool RunJournal::shown() {
  const std::lock_guard lock(mutex_);
  return ++shown_ == 1;
}

void RunJournal::firstPicture(const std::string& gl) {
  note(gl.empty() ? "plays; nothing is drawn" : "the first picture; drawn by " + gl);
}

void RunJournal::late(const std::string& text) {
  const std::lock_guard lock(mutex_);
  ++late_;
  lastLate_ = text;
}

int RunJournal::ended(int code) {
  const auto status = [&] {
    const bool well = code == kPlayed || code > kStopped;
    return well && file_->incomplete() ? static_cast<int>(kRefused) : code;
  };
  std::string text;
  {
    const std::lock_guard lock(mutex_);
    text = fmt::format("ended with exit code {}: {} frames shown, {} late; ", status(), shown_, late_);
  }
  note(text + figures());
  return status();
}

}  // namespace stadion
