#pragma once
/// The threads or processes that draw the walls in software, and their processors.
///
/// The pictures are the same with every setting; only the speed depends on it and on the machine.

#include <cstdint>
#include <optional>
#include <string>

namespace stadion {

struct DrawSetting {
  /// True: each wall is drawn by a process, false: by a thread of the program itself.
  bool processes = false;
  /// Rasteriser threads of each process; 0: the drawing thread makes the pixels.
  std::uint32_t rasteriserThreads = 0;
  bool pinned = false;  ///< true: each wall has processors of its own

  bool operator==(const DrawSetting&) const = default;
};

/// Settings that the user asks for on every machine. Nothing: the best setting is chosen.
struct DrawWishes {
  std::optional<bool> processes;
  std::optional<std::uint32_t> rasteriserThreads;
  std::optional<bool> pinned;

  bool any() const { return processes || rasteriserThreads || pinned; }
};

/// Mesa takes no more.
constexpr std::uint32_t kMostRasteriserThreads = 32;

/// Returns the setting for a machine without calibration, not pinned. It draws by threads, with a rasteriser
/// thread for each processor, which all walls share. If the user asks for processes, each gets its share of
/// the processors as rasteriser threads, or none if the share is not more than one.
DrawSetting unmeasuredSetting(std::uint32_t processors, std::size_t walls, const DrawWishes& wishes = {});

/// "4 processes, no rasteriser threads, pinned".
std::string textOf(const DrawSetting& setting, std::size_t walls);

}  // namespace stadion
