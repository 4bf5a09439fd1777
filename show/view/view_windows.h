#pragma once
/// The windows of a viewed show: where each wall lies in them, and the text over the walls.
///
/// Threads  main.

#include "engine/display/wall_file.h"
#include "pipeline/picture/text_panel.h"
#include "show/display/show_windows.h"
#include "show/view/view_settings.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace stadion {

class ViewWindows {
public:
  /// Null, with the reason in the findings, if they cannot be opened. `drawnWithOpenGl`: the walls are, so
  /// windows may need it too.
  static std::unique_ptr<ViewWindows> open(const ViewSettings& settings, const WallFile& walls,
                                           bool drawnWithOpenGl, Diagnostics& findings);

  /// Returns the sizes of the walls' pictures, for walls without a size from --size or the wall file.
  const std::vector<SheetPlace>& pictureSizes() const { return sizes_; }
  std::optional<GamepadState> gamepad() { return system_->gamepad(); }
  /// Why nothing can be shown any more; nothing while it can.
  std::optional<std::string> lost() const { return system_->lost(); }

  /// Returns the events since the last call, with the window of each.
  std::vector<std::pair<std::size_t, WindowEvent>> takeEvents();
  /// The walls' pictures, by wall, then the overview's. They must stay until others are taken.
  void take(const std::vector<EyePictures>& pictures);
  /// Shows them; with the overview, the first window shows the room from outside and its walls small.
  void show(bool overview);
  /// Lines of text over the first window: 0, 1, ... from above, or from below.
  void setPanel(std::size_t number, const std::vector<PanelLine>& lines, bool atBottom);
  /// Writes the windows' content and the pictures into the folder, and says what came of it.
  std::string screenshot(const std::string& folder, const std::vector<EyePictures>& pictures, bool overview);

private:
  ViewWindows(const WallFile& walls, WindowStereo stereo) : walls_(walls), stereo_(stereo) {}
  std::vector<std::size_t> wallsOf(std::size_t window) const;
  std::vector<WindowPane> panesOf(std::size_t window, bool overview) const;
  std::size_t overviewIndex() const { return walls_.walls.size(); }

  const WallFile& walls_;
  WindowStereo stereo_;
  std::unique_ptr<WindowSystem> system_;
  std::vector<std::unique_ptr<ShowWindow>> windows_;  ///< go before their system
  std::vector<SheetPlace> sizes_;
  int shots_ = 0;
};

}  // namespace stadion
