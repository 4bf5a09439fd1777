#pragma once
/// What mpcdi.xml says, as values: the standard's elements and attributes, whose names it does not tell apart by
/// their case.
///
/// Units    as in the file: degrees, shares of the buffer from its lower left corner, the unit of the points.
/// Threads  pure function.
/// Errors   go to the HallBuilder with the line. Elements and attributes that are not of the standard, or have
///          no effect here, are named.

#include "engine/hall_formats/hall_builder.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

struct MpcdiFrustum {
  double yaw = 0, pitch = 0, roll = 0;  ///< to the right, up, clockwise, in this order
  double rightAngle = 0, leftAngle = 0, upAngle = 0, downAngle = 0;  ///< left and down below 0
};

/// A place and what its axes mean: the tips of the arrows of yaw (down), pitch (right) and roll (forward).
struct MpcdiFrame {
  Vec3 position = Vec3::Zero();
  Vec3 yaw = Vec3::Zero(), pitch = Vec3::Zero(), roll = Vec3::Zero();
};

/// The files of a region; empty names where there are none.
struct MpcdiFiles {
  std::string warp, unit, origin, interpolation;
  std::string alpha, beta, distortion;
  double alphaGamma = 1;
};

struct MpcdiRegion {
  std::string id, buffer;
  double x = 0, y = 0, width = 1, height = 1;  ///< in the buffer
  std::uint32_t columns = 0, rows = 0;         ///< [pixels]
  std::optional<MpcdiFrustum> frustum;
  std::optional<MpcdiFrame> frame;
  std::optional<double> encodeGamma;  ///< of the display
  MpcdiFiles files;
  bool hasFiles = false;
  bool unknownLens = false;  ///< an extension describes a lens that the frustum does not
  std::uint32_t line = 0;
};

struct MpcdiBuffer {
  std::uint32_t columns = 0, rows = 0;  ///< [pixels]; 0: not stated
};

/// The extension that MPCDI files of this program have.
struct MpcdiHallExtension {
  std::string hall;                            ///< name of the wall file in the archive
  std::map<std::string, std::string> digests;  ///< of the standard's part, by region
  std::map<std::string, double> pixelAspects;  ///< of lenses, by region
};

struct MpcdiDocument {
  std::string profile;  ///< 2d, 3d, a3 or sl
  std::map<std::string, MpcdiBuffer> buffers;
  std::vector<MpcdiRegion> regions;
  std::optional<MpcdiHallExtension> extension;
};

/// The bytes of a region's files; empty where there are none.
struct MpcdiContent {
  std::string warp, alpha, beta;
};

/// A digest of what the standard's part says about a region.
std::string digestOf(const MpcdiRegion& region, const MpcdiContent& content);

/// Reads the XML; nothing after an error.
std::optional<MpcdiDocument> readMpcdiDocument(const std::string& xml, HallBuilder& builder);

}  // namespace stadion
