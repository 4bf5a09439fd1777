#include "engine/asset/importer_program/gltf/uri.h"

#include <array>

namespace stadion::importer {
namespace {

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// By character: its six bits, or -1. The characters of URLs count too.
constexpr std::array<std::int8_t, 256> sixBits() {
  std::array<std::int8_t, 256> bits{};
  bits.fill(-1);
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < kDigits.size(); ++i)
    bits[static_cast<unsigned char>(kDigits[i])] = static_cast<std::int8_t>(i);
  bits['-'] = 62;
  bits['_'] = 63;
  return bits;
}

std::optional<std::vector<std::uint8_t>> fromBase64(std::string_view text) {
  static constexpr auto kBits = sixBits();
  while (text.ends_with('=')) text.remove_suffix(1);
  if (text.size() % 4 == 1) return {};
  std::vector<std::uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t held = 0, count = 0;
  for (const char c : text) {
    const int bits = kBits[static_cast<unsigned char>(c)];
    if (bits < 0) return {};
    held = held << 6 | static_cast<std::uint32_t>(bits);
    if (count += 6; count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(held >> count));
  }
  return bytes;
}

}  // namespace

std::string percentDecoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int high = text[i] == '%' && i + 2 < text.size() ? hexDigit(text[i + 1]) : -1;
    const int low = high >= 0 ? hexDigit(text[i + 2]) : -1;
    if (low < 0) {
      decoded += text[i];
      continue;
    }
    decoded += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return decoded;
}

bool isDataUri(std::string_view uri) {
  return uri.starts_with("data:");
}

std::optional<std::vector<std::uint8_t>> dataOf(std::string_view uri) {
  const auto comma = uri.find(',');
  if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")) return {};
  return fromBase64(uri.substr(comma + 1));
}

}  // namespace stadion::importer
