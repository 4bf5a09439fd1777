#include "cli/live_desk.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <unistd.h>

namespace stadion {
namespace {

void say(const std::string& line) {
  std::fprintf(stderr, "%s\n", line.c_str());
}

std::string clockText(double seconds) {
  const auto s = static_cast<long>(seconds);
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace

std::unique_ptr<LiveDesk> LiveDesk::open(const RunOptions& options, Diagnostics& findings) {
  std::unique_ptr<LiveDesk> desk(new LiveDesk(options));
  if (options.trackers.device.empty()) return desk;
  desk->trackers_ = TrackerDevice::open(options.trackers, say, findings);
  if (!desk->trackers_) return nullptr;
  say("trackers: " + desk->trackers_->description());
  return desk;
}

LiveDesk::~LiveDesk() = default;

bool LiveDesk::begin(const Player& player, Diagnostics& findings) {
  desk_ = std::make_unique<OperatorDesk>(options_.wait, player.walls().eyeSeparation);
  const FrameLoopOptions loop = options_.loopOptions(player);
  live_ = loop.delivery == Delivery::Latest;
  // Whoever plays faster than the clock has no ear for it.
  if (loop.pace != Pace::Free) {
    roots_ = AssetRoots::ofScript(options_.show.script);
    for (const std::string& root : options_.show.assetRoots) roots_.add(root);
    sounds_ = std::make_unique<SoundPlayer>(roots_, say);
  }
  if (!live_) return true;
  if (options_.oscPort >= 0) {
    auto osc = OscOperator::open(static_cast<std::uint16_t>(options_.oscPort), desk_->queue(), say);
    if (!osc) return findings.error({}, "--osc: " + osc.error().message), false;
    osc_ = std::move(osc.value());
    say(fmt::format("operator: OSC on UDP port {}", osc_->port()));
  }
  keys_ = OperatorKeys::open(STDIN_FILENO, desk_->queue());
  if (options_.wait && !keys_ && !osc_)
    return findings.error({}, "--wait: nobody can say start; there is no terminal and no --osc PORT"), false;
  if (keys_) say("operator: keys in this terminal, h shows them");
  return true;
}

void LiveDesk::beginGroup(Player& player, RunWatch& watch) {
  if (groups() > 1) {
    const double took = std::chrono::duration<double>(Clock::now() - ended_).count();
    say(fmt::format("group {} begins, {:.2f} s after the last one; up {}", groups(), took,
                    clockText(uptime())));
  }
  if (trackers_) player.takeInputFrom(trackers_->trackers());
  desk_->obey(player.decisions().orders);
  desk_->told = [this, &watch](std::uint64_t frame, const OperatorCommand& command) {
    tell(command);
    if (!isOfPresentation(command.action)) return;
    // Written down is what came of it, whatever it was before.
    const OperatorState& s = desk_->state();
    const double value = command.action == OperatorAction::Black      ? s.shown.black
                         : command.action == OperatorAction::SwapEyes ? s.shown.swapEyes
                         : command.action == OperatorAction::Volume   ? s.volume
                                                                      : s.eyeSeparation();
    watch.order(frame, {command.action, value, false});
  };
  // What stands already stands from the first frame on.
  const Presentation& shown = desk_->state().shown;
  if (shown.black) watch.order(0, {OperatorAction::Black, 1, false});
  if (shown.swapEyes) watch.order(0, {OperatorAction::SwapEyes, 1, false});
  if (shown.eyeSeparation >= 0) watch.order(0, {OperatorAction::EyeSeparation, shown.eyeSeparation, false});
  if (desk_->state().volume != 1) watch.order(0, {OperatorAction::Volume, desk_->state().volume, false});
  if (desk_->state().waiting) say("waiting for start");
}

void LiveDesk::endGroup() {
  ended_ = Clock::now();
  desk_->beginGroup();
  if (trackers_) trackers_->trackers().restart();
  if (!sounds_) return;
  SoundScape silence;
  sounds_->hear(silence, {});
  sounds_->settle();
}

std::string LiveDesk::recordName() const {
  if (options_.recordInput.empty() || !desk_ || groups() == 1) return options_.recordInput;
  std::filesystem::path path = options_.recordInput;
  const std::string ending = path.extension();
  return path.replace_extension().string() + fmt::format("-{}", groups()) + ending;
}

void LiveDesk::addTo(ShowParts& parts, FrameLoopOptions& loop) {
  parts.sounds = sounds_.get();
  parts.desk = loop.desk = desk_.get();
  loop.playback = &desk_->playback();
}

double LiveDesk::uptime() const {
  return std::chrono::duration<double>(Clock::now() - opened_).count();
}

void LiveDesk::tell(const OperatorCommand& command) const {
  const OperatorState& s = desk_->state();
  const auto onOff = [](bool on) { return on ? " on" : " off"; };
  std::string how;
  switch (command.action) {
  case OperatorAction::Pause: how = onOff(s.paused); break;
  case OperatorAction::Black: how = onOff(s.shown.black); break;
  case OperatorAction::SwapEyes: how = onOff(s.shown.swapEyes); break;
  case OperatorAction::FreezeHead:
    how = onOff(s.headFrozen) + std::string(trackers_ ? "" : " (without effect: there are no live trackers)");
    break;
  case OperatorAction::EyeSeparation: how = fmt::format(" {:.4f} m", s.eyeSeparation()); break;
  case OperatorAction::Volume: how = fmt::format(" {:.0f} %", 100 * s.volume); break;
  default: break;
  }
  say(fmt::format("operator: {}{} ({})", nameOf(command.action), how, clockText(uptime())));
}

}  // namespace stadion
