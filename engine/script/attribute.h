#pragma once
/// The attribute words of the language. One word may mean different things in different node types
/// (`unit` of an object and of a force field); the schema says which.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace stadion {

enum class Attr : std::uint8_t {
  Ambient,
  Angle,
  AngularVelocity,
  Attach,
  Box,
  Collidee,
  Collider,
  Colour,
  Core,
  Damping,
  Density,
  Direction,
  DragArea,
  Draw,
  Duration,
  EventMessage,
  EyeHeight,
  Falloff,
  File,
  Friction,
  Gain,
  Ground,
  Haze,
  Hook,
  Horizon,
  InitState,
  Intensity,
  Inward,
  Key,
  Loop,
  Mass,
  Mode,
  Name,
  Nose,
  Orientation,
  Parent,
  Period,
  Position,
  Radius,
  Range,
  Ready,
  ReleaseDistance,
  Repeat,
  Restitution,
  Rolling,
  Scale,
  SelfCollide,
  Shape,
  Smooth,
  Softening,
  Speed,
  Sphere,
  Spin,
  Sticks,
  Strength,
  StrengthAxis,
  Target,
  Throw,
  Tolerance,
  Tracker,
  TurnRate,
  Type,
  Unit,
  Up,
  Velocity,
  Viscosity,
  Wind,
  Zenith,
};

inline constexpr std::array<std::string_view, 68> kAttrNames = {
    "ambient",      "angle",        "angularvelocity",
    "attach",       "box",          "collidee",
    "collider",     "colour",       "core",
    "damping",      "density",      "direction",
    "dragarea",     "draw",         "duration",
    "eventmessage", "eyeheight",    "falloff",
    "file",         "friction",     "gain",
    "ground",       "haze",         "hook",
    "horizon",      "initstate",    "intensity",
    "inward",       "key",          "loop",
    "mass",         "mode",         "name",
    "nose",         "orientation",  "parent",
    "period",       "position",     "radius",
    "range",        "ready",        "releasedistance",
    "repeat",       "restitution",  "rolling",
    "scale",        "selfcollide",  "shape",
    "smooth",       "softening",    "speed",
    "sphere",       "spin",         "sticks",
    "strength",     "strengthaxis", "target",
    "throw",        "tolerance",    "tracker",
    "turnrate",     "type",         "unit",
    "up",           "velocity",     "viscosity",
    "wind",         "zenith"};
inline constexpr std::size_t kAttrCount = kAttrNames.size();

constexpr std::string_view nameOf(Attr attr) {
  return kAttrNames[static_cast<std::size_t>(attr)];
}

constexpr std::optional<Attr> attrNamed(std::string_view word) {
  for (std::size_t i = 0; i < kAttrCount; ++i)
    if (kAttrNames[i] == word) return static_cast<Attr>(i);
  return std::nullopt;
}

}  // namespace stadion
