#pragma once
/// The rungs of the ladder that `stadion bench looks` compares, by name.
///
/// Threads  plain values.

#include "pipeline/cpu_draw/picture_rung.h"

#include <optional>
#include <span>
#include <string_view>

namespace stadion::bench {

struct NamedRung {
  std::string_view name;              ///< in tables
  std::optional<PictureRung> rung{};  ///< nothing: OpenGL, full look
};

constexpr std::string_view kDefaultRung = "4", kBetterRung = "8", kOpenGlRung = "opengl";
/// All names, for the grammar of an option.
constexpr std::string_view kRungNames = "8|4|2|1|4-coarse|4-nearest|plain|opengl";

/// From the nearest to the reference down to the cheapest; OpenGL last.
std::span<const NamedRung> allRungs();

}  // namespace stadion::bench
