#include "show/view/view_windows.h"

#include <filesystem>
#include <fmt/format.h>

namespace stadion {
namespace {

constexpr double kInset = 0.3;  ///< the walls beside the overview, of the window's sides

SheetPlace moved(SheetPlace place, std::int32_t x, std::int32_t y) {
  place.x += x;
  place.y += y;
  return place;
}

}  // namespace

std::unique_ptr<ViewWindows> ViewWindows::open(const ViewSettings& settings, const WallFile& walls,
                                               bool drawnWithOpenGl, Diagnostics& findings) {
  std::unique_ptr<ViewWindows> made(new ViewWindows(walls, settings.stereo));
  auto system = WindowSystem::open();
  if (!system) {
    findings.add(system.error());
    return nullptr;
  }
  made->system_ = std::move(system.value());
  if (const auto why = made->system_->mayGoDark()) findings.warning({}, "the display may go dark: " + *why);
  made->sizes_ = unfold(walls.walls, settings.width, settings.height);
  const std::string name = std::filesystem::path(settings.file()).filename().string();
  const auto add = [&](const WindowPlan& plan) {
    auto window = ShowWindow::open(*made->system_, plan, settings.stereo, walls.walls.size() + 1);
    if (!window) {
      findings.add(window.error());
      return false;
    }
    made->windows_.push_back(std::move(window.value()));
    return true;
  };
  WindowPlan plan;
  plan.surface = windowSurface(drawnWithOpenGl, settings.stereo);
  if (settings.oneWindow) {
    plan.title = "Stadion: " + name;
    plan.width = settings.width;
    plan.height = settings.height;
    return add(plan) ? std::move(made) : nullptr;
  }
  for (std::size_t i = 0; i < walls.walls.size(); ++i) {
    const SheetPlace& place = made->sizes_[i];
    plan.title = "Stadion: " + name + ", " + walls.walls[i].wall.name;
    plan.width = place.width;
    plan.height = place.height;
    plan.placed = true;
    plan.x = place.x;
    plan.y = place.y;
    if (!add(plan)) return nullptr;
  }
  return made;
}

std::vector<std::pair<std::size_t, WindowEvent>> ViewWindows::takeEvents() {
  system_->poll();
  std::vector<std::pair<std::size_t, WindowEvent>> events;
  for (std::size_t w = 0; w < windows_.size(); ++w)
    for (const WindowEvent& event : windows_[w]->window().takeEvents()) events.emplace_back(w, event);
  return events;
}

std::vector<std::size_t> ViewWindows::wallsOf(std::size_t window) const {
  std::vector<std::size_t> walls;
  for (std::size_t i = 0; i < walls_.walls.size(); ++i)
    if (windows_.size() == 1 || i == window) walls.push_back(i);
  return walls;
}

std::vector<WindowPane> ViewWindows::panesOf(std::size_t window, bool overview) const {
  const auto [width, height] = windows_[window]->window().size();
  const std::vector<std::size_t> walls = wallsOf(window);
  std::vector<WallEntry> entries;
  for (const std::size_t i : walls) entries.push_back(walls_.walls[i]);
  std::vector<WindowPane> panes;
  if (!overview || window > 0) {
    const std::vector<SheetPlace> places = unfold(entries, width, height);
    for (std::size_t i = 0; i < walls.size(); ++i) panes.push_back({walls[i], places[i]});
    return panes;
  }
  panes.push_back({overviewIndex(), {0, 0, width, height}});
  const auto w = static_cast<std::uint32_t>(kInset * width), h = static_cast<std::uint32_t>(kInset * height);
  const std::vector<SheetPlace> places = unfold(entries, w, h);
  for (std::size_t i = 0; i < walls.size(); ++i)
    panes.push_back({walls[i], moved(places[i], static_cast<std::int32_t>(width - w),
                                     static_cast<std::int32_t>(height - h))});
  return panes;
}

void ViewWindows::take(const std::vector<EyePictures>& pictures) {
  for (std::size_t w = 0; w < windows_.size(); ++w) {
    std::vector<std::size_t> walls = wallsOf(w);
    if (w == 0) walls.push_back(overviewIndex());
    windows_[w]->take(pictures, walls);
  }
}

void ViewWindows::show(bool overview) {
  for (std::size_t w = 0; w < windows_.size(); ++w) windows_[w]->draw(panesOf(w, overview));
  for (const auto& window : windows_) window->show();
}

void ViewWindows::setPanel(std::size_t number, const std::vector<PanelLine>& lines, bool atBottom) {
  std::uint32_t width = windows_[0]->window().size()[0];
  if (stereo_ == WindowStereo::SideBySide) width /= 2;  // it stands in each half
  const std::uint32_t room = width > 32 ? width - 16 : 16;
  const std::uint32_t scale = width >= 700 ? 2 : 1;
  windows_[0]->setOverlay(number, lines.empty() ? Picture{} : textPanel(lines, room, scale), atBottom);
}

std::string ViewWindows::screenshot(const std::string& folder, const std::vector<EyePictures>& pictures,
                                    bool overview) {
  std::error_code none;
  std::filesystem::create_directories(folder, none);
  const auto path = [&](const std::string& what) {
    return fmt::format("{}/{:03}-{}.png", folder, shots_, what);
  };
  const auto windowName = [&](std::size_t w) {
    return windows_.size() == 1 ? "window" : "window-" + walls_.walls[w].wall.name;
  };
  do ++shots_;
  while (std::filesystem::exists(path(windowName(0)), none));
  std::optional<Diagnostic> wrong;
  std::size_t count = 0;
  const auto write = [&](const std::string& what, const Picture& picture) {
    if (!wrong && !picture.empty()) {
      wrong = writePng(path(what), picture);
      ++count;
    }
  };
  for (std::size_t w = 0; w < windows_.size(); ++w)
    write(windowName(w), *windows_[w]->draw(panesOf(w, overview), true));
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const std::vector<Picture>& eyes = pictures[i].eyes;
    const std::string name = i < walls_.walls.size() ? walls_.walls[i].wall.name : "overview";
    for (std::size_t e = 0; e < eyes.size(); ++e)
      write(eyes.size() == 1 ? name : name + "-" + pictureName(e), eyes[e]);
  }
  return wrong ? "no screenshot: " + format(*wrong)
               : fmt::format("screenshot: {} and {} more", path(windowName(0)), count - 1);
}

}  // namespace stadion
