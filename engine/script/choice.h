#pragma once
/// The attributes whose value is one word out of a few, as enumerations. The schema lists the words in the
/// same order, and Declaration::choice<E>() turns one into the other.

#include "engine/asset/format.h"
#include "engine/core/measure_from.h"
#include "engine/text/text_mesh.h"

#include <cstdint>

namespace stadion {

enum class LightType : std::uint8_t { Directional, Point, Spot };  ///< light: type
enum class ShapeWord : std::uint8_t {
  Auto,
  Sphere,
  Box,
  Mesh,
  Plane,
  Capsule,
  Cylinder,
  Convex
};  ///< object, dynobject: shape
// object, dynobject: `up` is the UpAxis of asset/format.h
enum class ForceUnit : std::uint8_t { Gravity, Acceleration, Newton };  ///< force fields: unit
enum class FieldMode : std::uint8_t { Attract, Repel };                 ///< forcespherical: mode
enum class FieldFalloff : std::uint8_t { None, Linear, Square };        ///< forcespherical: falloff
enum class ThrowSource : std::uint8_t { Hand, Field, Both };            ///< dynobject: throw
// measure: `from` is the MeasureFrom of core/measure_from.h
// text: `align` is the TextAlign of text/text_mesh.h
enum class FlightWord : std::uint8_t {
  Point,
  Ballistic,
  Bias,
  Rod,
  Plate,
  Ball,
  Table
};                                                               ///< dynobject: flight
enum class BiasWord : std::uint8_t { Flow, Paper, Covariance };  ///< dynobject: bias
enum class AxesWord : std::uint8_t { Area, Vertices };           ///< dynobject: axes
enum class NavigatorMode : std::uint8_t { Walk, Fly };           ///< navigator: mode

enum class DeviceAxis : std::uint8_t {};  ///< force fields: strengthaxis

}  // namespace stadion
