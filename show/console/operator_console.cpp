#include "show/console/operator_console.h"

#include "pipeline/sound/loudspeaker_device.h"
#include "show/console/show_cues.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <unistd.h>
#include <utility>

namespace stadion {
namespace {

std::string clockText(double seconds) {
  const auto s = static_cast<long>(seconds);
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

double seconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

}  // namespace

std::unique_ptr<OperatorConsole> OperatorConsole::open(const Settings& settings, Reporter& reporter,
                                                       Diagnostics& findings) {
  std::unique_ptr<OperatorConsole> opened(new OperatorConsole(settings, reporter));
  if (settings.console.trackers.device.empty() || settings.console.elsewhere) return opened;
  opened->trackers_ = TrackerDevice::open(settings.console.trackers, reporter.sayFunction(), findings);
  if (!opened->trackers_) return nullptr;
  opened->say("trackers: " + opened->trackers_->description());
  return opened;
}

OperatorConsole::~OperatorConsole() = default;

bool OperatorConsole::begin(const Player& player, Diagnostics& findings) {
  const auto& [show, play, console] = settings_;
  controls_ = std::make_unique<OperatorControls>(console.wait, player.walls().eyeSeparation);
  const FrameLoopOptions loop = play.loopOptions(player);
  live_ = play.windows || loop.delivery == Delivery::Latest;
  // A show that plays faster than the clock has no sound.
  if (loop.pace != Pace::Free && !console.noSound) {
    roots_ = AssetRoots::ofScript(show.script);
    for (const std::string& root : show.assetRoots) roots_.add(root);
    const LoudspeakerSet& hall = player.walls().loudspeakers;
    sounds_ = hall.empty() ? std::make_unique<SoundPlayer>(roots_, reporter_.sayFunction())
                           : std::make_unique<SoundPlayer>(roots_, reporter_.sayFunction(),
                                                           [hall] { return openLoudspeakers(hall); });
  }
  if (!live_ || console.elsewhere) return true;
  if (console.oscPort >= 0) {
    auto osc = OscOperator::open(static_cast<std::uint16_t>(console.oscPort), controls_->queue(),
                                 reporter_.sayFunction());
    if (!osc) {
      findings.error({}, "--osc: " + osc.error().message);
      return false;
    }
    osc_ = std::move(osc.value());
    say(fmt::format("operator: OSC on UDP port {}", osc_->port()));
  }
  keys_ = OperatorKeys::open(STDIN_FILENO, controls_->queue(), reporter_.hintFunction());
  const bool hasWindows = play.windows || play.display;
  if (console.wait && !keys_ && !osc_ && !console.hasPage && !hasWindows) {
    findings.error({},
                   "--wait: start could not be given: there is no terminal, no --osc PORT and no --web PORT");
    return false;
  }
  if (keys_) reporter_.hint("operator: keys in this terminal, h shows them");
  return true;
}

void OperatorConsole::beginGroup(Player& player, RunWatch& watch) {
  ready_ = Clock::now();
  if (std::exchange(groupIsNew_, false)) controls_->awaitPicture();
  if (trackers_) player.takeInputFrom(trackers_->trackers());
  visitorIsLive_ = player.inputIsLive();
  controls_->replay(player.decisions().orders);
  controls_->told = [this, &player, &watch](std::uint64_t frame, const OperatorCommand& command) {
    if (command.action == OperatorAction::Cue)
      callCue(player, static_cast<std::uint32_t>(*command.value));
    else
      report(command, watch.time());
    if (isOfPresentation(command.action)) writeDown(frame, command, watch);
    if (changed) changed(controls_->state());
    if (commanded) commanded(controls_->state());
  };
  // What stands already stands from the first frame on.
  const Presentation& shown = controls_->state().presentation;
  if (shown.black) watch.order(0, {OperatorAction::Black, 1, false});
  if (shown.pattern) watch.order(0, {OperatorAction::TestPattern, 1, false});
  if (shown.swapEyes) watch.order(0, {OperatorAction::SwapEyes, 1, false});
  if (shown.eyeSeparation >= 0) watch.order(0, {OperatorAction::EyeSeparation, shown.eyeSeparation, false});
  if (controls_->state().volume != 1)
    watch.order(0, {OperatorAction::Volume, controls_->state().volume, false});
  if (controls_->state().waiting) say("waiting for start");
}

void OperatorConsole::resume(const OperatorState& decided) {
  const auto order = [&](OperatorAction action, double value) { queue().post({action, value, false}); };
  if (state().waiting && !decided.waiting) queue().post({OperatorAction::Start, {}, false});
  if (decided.paused) order(OperatorAction::Pause, 1);
  if (decided.presentation.black) order(OperatorAction::Black, 1);
  if (decided.presentation.pattern) order(OperatorAction::TestPattern, 1);
  if (decided.presentation.swapEyes) order(OperatorAction::SwapEyes, 1);
  if (decided.presentation.eyeSeparation >= 0)
    order(OperatorAction::EyeSeparation, decided.presentation.eyeSeparation);
  if (decided.volume != 1) order(OperatorAction::Volume, decided.volume);
  if (decided.mostInFlight > 0) order(OperatorAction::Latency, decided.mostInFlight);
}

// What came of it, whatever it was before.
void OperatorConsole::writeDown(std::uint64_t frame, const OperatorCommand& command, RunWatch& watch) const {
  const OperatorState& s = controls_->state();
  const double value = command.action == OperatorAction::Black         ? s.presentation.black
                       : command.action == OperatorAction::TestPattern ? s.presentation.pattern
                       : command.action == OperatorAction::SwapEyes    ? s.presentation.swapEyes
                       : command.action == OperatorAction::Volume      ? s.volume
                                                                       : s.eyeSeparation();
  watch.order(frame, {command.action, value, false});
}

void OperatorConsole::pictureSeen() {
  if (seen) seen();
  if (!controls_->pictureSeen()) return;
  say(fmt::format("group {} begins: reset in {:.2f} s, first picture after {:.2f} s; up {}", groups(),
                  seconds(ready_ - asked_), seconds(Clock::now() - asked_), clockText(uptime())));
}

void OperatorConsole::endGroup(const RunWatch& watch) {
  std::string told = fmt::format("group {} ends at {:.3f} s", groups(), toSeconds(watch.time()));
  const char* before = ": ";
  for (const MeasuredDistance& m : watch.measured())
    told += fmt::format("{}{} {:.3f} m", std::exchange(before, ", "), m.node, m.metres);
  say(told);
  asked_ = controls_->queue().nextGroupAsked();
  groupIsNew_ = true;
  controls_->beginGroup();
  if (trackers_) trackers_->trackers().restart();
  silence();
}

void OperatorConsole::silence() {
  if (!sounds_) return;
  SoundScape nothing;
  sounds_->play(nothing, {});
  sounds_->waitUntilPlayed();
}

std::string OperatorConsole::fileOfGroup(const std::string& file) const {
  if (file.empty() || !controls_ || groups() == 1) return file;
  std::filesystem::path path = file;
  const std::string ending = path.extension();
  return path.replace_extension().string() + fmt::format("-{}", groups()) + ending;
}

/// The cue's messages are sent in this frame. The log and the hosts of a cluster learn of it by the input.
void OperatorConsole::callCue(Player& player, std::uint32_t number) const {
  const std::vector<ShowCue> cues = cuesOf(player.scene());
  const auto called = std::ranges::find(cues, number, &ShowCue::number);
  if (called == cues.end() || !player.callCue(number))
    say(fmt::format("operator: the show has no cue {}", number));
  else
    say(fmt::format("operator: cue {} ({})", called->text(), clockText(uptime())));
}

void OperatorConsole::addTo(ShowParts& parts, FrameLoopOptions& loop) {
  parts.waitsForPatterns = loop.delivery == Delivery::Every;
  parts.sounds = sounds_.get();
  parts.tell = reporter_.sayFunction();
  parts.controls = loop.controls = controls_.get();
  loop.playback = &controls_->playback();
  controls_->startWith(loop.mostInFlight);
  parts.giveUp = [controls = controls_.get(), before = std::move(parts.giveUp)] {
    return controls->leaving() || (before && before());
  };
}

double OperatorConsole::uptime() const {
  return seconds(Clock::now() - opened_);
}

void OperatorConsole::report(const OperatorCommand& command, Nanoseconds showTime) const {
  const OperatorState& s = controls_->state();
  const Nanoseconds stands = std::max(showTime, controls_->playback().standsFrom());
  const auto onOff = [](bool on) { return on ? " on" : " off"; };
  std::string what(nameOf(command.action));
  switch (command.action) {
  case OperatorAction::Pause:
    what = fmt::format("{} at {:.3f} s", s.paused ? "paused" : "going on", toSeconds(stands));
    break;
  case OperatorAction::Step:
    if (settings_.play.windows) return;  // the windows' session reports the picture
    break;
  case OperatorAction::Black: what += onOff(s.presentation.black); break;
  case OperatorAction::TestPattern: what += onOff(s.presentation.pattern); break;
  case OperatorAction::SwapEyes: what += onOff(s.presentation.swapEyes); break;
  case OperatorAction::FreezeHead:
    what += onOff(s.headFrozen);
    if (!visitorIsLive_) what += " (without effect: the head is a record's)";
    break;
  case OperatorAction::EyeSeparation: what += fmt::format(" {:.4f} m", s.eyeSeparation()); break;
  case OperatorAction::Volume: what += fmt::format(" {:.0f} %", 100 * s.volume); break;
  case OperatorAction::Latency: what += fmt::format(" {:.0f}", s.mostInFlight); break;
  default: break;
  }
  say(fmt::format("operator: {} ({})", what, clockText(uptime())));
}

}  // namespace stadion
