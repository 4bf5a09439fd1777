#pragma once
/// The text that ART's DTrack sends over UDP, one packet for each measurement of its cameras.
///
///     fr 21753
///     ts 39596.024831
///     6d 1 [0 1.000][326.848 -187.216 109.503 -160.4 -3.6 -7.2][b0 b1 b2 b3 b4 b5 b6 b7 b8]
///     6df2 1 1 [0 1.000 6 2][261.103 116.520 41.085 19.6 -1.8 112.2][b0 ... b8][5 -1.00 0.00]
///
/// `ts` is the time of the measurement, in seconds since midnight. `6d` has bodies: number, quality (-1 while the
/// cameras do not see the body), position [mm], three angles, and the rotation matrix by columns, from the body to the
/// room. `6df2` has Flysticks: besides, the numbers of buttons and controllers, then the buttons as bits in words of 32
/// and the controllers from -1 to 1. `6df` is its older form: number, quality and buttons. All other lines are left
/// out. Source: ART's DTrack2 User Manual, Technical Appendix, and DTRACK3 Programmer's Guide.
///
/// Units    positions in metres.
/// Threads  pure functions.
/// Errors   a packet with a damaged line of a kind that is read is refused as a whole.

#include "engine/maths/maths.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace stadion {

/// A body or a Flystick.
struct DTrackDevice {
  std::uint32_t number = 0;  ///< from 0
  bool flystick = false;
  std::optional<Pose> X_SD{};         ///< nothing while the cameras do not see it
  std::uint32_t buttonCount = 0;      ///< of those in `buttons`
  std::uint32_t buttons = 0;          ///< bit 0: the first
  std::vector<double> controllers{};  ///< -1 to 1
};

struct DTrackPacket {
  std::optional<double> time;  ///< since midnight [s]
  std::vector<DTrackDevice> devices;
};

/// Nothing if the text is none of DTrack's, or damaged.
std::optional<DTrackPacket> readDTrack(std::string_view text);

}  // namespace stadion
