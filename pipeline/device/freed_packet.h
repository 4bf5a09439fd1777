#pragma once
/// The message D1 of the FreeD protocol: where a tracked camera is, 29 bytes over UDP.
///
/// Byte 0 is D1, byte 1 the camera's number. Then six numbers of 24 bits with a sign, high byte first: pan, tilt and
/// roll in 1/32768 degree, then X, Y and height in 1/64 mm. Zoom, focus (24 bits each) and two spare bytes follow. The
/// last byte makes the sum of all bytes 0x40. Source: Vinten Radamec, free-d Installation Manual, appendices A and B.
///
/// The manual leaves it open in which way angles grow. Here pan turns to the right, tilt up, and roll leans to the right,
/// of a camera that looks along +Y with +Z up.
///
/// Units    metres.
/// Threads  pure functions.

#include "engine/maths/maths.h"

#include <cstdint>
#include <optional>
#include <span>

namespace stadion {

struct FreeDPacket {
  std::uint32_t camera = 0;
  Pose X_SD;
};

constexpr std::size_t kFreeDBytes = 29;

/// Nothing if the bytes are another message, or damaged.
std::optional<FreeDPacket> readFreeD(std::span<const std::uint8_t> packet);

}  // namespace stadion
