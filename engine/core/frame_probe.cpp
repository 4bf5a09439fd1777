#include "engine/core/frame_probe.h"

#include <array>

namespace stadion {

std::string_view nameOf(Span span) {
  static constexpr std::array<std::string_view, kSpans> kNames{
      "app",       "cull",     "draw",         "swap",     "receive",  "simulate", "dispatch",    "input",
      "loading",   "mail",     "crew",         "settle",   "publish",  "sound",    "watching",    "eyes",
      "test",      "fill",     "shadow casts", "sort",     "prepare",  "upload",   "shadow maps", "left eye",
      "right eye", "sky",      "resolve",      "finish",   "read",     "warp",     "for tick",    "for slot",
      "for frame", "for list", "for draw",     "for turn", "for walls"};
  return kNames[static_cast<std::size_t>(span)];
}

std::string_view nameOf(Count count) {
  static constexpr std::array<std::string_view, kCounts> kNames{
      "nodes visited", "messages", "published", "impacts",   "contacts",  "substeps", "tested",
      "seen",          "casters",  "calls",     "instances", "triangles", "pixels",   "largest"};
  return kNames[static_cast<std::size_t>(count)];
}

}  // namespace stadion
