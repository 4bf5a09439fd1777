#pragma once
/// Who draws the walls in software, and on which processors.
///
/// The pictures are the same with every setting; how fast they are drawn depends on the machine.

#include <cstdint>
#include <optional>
#include <string>

namespace stadion {

struct DrawSetting {
  bool processes = false;               ///< one for each wall; else threads of the program itself
  std::uint32_t rasteriserThreads = 0;  ///< of each process; 0: pixels are made by the thread that draws
  bool pinned = false;                  ///< each wall is drawn on processors of its own

  bool operator==(const DrawSetting&) const = default;
};

/// What is asked for whatever the machine; nothing: as it is best.
struct DrawWishes {
  std::optional<bool> processes;
  std::optional<std::uint32_t> rasteriserThreads;
  std::optional<bool> pinned;

  bool any() const { return processes || rasteriserThreads || pinned; }
};

/// Mesa takes no more.
constexpr std::uint32_t kMostRasteriserThreads = 32;

/// How it is drawn on a machine that nobody has measured: by threads, with a rasteriser thread for each
/// processor, which all walls share; of processes that are asked for each has its share of the processors,
/// none if that is not more than one. Not pinned.
DrawSetting unmeasuredSetting(std::uint32_t processors, std::size_t walls, const DrawWishes& wishes = {});

/// "4 processes, no rasteriser threads, pinned".
std::string textOf(const DrawSetting& setting, std::size_t walls);

}  // namespace stadion
