#include "pipeline/target/pixel_format.h"

#include <bit>
#include <fmt/format.h>

namespace stadion {
namespace {

constexpr std::uint32_t kMostChannelBits = 16;

bool isOnePiece(std::uint32_t mask) {
  const std::uint32_t low = mask >> std::countr_zero(mask);
  return (low & (low + 1)) == 0;
}

std::array<std::uint32_t, 256> channelOf(std::uint32_t mask) {
  const std::uint64_t most = mask >> std::countr_zero(mask);
  std::array<std::uint32_t, 256> table{};
  for (std::uint64_t v = 0; v < table.size(); ++v)
    table[v] = static_cast<std::uint32_t>((v * most + 127) / 255) << std::countr_zero(mask);
  return table;
}

}  // namespace

std::optional<std::string> whyNotWritten(const PixelFormat& format) {
  if (format.bits != 16 && format.bits != 24 && format.bits != 32)
    return fmt::format("its pixels have {} bits; pictures need 16, 24 or 32", format.bits);
  for (const std::uint32_t mask : {format.red, format.green, format.blue})
    if (mask == 0 || !isOnePiece(mask) || std::popcount(mask) > static_cast<int>(kMostChannelBits) ||
        (format.bits < 32 && mask >> format.bits != 0))
      return fmt::format("its colours lie in the bits {:x}, {:x} and {:x} of a pixel", format.red,
                         format.green, format.blue);
  return {};
}

PixelWriter::PixelWriter(const PixelFormat& format)
    : format_(format), channels_{channelOf(format.red), channelOf(format.green), channelOf(format.blue)} {
  if (format.bits < 32) return;
  // Bits without a colour may be the window's opacity.
  const std::uint32_t rest = ~(format.red | format.green | format.blue);
  for (std::uint32_t& red : channels_[0]) red |= rest;
}

void PixelWriter::write(std::span<const std::uint32_t> pixels, std::uint8_t* to) const {
  const std::uint32_t bytes = format_.bits / 8;
  for (const std::uint32_t p : pixels) {
    const std::uint32_t value =
        channels_[0][p >> 16 & 255] | channels_[1][p >> 8 & 255] | channels_[2][p & 255];
    for (std::uint32_t i = 0; i < bytes; ++i)
      *to++ = static_cast<std::uint8_t>(value >> 8 * (format_.lowFirst ? i : bytes - 1 - i));
  }
}

}  // namespace stadion
