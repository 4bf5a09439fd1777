#pragma once
/// The walls of a place on their real displays: a window for each, on the output that the wall file names.
///
/// Threads  the main thread alone.

#include "engine/display/wall_file.h"
#include "show/display/show_windows.h"

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

class WallDisplays {
public:
  /// A wall without an output gets a window with a frame, of its stated pixels or of `width` x `height`. Null
  /// if one of the outputs cannot be opened; the findings say which and why.
  /// `sync`: what the driver is to do so that the windows swap together. A barrier that it lacks is an error.
  static std::unique_ptr<WallDisplays> open(const WallFile& walls, WindowSurface surface, WindowStereo stereo,
                                            std::uint32_t width, std::uint32_t height, SwapSync sync,
                                            Diagnostics& findings);
  ~WallDisplays();

  /// The size of picture that fills a wall's output pixel by pixel.
  std::array<std::uint32_t, 2> pictureSize(std::size_t wall) const;
  /// Shows these pictures, by wall, on all outputs one directly after the other.
  void show(const std::vector<EyePictures>& pictures);
  /// Takes in what happened and returns the keys that were pressed. Escape also stands for a window that
  /// somebody closed.
  std::vector<Key> poll();
  /// The same with all presses of keys that are held down, and with the keys that were held beside them.
  std::vector<WindowEvent> pollPresses();
  /// Changes how a wall's picture gets to its output.
  void setShape(std::size_t wall, const OutputShape& shape) { shapes_[wall] = shape; }
  /// How the windows swap together, such as "a swap group of 4 windows"; empty if they swap one after the other.
  std::string swapSync() const;
  /// Why nothing can be shown any more; nothing while it can.
  std::optional<std::string> lost() const;

private:
  WallDisplays() = default;
  Result<WindowSystem*> systemOf(const std::string& screen);
  bool joinSwapGroups(const WallFile& walls, SwapSync sync, Diagnostics& findings);
  /// Why displays may go dark during the show, and what to do; nothing if they are kept from it.
  std::optional<std::string> mayGoDark() const;

  std::map<std::string, std::unique_ptr<WindowSystem>> systems_;  ///< by X screen
  std::vector<std::unique_ptr<ShowWindow>> windows_;              ///< by wall; go before their systems
  std::vector<std::string> screens_;                              ///< by wall: its X screen
  std::vector<std::unique_ptr<SwapGroup>> groups_;                ///< go before their windows
  std::vector<OutputShape> shapes_;
};

}  // namespace stadion
