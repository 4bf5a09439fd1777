#pragma once
/// How a window system lays out a pixel in memory, and the way there from words of 0xAARRGGBB.
///
/// Threads  plain values.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace stadion {

struct PixelFormat {
  std::uint32_t bits = 32;  ///< size of a pixel in memory: 16, 24 or 32 [bits]
  std::uint32_t red = 0xff0000, green = 0xff00, blue = 0xff;  ///< the bits of each channel
  bool lowFirst = true;                                       ///< the byte of the lowest bits comes first

  /// Whether it is that of words of 0xAARRGGBB: then nothing need be converted.
  bool isPlain() const { return *this == PixelFormat{}; }
  bool operator==(const PixelFormat&) const = default;
};

/// Returns why pixels cannot be written in that format; nothing if they can.
std::optional<std::string> whyNotWritten(const PixelFormat& format);

/// Writes rows of pixels in one format. Each channel gets the nearest value that it can show.
class PixelWriter {
public:
  /// Expects a format that can be written.
  explicit PixelWriter(const PixelFormat& format);

  /// `to` has room for all pixels.
  void write(std::span<const std::uint32_t> pixels, std::uint8_t* to) const;

private:
  PixelFormat format_;
  std::array<std::array<std::uint32_t, 256>, 3> channels_{};  ///< red, green, blue: in their places
};

}  // namespace stadion
