#pragma once
/// Panoramas: pictures of all directions around the visitor's head, without a screen. They serve as dome masters
/// for planetaria and as spherical video.
///
/// A pixel shows a direction. Its place is a share of the picture's width and height from the upper left corner.
/// With right = u - 0.5 and up = 0.5 - v:
///   DomeMaster       a circle, whose diameter is the smaller side. At the distance r from its middle, in
///                    diameters, the angle to P's +Y is r * across. Outside of the circle there is no picture.
///   Equirectangular  azimuth = right * across, elevation = up * upright.
///   Cube             six squares of 90 degrees in two rows: right, left, up; down, front, back. Up and down stand
///                    as seen by a head that faces front and tilts.
///
/// Frames   R is the rig. P is the panorama: +X right, +Y to the middle of the picture (of a cube: front), +Z up in
///          the picture. Untilted, P has the axes of R; that of a dome master looks overhead, and what is in front
///          lies at the lower edge of the picture.
/// Units    radians, metres.
/// Threads  plain values and pure functions.
/// Sources  equidistant azimuthal and equirectangular projection: Snyder, "Map Projections: A Working Manual"
///          (1987), sections 25 and 12.

#include "engine/maths/maths.h"

#include <array>
#include <cstdint>
#include <optional>

namespace stadion {

enum class PanoramaKind : std::uint32_t { DomeMaster, Equirectangular, Cube };
constexpr const char* panoramaKindName(PanoramaKind kind) {
  constexpr const char* kNames[] = {"dome-master", "equirectangular", "cube"};
  return kNames[static_cast<std::size_t>(kind)];
}

/// From where the visitor looks around.
enum class PanoramaEye : std::uint32_t { Middle, Left, Right };

struct Panorama {
  PanoramaKind kind = PanoramaKind::DomeMaster;
  PanoramaEye eye = PanoramaEye::Middle;
  std::uint32_t width = 0, height = 0;  ///< [pixels]
  double across = 0;                    ///< field of view [rad]; cube: not used
  double upright = 0;      ///< of an equirectangular picture, from its lower to its upper edge [rad]
  double turn = 0;         ///< of the picture's middle to the right [rad]
  double tilt = 0;         ///< brings forward what is overhead [rad]
  std::optional<Vec3> at;  ///< it is seen from there, in R [m]; none: from the head
};

/// A side of the cube. Its square is the points normal + s right + t up, with s and t from -1 to 1.
struct CubeSide {
  Vec3 normal, right, up;  ///< in P
};

/// The sides as they stand in the picture, row by row.
const std::array<CubeSide, 6>& cubeSides();

/// Returns the rotation from P to R.
Quat rotationOf(const Panorama& panorama);

/// Returns the direction that the picture shows at `share`, in P, not of unit length; nothing outside of a dome
/// master's circle. The formulas continue beyond 0..1.
std::optional<Vec3> directionAt(const Panorama& panorama, const Vec2& share);

/// Returns where the picture shows the direction, which is in P; nothing: nowhere.
std::optional<Vec2> shareOf(const Panorama& panorama, const Vec3& direction);

/// Returns the angle between neighbouring pixels where the picture is densest in its middle [rad].
double pixelAngle(const Panorama& panorama);

/// Pixels along the side of a cube are a multiple of this.
inline constexpr std::uint32_t kCubeStep = 8;

/// Returns true if each side of the cube is a square with a multiple of kCubeStep pixels. Others always fit.
bool sizeFits(const Panorama& panorama);

/// Returns the panorama with about this width and the same shape.
Panorama withWidth(const Panorama& panorama, std::uint32_t width);

}  // namespace stadion
