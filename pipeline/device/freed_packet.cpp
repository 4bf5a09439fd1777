#include "pipeline/device/freed_packet.h"

#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

namespace stadion {
namespace {

constexpr std::uint8_t kMessage = 0xd1, kSum = 0x40;
constexpr double kPerDegree = 32'768, kPerMetre = 64'000;

/// 24 bits with a sign, high byte first.
double numberAt(std::span<const std::uint8_t> packet, std::size_t at) {
  const std::uint32_t bits =
      std::uint32_t{packet[at]} << 16 | std::uint32_t{packet[at + 1]} << 8 | packet[at + 2];
  const auto value = static_cast<std::int32_t>(bits);
  return value < 0x800000 ? value : value - 0x1000000;
}

}  // namespace

std::optional<FreeDPacket> readFreeD(std::span<const std::uint8_t> packet) {
  if (packet.size() != kFreeDBytes || packet[0] != kMessage) return std::nullopt;
  std::uint8_t sum = 0;
  for (const std::uint8_t byte : packet) sum = static_cast<std::uint8_t>(sum + byte);
  if (sum != kSum) return std::nullopt;
  const auto angle = [&](std::size_t at) { return numberAt(packet, at) / kPerDegree * kDegree; };
  const auto about = [](double turn, const Vec3& axis) {
    const det::SinCos half = det::sincos(0.5 * turn);
    return Quat(half.cos, half.sin * axis.x(), half.sin * axis.y(), half.sin * axis.z());
  };
  FreeDPacket read;
  read.camera = packet[1];
  read.X_SD.p = Vec3(numberAt(packet, 11), numberAt(packet, 14), numberAt(packet, 17)) / kPerMetre;
  read.X_SD.q =
      about(-angle(2), Vec3::UnitZ()) * about(angle(5), Vec3::UnitX()) * about(angle(8), Vec3::UnitY());
  return read;
}

}  // namespace stadion
