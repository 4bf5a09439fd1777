#pragma once
/// The kinds of node that a script can declare, and their words in the language.

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string_view>

namespace stadion {

enum class NodeKind : std::uint8_t {
  Group,
  Transform,
  Lod,
  Object,
  DynObject,
  Light,
  Sky,
  Text,
  ForceLinear,
  ForceSpherical,
  ForcePoint,
  ForceVortex,
  Medium,
  UserTrigger,
  WandTrigger,
  Timer,
  Scene,
  Path,
  Sway,
  Sound,
  Collision,
  Dynamics,
  Measure,
  Navigator,
  Rig,
};

inline constexpr std::array<std::string_view, 25> kNodeKindNames = {
    "group",      "transform",   "lod",     "object",      "dynobject",
    "light",      "sky",         "text",    "forcelinear", "forcespherical",
    "forcepoint", "forcevortex", "medium",  "usertrigger", "wandtrigger",
    "timer",      "scene",       "path",    "sway",        "sound",
    "collision",  "dynamics",    "measure", "navigator",   "rig"};
inline constexpr std::size_t kNodeKindCount = kNodeKindNames.size();

constexpr std::string_view nameOf(NodeKind kind) {
  return kNodeKindNames[static_cast<std::size_t>(kind)];
}

constexpr std::optional<NodeKind> nodeKindNamed(std::string_view word) {
  for (std::size_t i = 0; i < kNodeKindCount; ++i)
    if (kNodeKindNames[i] == word) return static_cast<NodeKind>(i);
  return std::nullopt;
}

/// A set of kinds, for instance those that may be hooked.
struct KindSet {
  std::uint32_t bits = 0;

  constexpr KindSet() = default;
  constexpr KindSet(std::initializer_list<NodeKind> kinds) {
    for (const NodeKind kind : kinds) bits |= 1U << static_cast<unsigned>(kind);
  }
  static constexpr KindSet all() {
    KindSet set;
    set.bits = (1U << kNodeKindCount) - 1U;
    return set;
  }
  constexpr bool has(NodeKind kind) const { return (bits >> static_cast<unsigned>(kind) & 1U) != 0; }
  constexpr bool empty() const { return bits == 0; }
  constexpr KindSet operator|(KindSet other) const {
    other.bits |= bits;
    return other;
  }
};

}  // namespace stadion
