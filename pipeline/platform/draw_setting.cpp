#include "pipeline/platform/draw_setting.h"

#include <algorithm>
#include <fmt/format.h>

namespace stadion {

DrawSetting unmeasuredSetting(std::uint32_t processors, std::size_t walls, const DrawWishes& wishes) {
  DrawSetting setting;
  setting.processes = wishes.processes.value_or(false);
  const auto sharers = setting.processes ? std::max<std::uint32_t>(1, static_cast<std::uint32_t>(walls)) : 1;
  const std::uint32_t share = processors / sharers;
  const std::uint32_t threads = setting.processes && share <= 1 ? 0 : std::max(share, 1u);
  setting.rasteriserThreads = wishes.rasteriserThreads.value_or(std::min(threads, kMostRasteriserThreads));
  setting.pinned = wishes.pinned.value_or(false);
  return setting;
}

std::string textOf(const DrawSetting& s, std::size_t walls) {
  const auto many = [](std::size_t n, const char* what, const char* whats) {
    return n == 0 ? fmt::format("no {}", whats) : fmt::format("{} {}", n, n == 1 ? what : whats);
  };
  return fmt::format(
      "{}, {}{}{}", s.processes ? many(walls, "process", "processes") : many(walls, "thread", "threads"),
      many(s.rasteriserThreads, "rasteriser thread", "rasteriser threads"),
      s.processes && walls > 1 && s.rasteriserThreads > 0 ? " each" : "", s.pinned ? ", pinned" : "");
}

}  // namespace stadion
