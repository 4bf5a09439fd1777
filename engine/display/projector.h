#pragma once
/// Projectors: which point of a screen each pixel of an output lights, and how much light it gives.
///
/// A pixel's place is a share of the output's width and height from the upper left corner: pixel (i, j) of
/// W x H has its centre at ((i + 0.5) / W, (j + 0.5) / H).
///
/// Frames   R is the rig. P is the projector: its origin is the point from which light comes, +X is to the
///          right in the picture, +Y goes along the lens, +Z is up in the picture.
/// Units    metres, radians. Light is a share of the full white of a projector whose `white` is 1.
/// Threads  plain values, any thread.

#include "engine/colour_table/colour_table.h"
#include "engine/display/wall.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace stadion {

/// A lens that maps lines to lines. The pixel at (u, v) lights along the direction
/// ((u - 0.5 + shift.x) w, 1, (0.5 - v + shift.y) h) of P, where w = 1 / throwRatio and
/// h = pixelAspect w H / W.
struct LensImage {
  Pose X_RP;
  double throwRatio = 1;      ///< distance to a picture / width of that picture
  double pixelAspect = 1;     ///< height of a pixel's light / its width; not 1 for an anamorphic lens
  Vec2 shift = Vec2::Zero();  ///< lens shift to the right and up, as shares of the picture's width and height
};

/// An equidistant fisheye lens, such as one in the middle of a dome. Its circle has the smaller side of the
/// output as its diameter; the angle to the lens grows in proportion to the distance from the middle. Outside
/// of the circle there is no light.
struct FisheyeImage {
  Pose X_RP;
  double angle = 0;  ///< between opposite points of the circle [rad]
};

/// Corner pins: where the corners of a plane screen come to lie in the output, as shares: upper left, upper
/// right, lower right, lower left. Between them lines stay lines.
struct PinnedImage {
  std::array<Vec2, 4> pins;
};

/// What a camera system measured: points of the screen. Point (c, r) of the grid belongs to the share
/// ((c + 0.5) / columns, (r + 0.5) / rows) of the output. Between points, and beyond the outer ones up to the
/// output's edge, they are interpolated in both directions.
struct MeasuredImage {
  std::string file;  ///< as the user named it
  std::uint32_t columns = 0, rows = 0;
  std::vector<Vec3> points;  ///< (rows x columns), from the upper left, in R [m]; NaN: off the screen
};

/// The light of a channel for a value v from 0 to 1: black + (white - black) curve(v).
struct ProjectorLight {
  /// curve(v) = v^gamma, by channel; 0 = the curve of sRGB.
  std::array<double, 3> gamma{0, 0, 0};
  std::array<double, 3> white{1, 1, 1};  ///< by channel, above 0
  double black = 0;                      ///< light of a black pixel, below `white`
};

/// A picture of shares of light, laid over the whole output. Between the centres of its pixels it is
/// interpolated.
struct LightMap {
  std::uint32_t width = 0, height = 0;
  std::uint32_t channels = 1;         ///< 1, or 3: red, green, blue
  std::vector<std::uint16_t> values;  ///< (height x width x channels), from the upper left
  double gamma = 1;                   ///< share of light = (value / 65535)^gamma

  bool operator==(const LightMap&) const = default;
};

/// Borders of a picture, in the order of ProjectorBlend::edges.
enum class PictureEdge : std::uint32_t { Left, Right, Top, Bottom };
inline constexpr double kMostEdge = 0.45;  ///< of the width or height
constexpr const char* edgeName(PictureEdge edge) {
  constexpr const char* kNames[] = {"left", "right", "top", "bottom"};
  return kNames[static_cast<std::size_t>(edge)];
}

/// How a projector's picture fades out towards its neighbours. By channel, the light of a pixel whose picture
/// has the light p is p alpha (1 - beta) + beta, after the computed ramps.
struct ProjectorBlend {
  bool computed = true;  ///< ramps follow from what the projectors of the hall cover
  /// Where the ramps begin: so far inside of the picture's left, right, upper and lower border, as shares of its
  /// width and height. Beyond, neighbours give the light; where none reaches, this projector does.
  std::array<double, 4> edges{0, 0, 0, 0};
  /// A file whose pixels multiply the light, by channel, on top of that (0 = none, 255 = all; in proportion to
  /// light). Empty = none.
  std::string mask;
  std::optional<LightMap> alpha;  ///< of a file that holds its masks inside; none: 1
  std::optional<LightMap> beta;   ///< lifts black where fewer projectors light the screen; none: 0
};

/// A colour table between the picture and the display. `light` of the projector describes both together.
struct ProjectorLut {
  std::string file;   ///< as the user named it
  ColourTable table;  ///< empty until the file is read
};

struct Projector {
  std::size_t screen = 0;               ///< index in WallFile::screens
  std::uint32_t width = 0, height = 0;  ///< of the output [pixels]
  std::optional<Eye> eye;               ///< the eye for which it shows pictures; none: both
  std::variant<LensImage, FisheyeImage, PinnedImage, MeasuredImage> image;
  ProjectorLight light;
  ProjectorBlend blend;
  std::optional<ProjectorLut> lut;  ///< maps values after blending and encoding; none: they stay
};

/// How the projector of an entry is switched over the network: PJLink, class 1.
struct ProjectorControl {
  std::string host;  ///< name or address
  std::uint16_t port = 4352;
  std::string passwordFile;  ///< file whose first line is the password; empty = none

  bool operator==(const ProjectorControl&) const = default;
};

/// Where a hall expects its visitors' eyes.
struct VisitorPlace {
  Vec3 eye{0, 0, 1.7};  ///< the usual place, in R [m]
  double reach = 1;     ///< how far eyes go from there [m]
};

}  // namespace stadion
