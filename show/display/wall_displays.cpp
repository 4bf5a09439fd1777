#include "show/display/wall_displays.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace stadion {
namespace {

WindowPlan planFor(const WallEntry& entry, std::uint32_t width, std::uint32_t height) {
  WindowPlan plan;
  plan.title = "Stadion: " + entry.wall.name;
  plan.width = entry.pixels.width > 0 ? entry.pixels.width : width;
  plan.height = entry.pixels.width > 0 ? entry.pixels.height : height;
  if (!entry.output) return plan;
  const OutputPlace& place = entry.output->place;
  plan.monitor = place.monitor;
  plan.fullscreen = place.fullscreen;
  plan.refresh = place.refresh;
  plan.frame = !(place.rectangle || place.fullscreen);
  plan.pointer = plan.frame;
  if (place.rectangle) {
    plan.placed = true;
    plan.x = place.rectangle->x;
    plan.y = place.rectangle->y;
    plan.width = place.rectangle->width;
    plan.height = place.rectangle->height;
  }
  return plan;
}

}  // namespace

WallDisplays::~WallDisplays() = default;

Result<WindowSystem*> WallDisplays::systemOf(const std::string& screen) {
  auto& system = systems_[screen];
  if (!system) {
    auto opened = WindowSystem::open(screen);
    if (!opened) return opened.error();
    system = std::move(opened.value());
  }
  return system.get();
}

std::unique_ptr<WallDisplays> WallDisplays::open(const WallFile& walls, WindowSurface surface,
                                                 WindowStereo stereo, std::uint32_t width,
                                                 std::uint32_t height, SwapSync sync, Diagnostics& findings) {
  std::unique_ptr<WallDisplays> displays(new WallDisplays);
  for (const WallEntry& entry : walls.walls) {
    const auto refuse = [&](const Diagnostic& why) {
      findings.error({walls.file, entry.line, entry.column},
                     fmt::format("the output of wall \"{}\": {}", entry.wall.name, why.message),
                     entry.excerpt);
      return nullptr;
    };
    const auto system = displays->systemOf(entry.output ? entry.output->place.screen : "");
    if (!system) return refuse(system.error());
    WindowPlan plan = planFor(entry, width, height);
    plan.surface = surface;
    auto window = ShowWindow::open(*system.value(), plan, stereo, walls.walls.size());
    if (!window) return refuse(window.error());
    // One of them waits for its display; if all did, each would take a picture's time.
    window.value()->waitForDisplay(displays->windows_.empty());
    displays->windows_.push_back(std::move(window.value()));
    displays->screens_.push_back(entry.output ? entry.output->place.screen : "");
    displays->shapes_.push_back(entry.output ? entry.output->shape : OutputShape{});
  }
  if (!displays->joinSwapGroups(walls, sync, findings)) return nullptr;
  if (const auto why = displays->mayGoDark())
    findings.warning({}, "displays may go dark during the show: " + *why);
  return displays;
}

/// A group for each X screen. False if a barrier was asked for and the driver has none.
bool WallDisplays::joinSwapGroups(const WallFile& walls, SwapSync sync, Diagnostics& findings) {
  if (sync == SwapSync::Off) return true;
  const bool barrier = sync == SwapSync::Barrier;
  for (const auto& [screen, system] : systems_) {
    std::vector<Window*> windows;
    for (std::size_t i = 0; i < windows_.size(); ++i)
      if (screens_[i] == screen && windows_[i]->window().context()) windows.push_back(&windows_[i]->window());
    if (windows.empty() || (windows.size() < 2 && !barrier)) continue;
    auto group = system->joinSwapGroup(windows, barrier);
    if (!group && barrier) {
      findings.error({walls.file, 0, 0}, fmt::format("--swap-sync barrier: {}; leave it out, or choose auto",
                                                     group.error().message));
      return false;
    }
    if (!group) continue;
    groups_.push_back(std::move(group.value()));
    // The interval of each window is a condition of the group's swap, and the group waits once for all of them.
    for (std::size_t i = 0; i < windows_.size(); ++i)
      if (screens_[i] == screen) windows_[i]->waitForDisplay(true);
  }
  const bool any =
      std::ranges::any_of(windows_, [](const auto& w) { return w->window().context() != nullptr; });
  if (any || !barrier) return true;
  findings.error({walls.file, 0, 0},
                 "--swap-sync barrier: windows without OpenGL have no swap barrier; add: --renderer gl");
  return false;
}

std::string WallDisplays::swapSync() const {
  if (groups_.empty()) return {};
  return fmt::format("the driver swaps the windows together: {} swap group{}{} (this has met no hardware)",
                     groups_.size(), groups_.size() == 1 ? "" : "s",
                     groups_.front()->hasBarrier() ? ", bound to a swap barrier" : "");
}

std::array<std::uint32_t, 2> WallDisplays::pictureSize(std::size_t wall) const {
  auto [width, height] = windows_[wall]->window().size();
  if (shapes_[wall].rotate % 180 == 90) std::swap(width, height);
  return {width, height};
}

std::optional<std::string> WallDisplays::mayGoDark() const {
  for (const auto& [screen, system] : systems_)
    if (auto why = system->mayGoDark()) return why;
  return {};
}

void WallDisplays::show(const std::vector<EyePictures>& pictures) {
  for (std::size_t i = 0; i < windows_.size(); ++i) {
    windows_[i]->take(pictures, {i});
    const auto [width, height] = windows_[i]->window().size();
    windows_[i]->draw({{i, {0, 0, width, height}, shapes_[i]}});
  }
  for (const auto& window : windows_) window->show();
}

std::vector<Key> WallDisplays::poll() {
  std::vector<Key> keys;
  for (const WindowEvent& event : pollPresses())
    if (event.kind == WindowEvent::Kind::Key) keys.push_back(event.key);
  return keys;
}

std::vector<WindowEvent> WallDisplays::pollPresses() {
  std::vector<WindowEvent> presses;
  for (const auto& [screen, system] : systems_) system->poll();
  for (const auto& window : windows_)
    for (WindowEvent event : window->window().takeEvents()) {
      if (event.kind == WindowEvent::Kind::Close) {
        event.kind = WindowEvent::Kind::Key;
        event.key = Key::Escape;
        event.down = true;
      }
      const bool key = event.kind == WindowEvent::Kind::Key || event.kind == WindowEvent::Kind::KeyRepeat;
      if (key && event.down) presses.push_back(event);
    }
  return presses;
}

std::optional<std::string> WallDisplays::lost() const {
  for (const auto& [screen, system] : systems_)
    if (auto why = system->lost()) return why;
  return {};
}

}  // namespace stadion
