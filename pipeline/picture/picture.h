#pragma once
/// A drawn picture in memory, and PNG files of it.
///
/// Units    8 bits a channel, sRGB; rows from the top, no padding.
/// Threads  plain values; the functions are pure or touch only the file named.
/// Errors   returned with the file's name; a file that could not be written completely does not appear.

#include "engine/base/diagnostic.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  ///< (height x width x 4)

  Picture() = default;
  /// All channels `value`.
  Picture(std::uint32_t w, std::uint32_t h, std::uint8_t value = 255)
      : width(w), height(h), rgba(std::size_t(w) * h * 4, value) {}

  std::uint8_t* at(std::uint32_t x, std::uint32_t y) { return &rgba[(std::size_t(y) * width + x) * 4]; }
  const std::uint8_t* at(std::uint32_t x, std::uint32_t y) const {
    return &rgba[(std::size_t(y) * width + x) * 4];
  }
  bool empty() const { return rgba.empty(); }
  bool sameSize(const Picture& o) const { return width == o.width && height == o.height; }
};

/// XXH64 of the pixels: equal pictures, equal hash, on every machine.
std::uint64_t imageHash(const Picture& picture);

/// Writes the picture; equal pictures give equal bytes. An opaque picture is written without alpha. Returns
/// nothing on success.
std::optional<Diagnostic> writePng(const std::string& path, const Picture& picture);

/// Returns the bytes of a PNG file of the picture, without alpha, packed quickly rather than small. Empty if the
/// picture is, or without memory.
std::string pngOf(const Picture& picture);

/// Reads any PNG as 8-bit RGBA, up to 16384 pixels a side.
Result<Picture> readPng(const std::string& path);

}  // namespace stadion
